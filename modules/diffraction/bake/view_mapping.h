#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

#include "engine/core/byte_stream.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// How a texture covers the views of the upper hemisphere.
///
/// Spherical, as the paper's: φ along s (GL_REPEAT), θ along t.
/// Parabolic [Heidrich & Seidel 1998]: (v_g, v_h)/(1 + v_n) along s and t. The corners hold views below the horizon,
/// whose v_g and v_h are inside the disc again, so that the function stays smooth for filtering. OneDimensional: v_g
/// along s, for the flat lobe, which does not depend on v_h.
enum class ViewMapping : std::uint8_t { Spherical = 0, Parabolic = 1, OneDimensional = 2 };

/// "spherical", "parabolic", "one-dimensional".
const char* view_mapping_name(ViewMapping mapping);
/// Inverse of view_mapping_name(), whose result `name` must be.
ViewMapping parse_view_mapping(std::string_view name);

/// A texture's nodes over views. Both ends of an axis are nodes, except for φ, where column 0 follows the last.
///
/// Texture coordinates of a view (v_g, v_h, v_n) (W = columns, H = rows):
/// Spherical: s = φ/2π + ½/W, φ = atan2(v_h, v_g); t = (θ/(π/2)·(H−1) + ½)/H, θ the angle from n.
/// Parabolic: s = ((p_g + 1)/2·(W−1) + ½)/W, t = ((p_h + 1)/2·(H−1) + ½)/H, p = (v_g, v_h)/(1 + v_n).
/// OneDimensional: s = ((v_g + 1)/2·(W−1) + ½)/W; H = 1.
struct ViewGrid {
    ViewMapping mapping = ViewMapping::Spherical;
    int columns = 64;  ///< spherical: ≥ 1; else ≥ 2
    int rows = 32;     ///< ≥ 2; one-dimensional: 1

    std::size_t texels() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }

    friend bool operator==(const ViewGrid&, const ViewGrid&) = default;
};

/// (v_g, v_h) of a node.
glm::dvec2 node_view(const ViewGrid& grid, int column, int row);

/// The texel of (v_g, −v_h): the same texel if v_h = 0, or if the mapping is one-dimensional.
std::size_t mirrored_texel(const ViewGrid& grid, int column, int row);

/// A GL_LINEAR look-up: four texels and their weights, which sum to 1.
struct BilinearLookup {
    std::array<std::size_t, 4> texel{};
    std::array<double, 4> weight{};
};

/// The look-up of a tangent-frame view, by ViewGrid's formulae.
BilinearLookup look_up(const ViewGrid& grid, double v_g, double v_h, double v_n);

/// True if the mapping allows the grid's sizes.
bool is_valid(const ViewGrid& grid);

/// Refuses (Error, input) a one-dimensional grid for a grating that depends on more than v_g; the sizes must be valid.
void check_view_grid(const ViewGrid& grid, const Grating& grating);

/// The factors from the SH coefficients of the view (v_g, v_h) to those of (v_g, −v_h). As every lobe is even in s_h +
/// v_h, they are −1 for the functions that are odd in h (m < 0) and 1 for the others. bands² entries.
std::vector<double> mirror_signs(int bands);

/// Calls body(view, texel, mirrored texel) for one view of each mirrored pair, on all cores. A lattice has no pairs:
/// body is called for every view, and both texels are the same. `title` labels the progress.
void for_each_view(const char* title, const ViewGrid& grid, const Grating& grating,
                   const std::function<void(const glm::dvec2& view, std::size_t texel, std::size_t mirror)>& body);

/// A component of a layer as GL_LINEAR filters it.
double filtered(const PackedTexels& packed, std::size_t layer, std::size_t texels_per_layer, std::size_t component,
                const BilinearLookup& lookup);

/// The two nodes next to a position on one axis, and the second one's weight.
struct AxisLookup {
    std::size_t first = 0;
    std::size_t second = 0;
    double weight = 0.0;
};
/// `position`: 0 at the first node, 1 at the last, clamped.
AxisLookup look_up_axis(double position, std::size_t count);

/// The look-up of a texture with `row_length` texels in a row.
BilinearLookup combine(const AxisLookup& columns, const AxisLookup& rows, std::size_t row_length);

/// The mapping that a number in a file names. Throws Error (input) at the reader's offset.
ViewMapping to_view_mapping(const ByteReader& reader, unsigned number);

void write_view_grid(const ViewGrid& grid, ByteWriter& writer);
/// Throws Error (input) for another mapping or a size out of bounds.
ViewGrid read_view_grid(ByteReader& reader);

}  // namespace rowland::diffraction
