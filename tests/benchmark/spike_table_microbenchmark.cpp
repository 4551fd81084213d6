// Baking the paper's compact disc: four spikes of five bands over 32 × 64 views.
#include "modules/diffraction/bake/spike_table.h"
#include "tests/benchmark/microbenchmarks.h"

namespace rowland::microbenchmark {

namespace {

void bake(::benchmark::State& state) {
    diffraction::Grating grating;
    grating.pitch_nm = 1600;
    grating.profile = diffraction::SlitProfile{.width_nm = 800};
    for (auto _ : state)
        ::benchmark::DoNotOptimize(
            diffraction::bake_spike_table(grating, diffraction::SpikeTableSettings{}).texels.data());
}

}  // namespace

void register_spike_table() {
    ::benchmark::RegisterBenchmark("bake_spike_table/cd", bake)->Unit(::benchmark::kMillisecond)->UseRealTime();
}

}  // namespace rowland::microbenchmark
