#include "editor/trade/measure_frame.h"

#include <algorithm>
#include <limits>

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
double FrameTimer::fastest(Show&& show) {
    show();
    double ms = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kWarmUpFrames; ++i) stage_.draw();
    for (int i = 0; i < kFramesPerRound; ++i) {
        ms = std::min(ms, stage_.draw());
        if (ms > kSlow_ms) break;
    }
    return ms;
}

FrameTime FrameTimer::time(const diffraction::CookedMaterial& material, int key_lights) {
    light_by(key_lights);
    FrameTime result{.ms = std::numeric_limits<double>::infinity(),
                     .plain_ms = std::numeric_limits<double>::infinity()};
    const auto grating = stage_.upload(material);
    for (int round = 0; round < kRounds && !(round > 0 && result.ms > kSlow_ms); ++round) {
        result.plain_ms = std::min(result.plain_ms, fastest([&] { stage_.show_plain(); }));
        result.ms = std::min(result.ms, fastest([&] { stage_.show_grating(grating); }));
    }
    return result;
}

}  // namespace rowland::trade
