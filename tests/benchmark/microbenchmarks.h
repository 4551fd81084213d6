#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>

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

}  // namespace rowland::microbenchmark
