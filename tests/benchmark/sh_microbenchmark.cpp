#include <cmath>
#include <string>

#include "engine/core/parallel.h"
#include "engine/math/frame_rotation.h"
#include "engine/math/spherical_harmonics.h"
#include "tests/benchmark/microbenchmarks.h"

// Spherical harmonics in double: evaluation, and building and applying a rotation.
// RGB light turned into the tangent frames of a mesh of 25 000 vertices, as coefficients and as 2n − 1 moments.

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

namespace {

using ::benchmark::DoNotOptimize;
using ::benchmark::State;

constexpr std::size_t kVertices = 25000;

std::vector<glm::dvec3> some_light(int bands) {
    std::vector<glm::dvec3> light;
    for (int i = 0; i < math::sh_count(bands); ++i) light.emplace_back(std::cos(i), std::cos(2 * i), std::cos(3 * i));
    return light;
}

/// A matrix as sparse as that of arc moments in a tangent frame: functions odd across the grooves' plane drop out, and
/// each row has the functions of one parity.
math::FrameProjection some_projection(int bands) {
    std::vector<double> matrix;
    for (int row = 0; row < 2 * bands - 1; ++row)
        for (int l = 0; l < bands; ++l)
            for (int m = -l; m <= l; ++m) matrix.push_back(m >= 0 && m % 2 == row % 2 ? std::cos(row + l) : 0.0);
    return {matrix, bands};
}

void rotate_slowly(State& state, int bands) {
    const RandomFrames frames(kVertices);
    const auto light = some_light(bands);
    std::vector<glm::dvec3> rotated(light.size());
    for (auto _ : state)
        for (std::size_t i = 0; i < kVertices; ++i) {
            const glm::dvec3 g(frames.tangent[0][i], frames.tangent[1][i], frames.tangent[2][i]);
            const glm::dvec3 n(frames.normal[0][i], frames.normal[1][i], frames.normal[2][i]);
            const glm::dmat3 rows = glm::transpose(glm::dmat3(g, glm::cross(n, g), n));
            math::ShRotation(rows, bands).apply(std::span<const glm::dvec3>(light), rotated);
            DoNotOptimize(rotated.data());
        }
    report_each(state, kVertices);
}

void rotate_fast(State& state, int bands, unsigned threads, math::InstructionSet set) {
    const ThreadLimit limit(threads);
    const RandomFrames frames(kVertices);
    const auto light = some_light(bands);
    std::vector<float> rotated(kVertices * light.size() * 3);
    for (auto _ : state) {
        math::rotate_to_frames(light, bands, frames.arrays(), rotated, set);
        DoNotOptimize(rotated.data());
    }
    report_each(state, kVertices);
}

void project(State& state, int bands, unsigned threads, math::InstructionSet set) {
    const ThreadLimit limit(threads);
    const RandomFrames frames(kVertices);
    const auto light = some_light(bands);
    const math::FrameProjection projection = some_projection(bands);
    std::vector<float> moments(kVertices * static_cast<std::size_t>(projection.rows()) * 3);
    for (auto _ : state) {
        math::rotate_and_project(light, frames.arrays(), projection, moments, set);
        DoNotOptimize(moments.data());
    }
    report_each(state, kVertices);
}

/// Processor time where one thread does all the work: other programs on the machine disturb it less.
template <typename F, typename... Arguments>
void add(const std::string& name, unsigned threads, F function, Arguments... arguments) {
    auto* benchmark =
        ::benchmark::RegisterBenchmark((name + "/threads:" + std::to_string(threads)).c_str(), function, arguments...);
    benchmark->Unit(::benchmark::kMillisecond);
    if (threads > 1) benchmark->UseRealTime();
}

}  // namespace

void register_frame_rotation() {
    for (const int bands : {5, 11}) {
        const std::string suffix = "/bands:" + std::to_string(bands);
        add("vertex_light/double" + suffix, 1, rotate_slowly, bands);
        for (const auto set : {math::InstructionSet::Baseline, math::InstructionSet::Avx2}) {
            if (!math::is_supported(set)) continue;
            const std::string path = std::string("/") + math::instruction_set_name(set) + suffix;
            for (const unsigned threads : {1U, 2U}) {
                add("vertex_light" + path, threads, rotate_fast, bands, threads, set);
                add("vertex_moments" + path, threads, project, bands, threads, set);
            }
        }
    }
}

}  // namespace rowland::microbenchmark
