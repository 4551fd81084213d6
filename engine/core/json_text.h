#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rowland {

/// Names a value from the root on: keys of objects, and positions in arrays as decimal numbers.
using JsonPath = std::vector<std::string>;

/// JSON text that is edited in place. What an edit does not name stays byte for byte: formatting, the order of keys,
/// the spelling of numbers. What is added follows the formatting around it, at the end of its object or array.
class JsonText {
 public:
    /// `text` is an object that parse_json() accepts; a byte order mark stays.
    explicit JsonText(std::string text);

    const std::string& text() const { return text_; }

    /// The text of a value; nullopt if there is none. Valid until the next edit.
    std::optional<std::string_view> find(const JsonPath& path) const;

    /// Replaces a value, or adds it and the objects around it. Of an object only the members that differ are replaced.
    void set(const JsonPath& path, const nlohmann::ordered_json& value);

    /// Adds a last element to an array of the root, which is made if it is missing.
    void append(const std::string& array, const nlohmann::ordered_json& value);
    /// The same with a value that is already text.
    void append_text(const std::string& array, std::string value);

    /// Removes a member or an element; nothing if there is none.
    void remove(const JsonPath& path);

 private:
    struct Range {
        std::size_t begin = 0;
        std::size_t end = 0;
    };
    struct Member {
        Range key;  ///< empty in an array
        Range value;
        std::size_t begin() const { return key.end > 0 ? key.begin : value.begin; }
    };
    /// How the members of a container are written.
    struct Layout {
        std::string between;  ///< line break and indentation, or a space, or nothing
        std::string colon;
    };

    std::string_view at(Range range) const;
    Range root() const;
    std::size_t skip_space(std::size_t position) const;
    std::size_t end_of_string(std::size_t position) const;
    std::size_t end_of_value(std::size_t position) const;
    std::vector<Member> members(Range container) const;
    std::string key_of(const Member& member) const;
    std::optional<Range> child(Range container, const std::string& step) const;
    std::optional<Range> range_of(const JsonPath& path) const;

    Layout layout_of(Range container, const std::vector<Member>& members) const;
    std::string write(const nlohmann::ordered_json& value, const Layout& layout) const;
    void add(Range container, const std::string* key, std::string value, const Layout& layout);
    void replace(Range range, std::string_view by);

    std::string text_;
    std::string colon_;    ///< between a key and its value, as the first member of the root has it
    std::string newline_;  ///< of the file; empty: all is on one line
    std::string unit_;     ///< of indentation
};

}  // namespace rowland
