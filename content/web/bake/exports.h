#pragma once

#include <type_traits>
#include <vector>

/// A function that the page's worker calls.
#define ROWLAND_EXPORT(name) extern "C" __attribute__((export_name(#name)))

/// A function of the worker: src/module.ts of the package.
#define ROWLAND_IMPORT(name) __attribute__((import_module("worker"), import_name(#name)))

namespace rowland::web {

/// What a call gives back: a list of numbers, which the worker copies and releases.
using Numbers = std::vector<float>;

/// Appends a value that consists of floats alone, such as a glm::vec3.
template <typename Value>
void append(const Value& value, Numbers& numbers) {
    static_assert(std::is_trivially_copyable_v<Value>);
    static_assert(sizeof(Value) % sizeof(float) == 0);
    const auto* floats = reinterpret_cast<const float*>(&value);
    numbers.insert(numbers.end(), floats, floats + sizeof(Value) / sizeof(float));
}

}  // namespace rowland::web
