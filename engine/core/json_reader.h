#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rowland {

/// Parses JSON text that may be hostile. Throws Error (input): with line and column for bad syntax and invalid UTF-8,
/// with the byte offset for nesting deeper than 64 and for a null character, with the JSON pointer for a repeated key
/// of an object, and for a number that does not fit a double.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// A number's domain; messages show it as an interval.
struct NumberRange {
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    bool exclusive_minimum = false;
    bool exclusive_maximum = false;
};

/// What a float can hold.
inline constexpr NumberRange kFiniteFloat{.minimum = std::numeric_limits<float>::lowest(),
                                          .maximum = std::numeric_limits<float>::max()};
inline constexpr NumberRange kFraction{.minimum = 0.0, .maximum = 1.0};
inline constexpr NumberRange kPositive{.minimum = 0.0, .exclusive_minimum = true};

/// What a parser expects of a member.
struct JsonShape {
    enum class Kind { Any, Number, Integer, Boolean, Text, Numbers, Choice, Object, Objects, ObjectOrObjects };
    Kind kind = Kind::Any;
    NumberRange range{};                      ///< of Number, Integer, Numbers
    std::size_t least = 0;                    ///< characters of a Text; elements of Numbers, Objects
    std::size_t most = 0;                     ///< elements of Numbers, Objects; 0: any number
    std::vector<std::string_view> choices{};  ///< of Choice
};

/// Records what a parser asks of an object; json_schema() makes a JSON Schema of it.
class JsonRecorder {
 public:
    virtual ~JsonRecorder() = default;
    virtual void record(const std::string& key, bool required, const JsonShape& shape) = 0;
    /// The recorder of the object, or of each object of the array, under a recorded key.
    virtual std::shared_ptr<JsonRecorder> child(const std::string& key) = 0;
    /// Recorders of `count` alternatives, each with all that was recorded so far. What is recorded here from now on is
    /// recorded in all of them.
    virtual std::vector<std::shared_ptr<JsonRecorder>> split(std::size_t count) = 0;
    /// No other keys are allowed.
    virtual void close() = 0;
    /// See JsonReader::annotate() and also_allows().
    virtual void annotate(const std::string& key, std::string_view keywords) = 0;
    virtual void also_allows(const std::string& key, std::string_view schema) = 0;
};

/// Reads one JSON object strictly: every failure is an Error (input) that names the file, the JSON pointer, what was
/// found and what was expected, and finish() refuses keys that were not read, naming the nearest valid one.
///
/// A parser is also the source of its schema: json_schema() runs it with a reader that records (is_recording_schema()).
/// Such a reader has every key and returns values within their limits, so a parser must not check them further.
class JsonReader {
 public:
    /// `value` must outlive the reader. Throws if it is not an object.
    JsonReader(const nlohmann::json& value, std::string file, std::string pointer = "");
    explicit JsonReader(std::shared_ptr<JsonRecorder> recorder) : recorder_(std::move(recorder)) {}

    bool is_recording_schema() const { return recorder_ != nullptr; }
    /// Whether the key is there; finish() then accepts it. Always true if the reader records.
    bool has(const std::string& key);
    /// Fails with these parts if the key is there.
    void refuse_if_there(const std::string& key, const std::string& found, const std::string& expected,
                         const std::string& remedy = "");
    /// The key may be there with any value.
    void ignore(const std::string& key);
    double number(const std::string& key, NumberRange range);
    double number_or(const std::string& key, double fallback, NumberRange range);
    std::int64_t integer(const std::string& key, std::int64_t minimum, std::int64_t maximum);
    std::int64_t integer_or(const std::string& key, std::int64_t fallback, std::int64_t minimum, std::int64_t maximum);
    std::string text(const std::string& key);
    std::string text_or(const std::string& key, std::string fallback);
    /// A string that is not empty; the message expects `what`.
    std::string file_name(const std::string& key, const std::string& what);
    bool boolean_or(const std::string& key, bool fallback);
    /// An array of exactly `count` numbers.
    std::vector<double> numbers(const std::string& key, std::size_t count, NumberRange range);
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
    /// An array of at least `least` objects and, unless `most` is 0, at most `most`.
    std::vector<JsonReader> objects(const std::string& key, std::size_t least = 0, std::size_t most = 0);
    /// The same; empty if the key is missing.
    std::vector<JsonReader> objects_if_there(const std::string& key);
    /// An object, or an array of 1 to `most` objects.
    std::vector<JsonReader> object_or_objects(const std::string& key, std::size_t most);

    /// Calls `read` with the index of the word under `key`, one of `words`, to read the members that go with it.
    void variant(const std::string& key, const std::vector<std::string_view>& words,
                 const std::function<void(JsonReader&, std::size_t)>& read);
    /// Calls `with`, which must read the key, if the key is there, else `without`.
    void alternatives(const std::string& key, const std::function<void(JsonReader&)>& with,
                      const std::function<void(JsonReader&)>& without);
    /// The same for the first of several keys that is there.
    void alternatives(const std::vector<std::pair<std::string, std::function<void(JsonReader&)>>>& keys,
                      const std::function<void(JsonReader&)>& without);

    /// Adds keywords, as JSON text, to the JSON Schema of a member that was read: for what the calls above cannot
    /// express. The key "probes/items" is the schema of the elements of "probes".
    void annotate(const std::string& key, std::string_view keywords);
    /// The member may also satisfy this schema.
    void also_allows(const std::string& key, std::string_view schema);

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

    /// Records the member if this reader records.
    bool recorded(const std::string& key, const JsonShape& shape);
    std::vector<JsonReader> read_array(const std::string& key);

    const nlohmann::json* value_ = nullptr;
    std::string file_;
    std::string pointer_;
    std::set<std::string> known_;  ///< keys that were asked for
    std::shared_ptr<JsonRecorder> recorder_;
};

/// An array of numbers as a GLM vector. Throws Error (input).
template <typename Vector>
Vector read_vector(JsonReader& owner, const std::string& key, NumberRange range) {
    const std::vector<double> numbers = owner.numbers(key, static_cast<std::size_t>(Vector::length()), range);
    Vector vector;
    for (int i = 0; i < Vector::length(); ++i)
        vector[i] = static_cast<typename Vector::value_type>(numbers[static_cast<std::size_t>(i)]);
    return vector;
}

template <typename Vector>
Vector read_vector_or(JsonReader& owner, const std::string& key, const Vector& fallback, NumberRange range) {
    return owner.has(key) ? read_vector<Vector>(owner, key, range) : fallback;
}

/// The candidate nearest to `word` by edit distance; nullopt if the distance of each is more than 2 and more than a
/// third of the length of `word`.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace rowland
