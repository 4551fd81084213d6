// Key lights of a light probe's image.
#include <cmath>
#include <string>

#include "engine/core/parallel.h"
#include "engine/lighting/key_lights.h"
#include "tests/benchmark/microbenchmarks.h"

namespace rowland::microbenchmark {

namespace {

/// Lamps of all sizes, from one texel on, before a dim wall.
lighting::ProbeImage lamps(int width) {
    image::Image image = image::make_image(width, width / 2);
    for (int i = 0; i < image.width * image.height; ++i) image.texels[static_cast<std::size_t>(i)] = glm::vec3(0.1F);
    for (int lamp = 0; lamp < 64; ++lamp) {
        const int size = 1 + lamp % 16;
        const int column = lamp * 7919 % (width - size);
        const int row = lamp * 104729 % (width / 2 - size);
        for (int i = 0; i < size * size; ++i)
            image.at(column + i % size, row + i / size) = glm::vec3(static_cast<float>(1e4 / (1 + lamp)));
    }
    return {std::move(image), lighting::Mapping::Equirectangular};
}

void fit_key_lights(::benchmark::State& state, int width, int count, unsigned threads) {
    const ThreadLimit limit(threads);
    const lighting::ProbeImage probe = lamps(width);
    for (auto _ : state) ::benchmark::DoNotOptimize(lighting::fit_key_lights(probe, count).data());
    report_each(state, 1);
}

}  // namespace

void register_key_lights() {
    for (const int width : {1024, 4096})
        for (const int count : {16, 32}) {
            const std::string name =
                "fit_key_lights/width:" + std::to_string(width) + "/lights:" + std::to_string(count) + "/threads:2";
            ::benchmark::RegisterBenchmark(name.c_str(), fit_key_lights, width, count, 2U)
                ->Unit(::benchmark::kMillisecond)
                ->UseRealTime();
        }
}

}  // namespace rowland::microbenchmark
