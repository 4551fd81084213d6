#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "engine/lighting/probe_image.h"
#include "engine/math/sh_window.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/model/shading_point.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace rowland::diffraction {

/// XYZ of one point's listed orders under a probe: no base layer, no mirror, no other lights.
struct PointComparison {
    glm::dvec3 shown{0.0};      ///< as the material's representation shades it, as evaluate_baked()
    glm::dvec3 reference{0.0};  ///< reference_radiance() at the material's illuminant
    double error = 0.0;         ///< relative_rms() of the two
};

/// Compares points with the reference one after the other, under one probe. Data of the probe and the material are
/// computed once. For one thread at a time.
class PointComparer {
 public:
    /// `key_lights`: the most that are extracted from the probe; materials shade the first of them one by one.
    PointComparer(lighting::ProbeImage probe, int key_lights);

    /// `window`: on the light of tables over harmonics. The frame must be valid. Throws Error (input) where the
    /// material cannot be evaluated under a probe.
    PointComparison compare(const std::shared_ptr<const CookedMaterial>& cooked, math::SphericalWindow window,
                            const ShadingPoint& frame);

    /// The light without so many key lights that tables over so many bands take, without a window.
    lighting::ShLight harmonics(int key_lights, int bands);

 private:
    /// The last material, ready to shade.
    struct Ready {
        std::shared_ptr<const CookedMaterial> cooked;
        const EvaluationLight* light = nullptr;
        PointShader shader;
    };

    std::unique_ptr<const lighting::ProbeImage> probe_;  ///< on the heap: the lights refer to it
    int fitted_;
    ProbeLights lights_;
    std::optional<Ready> ready_;
};

}  // namespace rowland::diffraction
