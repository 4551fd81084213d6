#pragma once
// What the bake uses of {fmt}, in a twentieth of its size: each {…} becomes the next argument, whatever its format.
#include <string>
#include <string_view>
#include <type_traits>

namespace fmt {

/// Values with a text between each two.
template <typename Range>
struct Joined {
    const Range& values;
    std::string_view between;
};

template <typename Range>
Joined<Range> join(const Range& values, std::string_view between) {
    return {values, between};
}

std::string number_text(double number);

template <typename Value>
std::string text_of(const Value& value) {
    if constexpr (std::is_convertible_v<Value, std::string_view>) {
        return std::string(std::string_view(value));
    } else if constexpr (std::is_floating_point_v<Value>) {
        return number_text(static_cast<double>(value));
    } else if constexpr (std::is_same_v<Value, bool>) {
        return value ? "true" : "false";
    } else if constexpr (std::is_same_v<Value, char>) {
        return std::string(1, value);
    } else if constexpr (std::is_enum_v<Value>) {
        return std::to_string(static_cast<int>(value));
    } else {
        return std::to_string(value);
    }
}

template <typename Value>
std::string to_string(const Value& value) {
    return text_of(value);
}

template <typename Range>
std::string text_of(const Joined<Range>& joined) {
    std::string text;
    for (const auto& value : joined.values) {
        if (!text.empty()) text += joined.between;
        text += text_of(value);
    }
    return text;
}

/// The pattern with these texts in place of its {…}: the next one, or {0} by its number.
std::string fill(std::string_view pattern, const std::string* texts, std::size_t count);

template <typename... Args>
using format_string = std::string_view;

inline std::string format(std::string_view pattern) {
    return fill(pattern, nullptr, 0);
}

template <typename... Args>
std::string format(std::string_view pattern, const Args&... args) {
    const std::string texts[] = {text_of(args)...};
    return fill(pattern, texts, sizeof...(args));
}

template <typename Output, typename... Args>
void format_to(Output to, std::string_view pattern, const Args&... args) {
    for (const char c : format(pattern, args...)) *to++ = c;
}

}  // namespace fmt
