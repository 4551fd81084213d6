#include "engine/core/json_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"

namespace rowland {

namespace {

constexpr int kMaximumDepth = 64;

/// The value as JSON, for messages, cut to 40 bytes.
std::string describe(const nlohmann::json& value) {
    std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (text.size() <= 40) return text;
    std::size_t end = 37;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // whole UTF-8 characters only
    return text.substr(0, end) + "...";
}

std::string describe(const NumberRange& range) {
    const bool bounded_below = std::isfinite(range.minimum);
    const bool bounded_above = std::isfinite(range.maximum);
    if (bounded_below && bounded_above)
        return fmt::format("a number in {}{}, {}{}", range.exclusive_minimum ? '(' : '[', range.minimum, range.maximum,
                           range.exclusive_maximum ? ')' : ']');
    if (bounded_below) return fmt::format("a number {} {}", range.exclusive_minimum ? ">" : ">=", range.minimum);
    if (bounded_above) return fmt::format("a number {} {}", range.exclusive_maximum ? "<" : "<=", range.maximum);
    return "a number";
}

bool inside(double x, const NumberRange& range) {
    return std::isfinite(x) && (range.exclusive_minimum ? x > range.minimum : x >= range.minimum) &&
           (range.exclusive_maximum ? x < range.maximum : x <= range.maximum);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({substitution, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

/// Counts the keys of a JSON text. Refuses deep nesting before any recursive function sees the document.
std::size_t check_depth(std::string_view text, const std::string& file) {
    int depth = 0;
    bool in_string = false;
    std::size_t keys = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == ':') {
            ++keys;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaximumDepth)
                refuse_input(file, fmt::format("byte {}", i), "JSON nested too deep",
                             fmt::format("at most {} levels", kMaximumDepth));
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return keys;
}

std::size_t count_keys(const nlohmann::json& value) {
    std::size_t keys = value.is_object() ? value.size() : 0;
    if (value.is_structured())
        for (const nlohmann::json& element : value) keys += count_keys(element);
    return keys;
}

/// A key as a step of a JSON pointer (RFC 6901).
std::string pointer_step(const std::string& key) {
    std::string step;
    for (const char c : key) {
        if (c == '~')
            step += "~0";
        else if (c == '/')
            step += "~1";
        else
            step += c;
    }
    return step;
}

/// The JSON pointer of the first repeated key of an object in `text`; empty if there is none.
std::string find_repeated_key(std::string_view text) {
    using Event = nlohmann::json::parse_event_t;
    struct Level {
        bool is_array;
        std::size_t index = 0;  ///< of the array's next element
        std::string step = {};
        std::set<std::string> keys = {};
    };
    std::vector<Level> levels;
    std::string repeated;
    const nlohmann::json unused = nlohmann::json::parse(text, [&](int, Event event, nlohmann::json& value) {
        const bool ends = event == Event::object_end || event == Event::array_end;
        if (!ends && event != Event::key && !levels.empty() && levels.back().is_array)
            levels.back().step = fmt::format("{}", levels.back().index++);
        if (ends) levels.pop_back();
        if (event == Event::object_start || event == Event::array_start)
            levels.push_back({.is_array = event == Event::array_start});
        if (event == Event::key) {
            levels.back().step = pointer_step(value.get<std::string>());
            if (!levels.back().keys.insert(levels.back().step).second && repeated.empty())
                for (const Level& level : levels) repeated += "/" + level.step;
        }
        return true;
    });
    return repeated;
}

/// A value within the limits.
double typical(const NumberRange& range) {
    if (inside(1.0, range)) return 1.0;
    return std::isfinite(range.minimum) && std::isfinite(range.maximum) ? 0.5 * (range.minimum + range.maximum)
                                                                        : std::max(range.minimum, range.maximum);
}

}  // namespace

nlohmann::json parse_json(std::string_view text, const std::string& file) {
    const std::size_t keys = check_depth(text, file);
    // nlohmann::json takes a null character for the end of the text.
    if (const std::size_t null = text.find('\0'); null != std::string_view::npos)
        refuse_input(file, fmt::format("byte {}", null), "a null character", "valid JSON");
    try {
        nlohmann::json json = nlohmann::json::parse(text);
        // Of two equal keys the library keeps one without saying so.
        if (count_keys(json) != keys)
            refuse_input(file, find_repeated_key(text), "a repeated key", "each key once", "remove one of the two");
        return json;
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t end = std::min(error.byte == 0 ? 0 : error.byte - 1, text.size());
        const std::string_view before = text.substr(0, end);
        const auto line = std::count(before.begin(), before.end(), '\n') + 1;
        const auto line_start = before.rfind('\n');
        const std::size_t column = before.size() - (line_start == std::string_view::npos ? 0 : line_start + 1) + 1;
        // The library's prefix up to ": " repeats the position.
        std::string reason = error.what();
        if (const auto prefix = reason.find(": "); prefix != std::string::npos) reason = reason.substr(prefix + 2);
        refuse_input(file, fmt::format("line {}, column {}", line, column), reason, "valid JSON");
    } catch (const nlohmann::json::out_of_range& error) {
        // The library says which number it is, but not where.
        std::string reason = error.what();
        if (const auto end = reason.find("] "); end != std::string::npos) reason = reason.substr(end + 2);
        refuse_input(file, "", reason, "numbers that fit a double");
    }
}

JsonReader::JsonReader(const nlohmann::json& value, std::string file, std::string pointer)
    : value_(&value), file_(std::move(file)), pointer_(std::move(pointer)) {
    if (!value.is_object()) refuse_input(file_, pointer_.empty() ? "/" : pointer_, describe(value), "an object");
}

using Kind = JsonShape::Kind;

bool JsonReader::recorded(const std::string& key, const JsonShape& shape) {
    if (recorder_) recorder_->record(key, !known_.contains(key), shape);
    return recorder_ != nullptr;
}

bool JsonReader::has(const std::string& key) {
    known_.insert(key);
    return recorder_ != nullptr || value_->contains(key);
}

void JsonReader::refuse_if_there(const std::string& key, const std::string& found, const std::string& expected,
                                 const std::string& remedy) {
    if (!recorder_ && has(key)) fail(key, found, expected, remedy);
}

void JsonReader::ignore(const std::string& key) {
    has(key);
    recorded(key, {});
}

const nlohmann::json& JsonReader::require(const std::string& key) {
    known_.insert(key);
    const auto it = value_->find(key);
    if (it != value_->end()) return *it;
    // A misspelt key explains a missing one.
    std::vector<std::string> present;
    for (const auto& [name, ignored] : value_->items()) present.push_back(name);
    if (const auto near = nearest_word(key, present))
        fail(key, "missing", "a value", fmt::format("is \"{}\" meant to be \"{}\"?", *near, key));
    // So does a misspelt key of an alternative.
    const std::vector<std::string> asked(known_.begin(), known_.end());
    for (const std::string& name : present)
        if (const auto near = known_.contains(name) ? std::nullopt : nearest_word(name, asked))
            fail(key, "missing", "a value", fmt::format("is \"{}\" meant to be \"{}\"?", name, *near));
    fail(key, "missing", "a value", "add it");
}

double JsonReader::number(const std::string& key, NumberRange range) {
    if (recorded(key, {.kind = Kind::Number, .range = range})) return typical(range);
    const nlohmann::json& value = require(key);
    if (!value.is_number() || !inside(value.get<double>(), range)) fail(key, describe(value), describe(range));
    return value.get<double>();
}

double JsonReader::number_or(const std::string& key, double fallback, NumberRange range) {
    return has(key) ? number(key, range) : fallback;
}

std::int64_t JsonReader::integer(const std::string& key, std::int64_t minimum, std::int64_t maximum) {
    const NumberRange range{.minimum = static_cast<double>(minimum), .maximum = static_cast<double>(maximum)};
    if (recorded(key, {.kind = Kind::Integer, .range = range})) return std::clamp<std::int64_t>(1, minimum, maximum);
    const nlohmann::json& value = require(key);
    const std::string expected = fmt::format("a whole number in [{}, {}]", minimum, maximum);
    if (value.is_number_unsigned()) {
        const auto x = value.get<std::uint64_t>();
        if (maximum < 0 || x > static_cast<std::uint64_t>(maximum)) fail(key, describe(value), expected);
    }
    if (!value.is_number_integer()) fail(key, describe(value), expected);
    const auto x = value.get<std::int64_t>();
    if (x < minimum || x > maximum) fail(key, describe(value), expected);
    return x;
}

std::int64_t JsonReader::integer_or(const std::string& key, std::int64_t fallback, std::int64_t minimum,
                                    std::int64_t maximum) {
    return has(key) ? integer(key, minimum, maximum) : fallback;
}

std::string JsonReader::text(const std::string& key) {
    if (recorded(key, {.kind = Kind::Text})) return "text";
    const nlohmann::json& value = require(key);
    if (!value.is_string()) fail(key, describe(value), "a string");
    return value.get<std::string>();
}

std::string JsonReader::text_or(const std::string& key, std::string fallback) {
    return has(key) ? text(key) : std::move(fallback);
}

std::string JsonReader::file_name(const std::string& key, const std::string& what) {
    if (recorded(key, {.kind = Kind::Text, .least = 1})) return "file";
    std::string name = text(key);
    if (name.empty()) fail(key, "an empty name", what);
    return name;
}

bool JsonReader::boolean_or(const std::string& key, bool fallback) {
    if (!has(key) || recorded(key, {.kind = Kind::Boolean})) return fallback;
    const nlohmann::json& value = require(key);
    if (!value.is_boolean()) fail(key, describe(value), "true or false");
    return value.get<bool>();
}

std::vector<double> JsonReader::numbers(const std::string& key, std::size_t count, NumberRange range) {
    if (recorded(key, {.kind = Kind::Numbers, .range = range, .least = count, .most = count}))
        return std::vector<double>(count, typical(range));
    const nlohmann::json& value = require(key);
    if (!value.is_array() || value.size() != count) fail(key, describe(value), fmt::format("{} numbers", count));
    std::vector<double> result;
    for (const nlohmann::json& element : value) {
        if (!element.is_number() || !inside(element.get<double>(), range))
            fail(fmt::format("{}/{}", key, result.size()), describe(element), describe(range));
        result.push_back(element.get<double>());
    }
    return result;
}

std::ptrdiff_t JsonReader::choice_index(const std::string& key, const std::vector<std::string_view>& choices) {
    if (recorded(key, {.kind = Kind::Choice, .choices = choices})) return 0;
    const std::string word = text(key);
    const auto found = std::find(choices.begin(), choices.end(), word);
    if (found != choices.end()) return found - choices.begin();
    const auto near = nearest_word(word, {choices.begin(), choices.end()});
    fail(key, fmt::format("\"{}\"", word), fmt::format("one of {}", fmt::join(choices, ", ")),
         near ? fmt::format("is \"{}\" meant?", *near) : "");
}

std::string JsonReader::choice(const std::string& key, const std::vector<std::string_view>& choices) {
    return std::string(choices[static_cast<std::size_t>(choice_index(key, choices))]);
}

std::string JsonReader::choice_or(const std::string& key, std::string fallback,
                                  const std::vector<std::string_view>& choices) {
    return has(key) ? choice(key, choices) : std::move(fallback);
}

JsonReader JsonReader::object(const std::string& key) {
    if (recorded(key, {.kind = Kind::Object})) return JsonReader(recorder_->child(key));
    return {require(key), file_, pointer_to(key)};
}

std::optional<JsonReader> JsonReader::object_if_there(const std::string& key) {
    return has(key) ? std::optional(object(key)) : std::nullopt;
}

const nlohmann::json& JsonReader::raw(const std::string& key) {
    static const nlohmann::json recorded_value;
    return recorded(key, {}) ? recorded_value : require(key);
}

std::vector<JsonReader> JsonReader::read_array(const std::string& key) {
    const nlohmann::json& value = require(key);
    if (!value.is_array()) fail(key, describe(value), "an array of objects");
    std::vector<JsonReader> result;
    for (std::size_t i = 0; i < value.size(); ++i)
        result.emplace_back(value[i], file_, fmt::format("{}/{}", pointer_to(key), i));
    return result;
}

std::vector<JsonReader> JsonReader::objects(const std::string& key, std::size_t least, std::size_t most) {
    if (recorded(key, {.kind = Kind::Objects, .least = least, .most = most}))
        return {JsonReader(recorder_->child(key))};
    std::vector<JsonReader> result = read_array(key);
    if (result.size() < least || (most > 0 && result.size() > most))
        fail(key, fmt::format("{} objects", result.size()), fmt::format("{} to {} objects", least, most));
    return result;
}

std::vector<JsonReader> JsonReader::objects_if_there(const std::string& key) {
    return has(key) ? objects(key) : std::vector<JsonReader>();
}

std::vector<JsonReader> JsonReader::object_or_objects(const std::string& key, std::size_t most) {
    if (recorded(key, {.kind = Kind::ObjectOrObjects, .least = 1, .most = most}))
        return {JsonReader(recorder_->child(key))};
    if (require(key).is_array()) return objects(key, 1, most);
    return {object(key)};
}

void JsonReader::variant(const std::string& key, const std::vector<std::string_view>& words,
                         const std::function<void(JsonReader&, std::size_t)>& read) {
    if (!recorder_) return read(*this, static_cast<std::size_t>(choice_index(key, words)));
    const auto parts = recorder_->split(words.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        JsonReader part(parts[i]);
        part.choice(key, {words[i]});
        read(part, i);
    }
}

void JsonReader::alternatives(const std::string& key, const std::function<void(JsonReader&)>& with,
                              const std::function<void(JsonReader&)>& without) {
    alternatives({{key, with}}, without);
}

void JsonReader::alternatives(const std::vector<std::pair<std::string, std::function<void(JsonReader&)>>>& keys,
                              const std::function<void(JsonReader&)>& without) {
    if (!recorder_) {
        // Without std::ranges, which the web's library lacks.
        const auto there = std::find_if(keys.begin(), keys.end(), [&](const auto& one) { return has(one.first); });
        return there != keys.end() ? there->second(*this) : without(*this);
    }
    const auto parts = recorder_->split(keys.size() + 1);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        JsonReader part(parts[i]);
        i < keys.size() ? keys[i].second(part) : without(part);
    }
}

void JsonReader::annotate(const std::string& key, std::string_view keywords) {
    if (recorder_) recorder_->annotate(key, keywords);
}

void JsonReader::also_allows(const std::string& key, std::string_view schema) {
    if (recorder_) recorder_->also_allows(key, schema);
}

void JsonReader::finish() const {
    if (recorder_) return recorder_->close();
    for (const auto& [key, ignored] : value_->items()) {
        if (known_.contains(key)) continue;
        const std::vector<std::string> valid(known_.begin(), known_.end());
        const auto near = nearest_word(key, valid);
        fail(pointer_step(key), "unknown key", fmt::format("one of {}", fmt::join(valid, ", ")),
             near ? fmt::format("is \"{}\" meant?", *near) : "remove it");
    }
}

void JsonReader::fail(const std::string& key, std::string found, std::string expected, std::string remedy) const {
    refuse_input(file_, pointer_to(key), std::move(found), std::move(expected), std::move(remedy));
}

std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
    std::optional<std::string> best;
    std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        // The lengths alone bound the distance from below; a hostile word may be megabytes long.
        const std::size_t longer = std::max(word.size(), candidate.size());
        if (longer - std::min(word.size(), candidate.size()) >= best_distance) continue;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace rowland
