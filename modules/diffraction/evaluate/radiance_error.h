#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace rowland::diffraction {

/// √(Σ‖XYZ − reference‖² / Σ‖reference‖²) (PHYSICS §1): "relative RMS". 0 where both are black, infinite where only the
/// reference is. The spans are of one length, one value per frame.
double relative_rms(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference);

}  // namespace rowland::diffraction
