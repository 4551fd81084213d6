#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// Points of one object. A map of a flat object serves all points of its surface.
using Surface = std::vector<ShadingPoint>;

/// Whether all normals are equal.
bool is_flat(const Surface& surface);

/// XYZ of all points, surface by surface, as the cooked material's shaders give them. Curved surfaces are shaded by the
/// stand-in of a planar map.
std::vector<glm::dvec3> shade_surfaces(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const Surface> surfaces);

/// Surfaces under one probe, with the reference's XYZ of their points. Every error of a representation is measured
/// here: by the cooker's budget, the inspector and the sweep.
struct MeasuredScene {
    std::string name;  ///< labels the progress
    std::shared_ptr<ProbeLights> lights;
    std::vector<Surface> surfaces;
    std::size_t part;  ///< points per call of by_reference
    std::function<std::vector<glm::dvec3>(std::span<const ShadingPoint>)> by_reference;
    std::vector<glm::dvec3> reference{};  ///< of all points once it is prepared

    std::vector<ShadingPoint> points() const;  ///< of all surfaces
    /// Computes the reference unless it is known. False if it was stopped; another call continues.
    bool prepare(const std::stop_token& stop = {});
    std::vector<glm::dvec3> shaded(const CookedMaterial& cooked, int key_lights,
                                   math::SphericalWindow window = math::SphericalWindow::None) const {
        return shade_surfaces(cooked, lights->split(key_lights, window), surfaces);
    }
};

/// Light that an error is measured under.
struct BudgetProbe {
    std::string name;  ///< for messages and the record
    lighting::ProbeImage image;
    int key_lights = 16;  ///< that are extracted; a setting shades the first of them one by one
};

/// The cost of shading a pixel in texture fetches: a fixed count, never a timing. Eight multiply-adds count as a fetch,
/// and so do 4 MiB of tables or maps. There are as many vertices as the paper's disc has (25 000) on half of 1280 × 720
/// pixels. Each pixel shades each key light.
double shading_price(const ShadingCost& cost, int key_lights);

/// A setting of a material, with its cost and its errors.
struct MeasuredChoice {
    nlohmann::json settings;  ///< members of the material's "quality"
    Quality quality;
    std::shared_ptr<const CookedMaterial> baked;  ///< shared by settings that differ in key_lights alone
    double price = 0.0;                           ///< shading_price()
    std::vector<double> errors{};                 ///< by probe, over the views measured so far
    std::vector<double> checks{};                 ///< by probe, over the last parts, which did not decide; may be empty
    std::size_t steps = 0;                        ///< steps of measuring `errors`, two per probe

    /// The largest of the errors.
    double error() const;
};

/// Whether none of the choices is as cheap and as accurate, and better in one of both (the Pareto front).
bool on_front(const MeasuredChoice& choice, std::span<const MeasuredChoice> among);

/// How far a search has come.
struct SearchState {
    std::vector<MeasuredChoice> measured;  ///< in the order of measurement
    std::size_t done = 0;                  ///< steps: a bake and up to two measurements per setting
    std::size_t total = 0;
};

struct SearchQuery {
    const Material& material;
    std::span<const BudgetProbe> probes;
    std::span<const MeasuredViews> views;   ///< under each probe; of one part, or of several and one that checks
    ErrorFunction error = relative_rms;     ///< over a part
    std::vector<nlohmann::json> settings;   ///< those that do not suit the grating are left out
    std::optional<nlohmann::json> first{};  ///< the "quality" that the material pins, measured before the others
    /// The search ends at the first setting whose errors are all at most this, and checks it. A larger error skips the
    /// setting's remaining views and probes. If no setting is good enough, further probes are measured until the
    /// setting with the least error() is known. Without it, all settings are measured at the first views, and those
    /// that are on_front() at all of them.
    std::optional<double> good_enough{};
    /// Also measures those on_front() that are cheaper than what good_enough finds, or than `first`.
    bool cheaper = false;
};

/// Measures settings, the cheapest first: their errors over the views against reference_radiance() under the
/// material's illuminant, with no window on the light. `report` is called after each step. Returns early, between two
/// steps, when it is asked to stop.
///
/// Runs on all cores; the result does not depend on their number.
SearchState search(const SearchQuery& query, const std::function<void(const SearchState&)>& report,
                   const std::stop_token& stop = {});

}  // namespace rowland::diffraction
