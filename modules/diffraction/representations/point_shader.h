#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The cost of shading, as counts that depend on the material alone. A fetch reads a texel of four components.
struct ShadingCost {
    int fetches_per_vertex = 0;
    int multiply_adds_per_vertex = 0;
    int fetches_per_pixel = 0;        ///< without analytic and key lights
    int multiply_adds_per_pixel = 0;  ///< likewise
    int fetches_per_light = 0;        ///< per pixel and light that is shaded one by one
    int multiply_adds_per_light = 0;  ///< likewise
    std::size_t table_bytes = 0;      ///< as uploaded; maps that are filled at run time count in full, in half floats
    std::size_t vertex_bytes = 0;     ///< of light, per vertex
};

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

/// XYZ of one point. Under a cover, T(v_n) is left out (PHYSICS §10). May be called from many threads, except for
/// planar maps.
using PointShader = std::function<glm::dvec3(const ShadingPoint&)>;

/// The parts of a baked material that maps are filled from.
struct MaterialKernel {
    KernelTable kernel;
    double pitch_nm = 0.0;
    glm::dmat3 zero_order_xyz{0.0};  ///< ColourKernel::zero_order_xyz()
    std::optional<Cover> cover = std::nullopt;
};

/// Shades a tangent-frame view under light in the same frame.
using TangentShader = std::function<glm::dvec3(const lighting::ShLight&, const glm::dvec3& view)>;

/// Rotates the light into the tangent frame of each point and shades there. Views below the horizon are black.
PointShader in_tangent_frame(lighting::ShLight light, TangentShader shade);

/// Tables that are evaluated under the light's SH in the tangent frame.
template <typename Table>
concept HarmonicTable = requires(const Table& table, const lighting::ShLight& light, const glm::dvec3& view) {
    { table.bands } -> std::convertible_to<int>;
    { evaluate(table, light, view) } -> std::same_as<glm::dvec3>;
};

template <HarmonicTable Table>
PointShader point_shader(const Table& table, const MaterialKernel&, const EvaluationLight& light) {
    return in_tangent_frame(
        light.harmonics(table.bands),
        [table](const lighting::ShLight& rotated, const glm::dvec3& view) { return evaluate(table, rotated, view); });
}

}  // namespace rowland::diffraction
