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

/// The light of an evaluation in the forms that the representations take: key lights, and the rest of the probe.
class EvaluationLight {
 public:
    /// A probe from which up to `key_lights` are extracted. `projected`: the probe's SH, if known.
    EvaluationLight(lighting::ProbeImage probe, int key_lights, math::SphericalWindow window,
                    lighting::ShLight projected = {});
    /// Band-limited light, without key lights.
    EvaluationLight(lighting::ShLight light, math::SphericalWindow window);

    std::span<const lighting::KeyLight> key_lights() const { return key_lights_; }
    /// The same light with only the first `key_lights` of its key lights; the others are part of the rest.
    EvaluationLight with_first(int key_lights) const;
    /// The light without key lights, in at most so many bands, windowed.
    lighting::ShLight harmonics(int bands) const;
    /// The light without key lights, at full resolution.
    lighting::LightSamples texels() const;
    /// The probe with its key lights; nullopt for band-limited light.
    const std::optional<lighting::ProbeImage>& probe() const { return probe_; }

 private:
    std::optional<lighting::ProbeImage> probe_;
    lighting::ShLight sh_;  ///< of the probe or, without a probe, the light itself
    std::vector<lighting::KeyLight> key_lights_;
    math::SphericalWindow window_;
};

/// Splits of a probe's light into key lights and the rest, each computed once. For one thread at a time.
class ProbeLights {
 public:
    /// `image` must outlive it. `bands` are projected once for all splits; 0: each split projects the bands it needs.
    /// `fitted`: how many key lights are fitted at once, as a cooked probe has them; 0: as many as a split asks for.
    explicit ProbeLights(const lighting::ProbeImage& image, int bands = 0, int fitted = 0)
        : image_(&image), bands_(bands), fitted_(fitted) {}

    /// The light with at most so many key lights: the first of those that are fitted. The reference stays valid.
    const EvaluationLight& split(int key_lights, math::SphericalWindow window = math::SphericalWindow::None);

 private:
    const lighting::ProbeImage* image_;
    int bands_;
    int fitted_;
    std::optional<lighting::ShLight> projected_;
    std::map<std::pair<int, math::SphericalWindow>, EvaluationLight> splits_;
};

}  // namespace rowland::diffraction
