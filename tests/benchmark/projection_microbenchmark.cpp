// A light probe's image projected onto five bands.
#include <string>

#include "engine/core/parallel.h"
#include "engine/lighting/probe_image.h"
#include "tests/benchmark/microbenchmarks.h"

namespace rowland::microbenchmark {

namespace {

void project_equirect(::benchmark::State& state, int width, unsigned threads) {
    const ThreadLimit limit(threads);
    image::Image image{width, width / 2, {}};
    for (int i = 0; i < image.width * image.height; ++i)
        image.texels.emplace_back(static_cast<float>(i % 97), static_cast<float>(i % 13), static_cast<float>(i % 29));
    const lighting::ProbeImage probe(std::move(image), lighting::Mapping::Equirectangular);
    for (auto _ : state) ::benchmark::DoNotOptimize(lighting::project(probe, 5).coefficients.data());
    report_each(state, 1);
}

}  // namespace

void register_projection() {
    for (const int width : {1024, 4096})
        for (const unsigned threads : {1U, 2U}) {
            const std::string name =
                "project_equirect/width:" + std::to_string(width) + "/bands:5/threads:" + std::to_string(threads);
            auto* benchmark = ::benchmark::RegisterBenchmark(name.c_str(), project_equirect, width, threads);
            benchmark->Unit(::benchmark::kMillisecond);
            if (threads > 1) benchmark->UseRealTime();
        }
}

}  // namespace rowland::microbenchmark
