#pragma once
// What the bake uses of JSON for Modern C++, in a tenth of its size: JavaScript has parsed and checked the text. A
// value is its text, without spaces, as JSON.stringify() writes it.
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace nlohmann {

class ordered_json;

class json {
 public:
    enum class error_handler_t { replace };
    /// For parse_json() of engine/core to compile; nothing calls it, so that no module contains it.
    enum class parse_event_t { key, object_start, object_end, array_start, array_end };
    struct parse_error : std::exception {
        std::size_t byte = 0;
    };
    using out_of_range = std::exception;
    template <typename Callback>
    static json parse(std::string_view text, const Callback&) {
        return parse(text);
    }

    json() = default;
    json(int number) : text_(std::to_string(number)) {}
    json(std::int64_t number) : text_(std::to_string(number)) {}
    json(std::string_view string) : text_('"' + std::string(string) + '"') {}
    json(const std::string& string) : json(std::string_view(string)) {}
    json(const char* string) : json(std::string_view(string)) {}
    json(std::initializer_list<std::pair<const char*, json>> members);  ///< of an object
    static json object() { return parse("{}"); }
    static json parse(std::string_view text);

    bool is_object() const { return text_[0] == '{'; }
    bool is_array() const { return text_[0] == '['; }
    bool is_string() const { return text_[0] == '"'; }
    bool is_structured() const { return is_object() || is_array(); }
    bool is_boolean() const { return text_[0] == 't' || text_[0] == 'f'; }
    bool is_number() const { return text_[0] == '-' || (text_[0] >= '0' && text_[0] <= '9'); }
    bool is_number_integer() const { return is_number() && text_.find_first_of(".e") == std::string::npos; }
    bool is_number_unsigned() const { return is_number_integer() && text_[0] != '-'; }

    template <typename Value>
    Value get() const {
        if constexpr (std::is_same_v<Value, std::string>) return string();
        if constexpr (std::is_same_v<Value, bool>) return text_ == "true";
        if constexpr (std::is_arithmetic_v<Value>) return static_cast<Value>(std::strtod(text_.c_str(), nullptr));
    }
    bool operator==(const char* text) const { return is_string() && string() == text; }
    std::string dump(int = -1, char = ' ', bool = false, error_handler_t = error_handler_t::replace) const {
        return text_;
    }

    std::size_t size() const { return values_.size(); }
    bool empty() const { return values_.empty(); }
    const json* begin() const { return values_.data(); }
    const json* end() const { return begin() + size(); }
    const json& operator[](std::size_t i) const { return values_[i]; }
    const json* find(std::string_view key) const;
    bool contains(std::string_view key) const { return find(key) != end(); }
    const json& operator[](const char* key) const { return *find(key); }
    json& operator[](const char* key);
    std::vector<std::pair<std::string, json>> items() const;

 private:
    std::string string() const;

    std::string text_ = "null";
    std::vector<std::string> keys_;  ///< of an object
    std::vector<json> values_;       ///< of an object or an array
};

inline json::json(std::initializer_list<std::pair<const char*, json>> members) : text_("{}") {
    for (const auto& [key, value] : members) (*this)[key] = value;
}

}  // namespace nlohmann
