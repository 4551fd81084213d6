#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rowland::math {

/// Instruction sets that the fast single-precision paths are compiled for. Bake code never uses them: cooked bytes must
/// not depend on the machine.
enum class InstructionSet {
    Baseline,  ///< what every processor of the target architecture has; on x86-64 that is SSE2, four lanes
    Avx2,      ///< x86-64 with AVX2 and FMA, eight lanes
};

/// "baseline" or "avx2".
const char* instruction_set_name(InstructionSet set);

/// Whether this build has the path and this processor and operating system can run it.
bool is_supported(InstructionSet set);

/// The widest supported set.
InstructionSet best_instruction_set();

/// The most bands that the single-precision paths take.
inline constexpr int kMaximumFastBands = 16;

/// Tangent frames (g, h, n), one array per component: n is `normal`, g is `tangent` without its component along n, both
/// normalised, and h = n × g. The arrays need not hold unit vectors; where the tangent is parallel to the normal, g is
/// any direction perpendicular to it.
struct FrameArrays {
    std::array<std::span<const float>, 3> tangent;
    std::array<std::span<const float>, 3> normal;

    std::size_t size() const { return normal[0].size(); }
};

/// Rotates band-limited RGB light into many tangent frames, in single precision and on all cores: rotations about z, y
/// and z [Pinchon & Hoggan 2007, "Rotation matrices for real spherical harmonics"]. The rotation about y is one about z
/// between two exchanges of y and z, which are a fixed sparse matrix. No angle is computed, and the last rotation
/// follows from the tangent after the other two, so no frame is singular. The error against ShRotation is ≤ 2e-6 of
/// the light's norm √Σ‖c‖².
///
/// For each frame writes bands² × 3 floats, RGB innermost. `light` holds bands² coefficients in the axes the frames are
/// given in, 1 ≤ bands ≤ 16. out.size() ≥ frames.size() · bands² · 3.
void rotate_to_frames(std::span<const glm::dvec3> light, int bands, const FrameArrays& frames, std::span<float> out,
                      InstructionSet set = best_instruction_set());

/// A constant matrix of rows × bands² that is applied to light in a tangent frame, such as the one that takes
/// coefficients to moments along an arc. Entries up to 1e-9 of the largest are dropped, so zeros cost nothing.
class FrameProjection {
 public:
    /// `matrix` is row-major, 1 to 256 rows of bands² entries, 1 ≤ bands ≤ 16.
    FrameProjection(std::span<const double> matrix, int bands);

    int bands() const { return bands_; }
    int rows() const { return static_cast<int>(first_.size()) - 1; }
    /// Entries that were not dropped.
    int entries() const { return static_cast<int>(column_.size()); }

    std::span<const std::int32_t> first() const { return first_; }    ///< rows + 1: where each row's entries begin
    std::span<const std::int32_t> column() const { return column_; }  ///< of each entry
    std::span<const float> weight() const { return weight_; }         ///< of each entry

 private:
    int bands_;
    std::vector<std::int32_t> first_;
    std::vector<std::int32_t> column_;
    std::vector<float> weight_;
};

/// rotate_to_frames() followed by the projection, without storing the coefficients: for each frame rows × 3 floats, RGB
/// innermost. out.size() ≥ frames.size() · rows · 3.
void rotate_and_project(std::span<const glm::dvec3> light, const FrameArrays& frames, const FrameProjection& projection,
                        std::span<float> out, InstructionSet set = best_instruction_set());

}  // namespace rowland::math
