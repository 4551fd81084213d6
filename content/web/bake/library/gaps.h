#pragma once
// What emscripten's C++ library (3.1.6) lacks of the standard one; included before every source of the bake.
#include <stdlib.h>

#include <charconv>
#include <string>

namespace std {

/// The value of the same bits.
template <typename To, typename From>
constexpr To bit_cast(const From& from) {
    return __builtin_bit_cast(To, from);
}

/// A decimal number.
inline from_chars_result from_chars(const char* begin, const char* end, double& value) {
    const string text(begin, end);
    char* after = nullptr;
    const double read = strtod(text.c_str(), &after);
    if (after == text.c_str()) return {begin, errc::invalid_argument};
    value = read;
    return {begin + (after - text.c_str()), errc()};
}

}  // namespace std
