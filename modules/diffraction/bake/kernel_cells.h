#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "modules/diffraction/model/colour_kernel.h"

namespace rowland::diffraction {

/// Linear interpolation of f at step h exceeds f by h² f''/12 on average. Nodes therefore hold f less this fraction of
/// their second difference, which more than halves the interpolation's RMS error.
inline constexpr float kBestLinear = 1.0F / 12.0F;

/// The same along views at step h under KernelCells: h²/32 more, for light that is spread over cells of ½ h (a variance
/// of h²/24, divided linearly among two) and the kernel's mean over them (h²/48).
inline constexpr float kBestView = kBestLinear + 1.0F / 32.0F;

/// Four numbers that are calculated with at once.
using Four = float __attribute__((vector_size(4 * sizeof(float))));

/// A colour kernel over equal cells, for correlation with arc profiles: 2(views − 1) cells of a ∈ [−1, 1] and views at
/// v_g = 2j/(views−1) − 1, so that a weight depends on the sum a + v_g alone. It is the kernel's mean over the cell.
class KernelCells {
 public:
    KernelCells(const KernelTable& kernel, double pitch_nm, int views, const glm::dmat3& zero_order_xyz);

    int cells() const { return cells_; }

    /// `light`: ½ flux · s_n in cells of a, 3·kFours per cell: red of 4·kFours independent profiles, then green, then
    /// blue. `xyz` gets 3·kFours per view, likewise, for linear interpolation. kFours is 10, 20 or 24.
    template <int kFours>
    void correlate(std::span<const Four> light, std::span<Four> xyz) const;

    /// One profile: four floats (r, g, b, –) per cell, four (X, Y, Z, –) per view.
    void correlate_rgb(std::span<const float> light, std::span<float> xyz) const;

 private:
    /// Lowers the inner views by kBestView of their second difference. `count` values per view.
    template <typename Value>
    void sharpen(std::span<Value> xyz, std::size_t count) const;

    /// Cells that the kernel's weights reach from a view.
    struct Range {
        int begin;
        int end;
    };
    Range range(int view) const;

    int views_;
    int cells_;
    int first_ = 0;               ///< weights before this and
    int end_ = 0;                 ///< from this on are 0
    std::vector<float> weights_;  ///< 12 per sum: columns of the matrix, each padded to four
};

}  // namespace rowland::diffraction
