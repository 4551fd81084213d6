// Baking the compact disc for each representation: what the cooker does for a material.
#include <string>

#include "modules/diffraction/asset/cooked_material.h"
#include "tests/benchmark/cd_materials.h"
#include "tests/benchmark/microbenchmarks.h"

namespace rowland::microbenchmark {

void register_bakes() {
    for (const auto& representation : rowland::benchmark::timed_representations()) {
        const auto bake = [material = rowland::benchmark::material_of(representation)](::benchmark::State& state) {
            const diffraction::Material parsed = diffraction::parse_material(material, "the CD");
            for (auto _ : state) ::benchmark::DoNotOptimize(diffraction::bake_material(parsed).kernel.error);
        };
        ::benchmark::RegisterBenchmark(("bake/" + representation.name).c_str(), bake)
            ->Unit(::benchmark::kMillisecond)
            ->UseRealTime();
    }
}

}  // namespace rowland::microbenchmark
