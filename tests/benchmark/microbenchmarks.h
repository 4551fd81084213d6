#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "engine/math/frame_rotation.h"

// One file per subject; a subject registers its benchmarks when the main asks it to.
namespace rowland::microbenchmark {

void register_sh_evaluation();
void register_sh_rotation();
void register_frame_rotation();
void register_vertex_updates();
void register_projection();
void register_key_lights();
void register_bakes();
void register_brute_force();
void register_map_fills();
void register_entities();

/// Adds the column "each": seconds for one of the `items` of an iteration.
inline void report_each(::benchmark::State& state, std::size_t items) {
    state.counters["each"] = ::benchmark::Counter(
        static_cast<double>(items), ::benchmark::Counter::kIsIterationInvariantRate | ::benchmark::Counter::kInvert);
}

/// Unit vectors, the same on every run.
class RandomDirections {
 public:
    glm::dvec3 next() {
        for (;;) {
            const glm::dvec3 v(normal_(random_), normal_(random_), normal_(random_));
            if (glm::dot(v, v) > 1e-6) return glm::normalize(v);
        }
    }

 private:
    std::mt19937_64 random_{17};
    std::normal_distribution<double> normal_;
};

/// Orthonormal tangents and normals, one array per component.
struct RandomFrames {
    std::array<std::vector<float>, 3> tangent;
    std::array<std::vector<float>, 3> normal;

    explicit RandomFrames(std::size_t count) {
        RandomDirections directions;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 n = directions.next();
            const glm::dvec3 g = glm::normalize(glm::cross(n, directions.next()));
            for (int axis = 0; axis < 3; ++axis) {
                tangent[static_cast<std::size_t>(axis)].push_back(static_cast<float>(g[axis]));
                normal[static_cast<std::size_t>(axis)].push_back(static_cast<float>(n[axis]));
            }
        }
    }
    math::FrameArrays arrays() const {
        return {.tangent = {tangent[0], tangent[1], tangent[2]}, .normal = {normal[0], normal[1], normal[2]}};
    }
};

}  // namespace rowland::microbenchmark
