#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace rowland::diffraction {

/// The relative RMS error √(Σ‖XYZ − reference‖² / Σ‖reference‖²) (PHYSICS §1). 0 where both are black, infinite where
/// only the reference is black. The spans have equal lengths, one value per frame.
double relative_rms(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference);

}  // namespace rowland::diffraction
