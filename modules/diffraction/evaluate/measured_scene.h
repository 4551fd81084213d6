#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/model/shading_point.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace rowland::diffraction {

/// Points of one object. A map of a flat object serves all points of its surface.
using Surface = std::vector<ShadingPoint>;

/// Whether all normals are equal.
bool is_flat(const Surface& surface);

/// XYZ of all points, surface by surface, as the cooked material's shaders give them. The
/// stand-in of a planar map shades curved surfaces.
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

    /// Computes the reference unless it is known. False if it was stopped; another call continues.
    bool prepare(const std::stop_token& stop = {});
    std::vector<glm::dvec3> shaded(const CookedMaterial& cooked, int key_lights,
                                   math::SphericalWindow window = math::SphericalWindow::None) const {
        return shade_surfaces(cooked, lights->split(key_lights, window), surfaces);
    }
};

}  // namespace rowland::diffraction
