#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/core/json_reader.h"

namespace rowland {

inline constexpr NumberRange kFraction{.minimum = 0.0, .maximum = 1.0};

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

}  // namespace rowland
