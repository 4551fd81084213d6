#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// The layout of an object with these points, at least one.
GrooveLayout layout_of(std::span<const ShadingPoint> points);
/// The tables, or the material with the tables, that an object of that layout is drawn with. Only those of `planar`
/// depend on it.
BakedTables drawn_tables(const BakedTables& tables, GrooveLayout layout);
CookedMaterial as_drawn(const CookedMaterial& cooked, GrooveLayout layout);

/// Shades points of one side of a baked material as evaluate_baked() does; both arguments must outlive it. Maps are
/// filled on first use and kept. A sheet that transmits is shaded at lit_from_behind() of its points. `planar` keeps
/// the map of the last plane, so that its shader is for one thread at a time.
PointShader baked_shader(const CookedMaterial& cooked, const EvaluationLight& light);

/// XYZ of points by a baked material, as its shaders compute it: the tables or the map for the residual light, and
/// `direct` for the key lights. `planar` fills a map for every plane among the points, whose points are taken for those
/// of one object: a map of one azimuth where they share g. Views below the horizon are black.
std::vector<glm::dvec3> evaluate_baked(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const ShadingPoint> frames);
/// The same for points of objects of that layout.
std::vector<glm::dvec3> evaluate_baked(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const ShadingPoint> frames, GrooveLayout layout);

/// Adds what a sheet's other side, cooked.reflected, reflects to `xyz`, a value per frame; nothing without one.
void add_reflected_side(const CookedMaterial& cooked, const EvaluationLight& light,
                        std::span<const ShadingPoint> frames, std::vector<glm::dvec3>& xyz);

/// XYZ of points by `shader` instead of the material's tables, plus the key lights; of one side of a sheet.
std::vector<glm::dvec3> evaluate_points(const std::string& title, const PointShader& shader,
                                        const CookedMaterial& cooked, const EvaluationLight& light,
                                        std::span<const ShadingPoint> frames);

/// Shades with spikes that are baked for the view of each point.
PointShader exact_spikes(const Grating& grating, const SpikeSettings& settings, const EvaluationLight& light);

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

    /// `window`: of the light's harmonics. `layout`: of the object that the point is on. The frame must be valid.
    /// Throws Error (input) where the material cannot be evaluated under a probe.
    PointComparison compare(const std::shared_ptr<const CookedMaterial>& cooked, math::SphericalWindow window,
                            const ShadingPoint& frame, GrooveLayout layout);

    /// SH of the probe's light, of so many bands and without a window, less its first `key_lights` key lights.
    lighting::ShLight harmonics(int key_lights, int bands);

 private:
    /// The last material, ready to shade.
    struct Ready {
        std::shared_ptr<const CookedMaterial> cooked;
        GrooveLayout layout;
        const EvaluationLight* light;
        std::unique_ptr<const CookedMaterial> drawn;  ///< as_drawn()
        PointShader shader;
    };

    std::unique_ptr<const lighting::ProbeImage> probe_;  ///< on the heap: the lights refer to it
    int fitted_;
    ProbeLights lights_;
    std::optional<Ready> ready_;
};

}  // namespace rowland::diffraction
