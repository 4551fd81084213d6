#pragma once

#include <map>
#include <optional>
#include <utility>

#include "modules/diffraction/evaluate/evaluation_light.h"

namespace rowland::diffraction {

/// A probe's light, split into key lights and the rest in every way that was asked for. Each split is computed once.
/// For one thread at a time.
class ProbeLights {
 public:
    /// `image` must outlive it. `bands` are projected once for all splits; 0: each split projects the bands it needs.
    explicit ProbeLights(const lighting::ProbeImage& image, int bands = 0) : image_(&image), bands_(bands) {}

    const lighting::ProbeImage& image() const { return *image_; }
    /// The light with at most so many key lights. The reference stays valid.
    const EvaluationLight& split(int key_lights, math::SphericalWindow window = math::SphericalWindow::None);

 private:
    const lighting::ProbeImage* image_;
    int bands_;
    std::optional<lighting::ShLight> projected_;
    std::map<std::pair<int, math::SphericalWindow>, EvaluationLight> splits_;
};

}  // namespace rowland::diffraction
