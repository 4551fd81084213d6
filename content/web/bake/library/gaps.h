#pragma once
// What emscripten's C++ library (3.1.6) lacks of the standard one; included before every source of the bake.
#include <stdlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <string>

namespace std {

/// The value of the same bits.
template <typename To, typename From>
constexpr To bit_cast(const From& from) {
    return __builtin_bit_cast(To, from);
}

/// Of a decimal number.
inline from_chars_result from_chars(const char* begin, const char* end, double& value) {
    const string text(begin, end);
    char* after = nullptr;
    const double read = strtod(text.c_str(), &after);
    if (after == text.c_str()) return {begin, errc::invalid_argument};
    value = read;
    return {begin + (after - text.c_str()), errc()};
}

inline double lerp(float a, float b, double t) {
    return lerp(double{a}, double{b}, t);
}

namespace ranges {

template <typename Range, typename Predicate>
bool all_of(const Range& range, Predicate holds) {
    return std::all_of(range.begin(), range.end(), holds);
}

template <typename Range, typename Value>
bool binary_search(const Range& range, const Value& value) {
    return std::binary_search(range.begin(), range.end(), value);
}

/// Sorts by the projection, ascending.
template <typename Range, typename Projection>
void sort(Range& range, std::less<>, Projection projection) {
    std::sort(range.begin(), range.end(), [&](const auto& a, const auto& b) { return projection(a) < projection(b); });
}

}  // namespace ranges

}  // namespace std
