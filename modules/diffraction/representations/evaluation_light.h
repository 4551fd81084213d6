#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"

namespace rowland::diffraction {

/// The light of an evaluation in the forms that the representations take: key lights, and what they leave.
class EvaluationLight {
 public:
    /// A probe with up to so many key lights taken out of it. `projected`: the probe's SH, where somebody has them.
    EvaluationLight(lighting::ProbeImage probe, int key_lights, math::SphericalWindow window,
                    lighting::ShLight projected = {});
    /// Band-limited light, which has no bright parts to take out.
    EvaluationLight(lighting::ShLight light, math::SphericalWindow window);

    std::span<const lighting::KeyLight> key_lights() const { return key_lights_; }
    /// What the key lights leave, in at most so many bands, under the window.
    lighting::ShLight harmonics(int bands) const;
    /// What the key lights leave, at full resolution.
    lighting::LightSamples texels() const;
    /// The probe with its key lights; none for band-limited light.
    const std::optional<lighting::ProbeImage>& probe() const { return probe_; }

 private:
    std::optional<lighting::ProbeImage> probe_;
    lighting::ShLight sh_;  ///< without a probe the light itself
    std::vector<lighting::KeyLight> key_lights_;
    math::SphericalWindow window_;
};

/// A probe's light, split into key lights and the rest in every way that was asked for. Each split is computed once.
/// For one thread at a time.
class ProbeLights {
 public:
    /// `image` must outlive it. `bands` are projected once for all splits; 0: each split projects the bands it needs.
    explicit ProbeLights(const lighting::ProbeImage& image, int bands = 0) : image_(&image), bands_(bands) {}

    /// The light with at most so many key lights. The reference stays valid.
    const EvaluationLight& split(int key_lights, math::SphericalWindow window = math::SphericalWindow::None);

 private:
    const lighting::ProbeImage* image_;
    int bands_;
    std::optional<lighting::ShLight> projected_;
    std::map<std::pair<int, math::SphericalWindow>, EvaluationLight> splits_;
};

}  // namespace rowland::diffraction
