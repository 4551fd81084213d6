#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "editor/trade/stage.h"
#include "engine/lighting/probe_image.h"
#include "engine/platform/headless_context.h"

namespace rowland::trade {

/// A frame's time on this device: the least over rounds that alternate with the plain material.
struct FrameTime {
    double ms = 0.0;
    double plain_ms = 0.0;  ///< of the plain material without separate key lights; same mesh, camera and rounds
    std::optional<double> spread{};      ///< by how much the median of its frames is longer, relative; of two or more
    std::optional<double> other_load{};  ///< OtherLoad::fraction() of the rounds

    double ratio() const { return ms / plain_ms; }
};

/// Times frames of the stage's disc under one probe, in its own headless context.
class FrameTimer {
 public:
    FrameTimer(const lighting::ProbeImage& probe, glm::ivec2 size);

    FrameTime time(const diffraction::CookedMaterial& material, int key_lights);
    const std::string& device() const { return context_.renderer(); }

 private:
    void light_by(int key_lights);
    /// Milliseconds of frames after the warm-up.
    template <typename Show>
    std::vector<double> times(Show&& show);

    platform::HeadlessContext context_;
    const lighting::ProbeImage* image_;
    lighting::LightProbe probe_;
    std::map<int, std::vector<lighting::KeyLight>> fitted_;
    std::optional<int> lit_by_;
    Stage stage_;
};

}  // namespace rowland::trade
