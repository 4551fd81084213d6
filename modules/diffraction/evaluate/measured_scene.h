#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/evaluate/probe_lights.h"
#include "modules/diffraction/model/frame.h"

namespace rowland::diffraction {

/// Points of one object. A map of a flat object serves all points of its surface.
using Surface = std::vector<Frame>;

/// Whether all normals are equal.
bool is_flat(const Surface& surface);

/// XYZ of all points, surface by surface, as the cooked material's shaders give them. A curved surface gets what
/// stands in for a planar map.
std::vector<glm::dvec3> shade_surfaces(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const Surface> surfaces);

/// Surfaces under one probe, with the reference's XYZ of their points. Every error of a representation is measured
/// here: by the cooker's budget, the inspector and the sweep.
class MeasuredScene {
 public:
    /// XYZ of some of the points by the reference.
    using Reference = std::function<std::vector<glm::dvec3>(std::span<const Frame>)>;

    /// `name` labels the progress. The reference is asked for `part` points at a time.
    MeasuredScene(std::string name, std::shared_ptr<ProbeLights> lights, std::vector<Surface> surfaces,
                  std::size_t part, Reference reference);

    /// Computes the reference unless it is known. False if it was stopped; another call continues.
    bool prepare(const std::stop_token& stop = {});
    const std::vector<glm::dvec3>& reference();
    std::vector<glm::dvec3> shaded(const CookedMaterial& cooked, int key_lights,
                                   math::SphericalWindow window = math::SphericalWindow::None);

 private:
    std::string name_;
    std::shared_ptr<ProbeLights> lights_;
    std::vector<Surface> surfaces_;
    std::size_t part_;
    Reference compute_;
    std::vector<glm::dvec3> reference_;
};

}  // namespace rowland::diffraction
