#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rowland {

/// Parses JSON text that may be hostile. Throws Error (input) with line and column for bad syntax and invalid UTF-8,
/// for nesting deeper than 64, and with the JSON pointer for a repeated key of an object.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// A number's domain; the message shows it as an interval. Open ends exclude the bound.
struct NumberRange {
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    bool minimum_open = false;
    bool maximum_open = false;
};

/// What a float can hold.
inline constexpr NumberRange kFiniteFloat{.minimum = std::numeric_limits<float>::lowest(),
                                          .maximum = std::numeric_limits<float>::max()};

/// Reads one JSON object strictly: every failure is an Error (input) that names the file, the JSON pointer, what was
/// found and what was expected, and finish() refuses keys that were not read, naming the nearest valid one.
class JsonReader {
 public:
    /// `value` must outlive the reader. Throws if it is not an object.
    JsonReader(const nlohmann::json& value, std::string file, std::string pointer = "");

    bool has(const std::string& key);
    double number(const std::string& key, NumberRange range);
    double number_or(const std::string& key, double fallback, NumberRange range);
    std::int64_t integer(const std::string& key, std::int64_t minimum, std::int64_t maximum);
    std::int64_t integer_or(const std::string& key, std::int64_t fallback, std::int64_t minimum, std::int64_t maximum);
    std::string text(const std::string& key);
    std::string text_or(const std::string& key, std::string fallback);
    bool boolean_or(const std::string& key, bool fallback);
    /// An array of exactly `count` numbers.
    std::vector<double> numbers(const std::string& key, std::size_t count, NumberRange range);
    /// An array of as many numbers as `fallback` has.
    std::vector<double> numbers_or(const std::string& key, std::vector<double> fallback, NumberRange range);
    /// One of `choices`; the message names the nearest.
    std::string choice(const std::string& key, const std::vector<std::string_view>& choices);
    std::string choice_or(const std::string& key, std::string fallback, const std::vector<std::string_view>& choices);
    /// The value of the chosen word.
    template <typename Value>
    Value choice(const std::string& key, std::initializer_list<std::pair<std::string_view, Value>> choices) {
        std::vector<std::string_view> words;
        for (const auto& choice : choices) words.push_back(choice.first);
        return (choices.begin() + choice_index(key, words))->second;
    }
    JsonReader object(const std::string& key);
    std::optional<JsonReader> object_if_there(const std::string& key);
    /// The raw value, for shapes the calls above do not cover.
    const nlohmann::json& raw(const std::string& key);
    /// Array of objects under `key`.
    std::vector<JsonReader> objects(const std::string& key);
    /// The same; empty if the key is missing.
    std::vector<JsonReader> objects_if_there(const std::string& key);

    /// Throws if the object holds a key that was not asked for. Call it last.
    void finish() const;

    /// Throws Error (input) at the value under `key`, or deeper: "key/0".
    [[noreturn]] void fail(const std::string& key, std::string found, std::string expected,
                           std::string remedy = "") const;
    const std::string& file() const { return file_; }
    std::string pointer_to(const std::string& key) const { return pointer_ + "/" + key; }

 private:
    const nlohmann::json& require(const std::string& key);
    std::ptrdiff_t choice_index(const std::string& key, const std::vector<std::string_view>& choices);

    const nlohmann::json* value_;
    std::string file_;
    std::string pointer_;
    std::set<std::string> known_;
};

/// The candidate nearest to `word` by edit distance; nullopt if none is near enough to be a typing error.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace rowland
