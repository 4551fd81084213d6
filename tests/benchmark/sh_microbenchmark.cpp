// Spherical harmonics in double: evaluation, and building and applying a rotation.
#include <string>

#include "engine/math/sh_basis.h"
#include "engine/math/sh_rotation.h"
#include "tests/benchmark/microbenchmarks.h"
#include "tests/benchmark/random_frames.h"

namespace rowland::microbenchmark {

namespace {

using ::benchmark::DoNotOptimize;
using ::benchmark::State;

// Few enough for the coefficients to stay in the L2 cache; the row stride is not a power of two.
constexpr std::size_t kDirections = 1000;

void evaluate(State& state, int bands) {
    RandomDirections random;
    std::vector<glm::dvec3> directions(kDirections);
    for (glm::dvec3& d : directions) d = random.next();
    std::vector<double> values(static_cast<std::size_t>(math::sh_count(bands)));
    for (auto _ : state)
        for (const glm::dvec3& d : directions) {
            math::evaluate_sh(d, bands, values);
            DoNotOptimize(values.data());
        }
    report_each(state, kDirections);
}

glm::dmat3 some_rotation() {
    RandomDirections random;
    const glm::dvec3 n = random.next();
    const glm::dvec3 g = glm::normalize(glm::cross(n, random.next()));
    return glm::dmat3(g, glm::cross(n, g), n);
}

void build_rotation(State& state, int bands) {
    const glm::dmat3 matrix = some_rotation();
    for (auto _ : state) DoNotOptimize(math::ShRotation(matrix, bands).bands());
    report_each(state, 1);
}

template <typename T>
void apply_rotation(State& state, int bands) {
    const math::ShRotation rotation(some_rotation(), bands);
    const std::vector<T> light(static_cast<std::size_t>(math::sh_count(bands)), T(1.5));
    std::vector<T> rotated(light.size());
    for (auto _ : state) {
        rotation.apply(std::span<const T>(light), std::span<T>(rotated));
        DoNotOptimize(rotated.data());
    }
    report_each(state, 1);
}

}  // namespace

void register_sh_evaluation() {
    for (const int bands : {5, 11}) {
        const std::string name = "sh_evaluate/bands:" + std::to_string(bands) + "/double";
        ::benchmark::RegisterBenchmark(name.c_str(), evaluate, bands);
    }
}

void register_sh_rotation() {
    for (const int bands : {5, 11}) {
        const std::string suffix = "/bands:" + std::to_string(bands);
        ::benchmark::RegisterBenchmark(("sh_rotation_build" + suffix).c_str(), build_rotation, bands);
        ::benchmark::RegisterBenchmark(("sh_rotation_apply" + suffix + "/channels:1").c_str(), apply_rotation<double>,
                                       bands);
        ::benchmark::RegisterBenchmark(("sh_rotation_apply" + suffix + "/channels:3").c_str(),
                                       apply_rotation<glm::dvec3>, bands);
    }
}

}  // namespace rowland::microbenchmark
