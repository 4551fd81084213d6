#include "editor/trade/measure_frame.h"

#include <algorithm>
#include <iterator>

#include "editor/trade/other_load.h"
#include "editor/trade/picture_scene.h"

namespace rowland::trade {

namespace {

constexpr int kRounds = 3;
constexpr int kFramesPerRound = 2;
constexpr double kSlow_ms = 250.0;  ///< longer frames are timed once
constexpr int kWarmUpFrames = 2;    ///< not timed: programs are linked, key lights split off, maps filled

/// Key lights are fitted when a setting asks for them.
lighting::LightProbe without_key_lights(const lighting::ProbeImage& image) {
    lighting::LightProbeSettings settings;
    settings.key_lights = 0;
    return lighting::build_light_probe(image, settings);
}

}  // namespace

FrameTimer::FrameTimer(const lighting::ProbeImage& probe, glm::ivec2 size)
    : context_({.debug = false}),
      image_(&probe),
      probe_(without_key_lights(probe)),
      stage_(size, close_camera(), true) {}

void FrameTimer::light_by(int key_lights) {
    if (lit_by_ == key_lights) return;
    if (!fitted_.contains(key_lights)) fitted_[key_lights] = lighting::fit_key_lights(*image_, key_lights);
    probe_.key_lights = fitted_[key_lights];
    stage_.set_probe(probe_);
    lit_by_ = key_lights;
}

template <typename Show>
std::vector<double> FrameTimer::times(Show&& show) {
    show();
    std::vector<double> ms;
    for (int i = 0; i < kWarmUpFrames; ++i) stage_.draw();
    while (ms.size() < kFramesPerRound && (ms.empty() || ms.back() <= kSlow_ms)) ms.push_back(stage_.draw());
    return ms;
}

FrameTime FrameTimer::time(const diffraction::CookedMaterial& material, int key_lights) {
    light_by(key_lights);
    const auto grating = stage_.upload(material);
    const OtherLoad load;
    std::vector<double> plain;
    std::vector<double> ms;
    for (int round = 0; round < kRounds && (ms.empty() || std::ranges::min(ms) <= kSlow_ms); ++round) {
        std::ranges::copy(times([&] { stage_.show_plain(); }), std::back_inserter(plain));
        std::ranges::copy(times([&] { stage_.show_grating(grating); }), std::back_inserter(ms));
    }
    std::ranges::sort(ms);
    FrameTime result{.ms = ms.front(), .plain_ms = std::ranges::min(plain), .other_load = load.fraction()};
    if (ms.size() > 1) result.spread = ms[ms.size() / 2] / ms.front() - 1.0;
    return result;
}

}  // namespace rowland::trade
