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
#include "modules/diffraction/model/lobe.h"

namespace rowland::diffraction {

/// How a texture covers the views of the upper hemisphere.
///
/// Spherical, as the paper's: φ along s (GL_REPEAT), θ along t.
/// Parabolic [Heidrich & Seidel 1998]: (v_g, v_h)/(1 + v_n) along s and t. The corners hold views below the horizon,
/// whose v_g and v_h are inside the disc again: what filtering there sees is smooth. OneDimensional: v_g along s. For
/// the flat lobe, which does not know v_h.
enum class ViewMapping : std::uint8_t { Spherical = 0, Parabolic = 1, OneDimensional = 2 };

/// "spherical", "parabolic", "one-dimensional".
const char* view_mapping_name(ViewMapping mapping);
/// Inverse of view_mapping_name(), whose result `name` must be.
ViewMapping parse_view_mapping(std::string_view name);

/// A texture's nodes over views. Both ends of an axis are nodes, but for φ, where column 0 follows the last.
///
/// Where a view (v_g, v_h, v_n) lies, in texture coordinates (W = columns, H = rows):
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

/// The texel of (v_g, −v_h): the same texel where v_h = 0, or where the mapping does not know v_h.
std::size_t mirrored_texel(const ViewGrid& grid, int column, int row);

/// What GL_LINEAR reads: four texels and their shares, which sum to 1.
struct BilinearLookup {
    std::array<std::size_t, 4> texel{};
    std::array<double, 4> share{};
};

/// The look-up of a tangent-frame view, by the formulae above.
BilinearLookup look_up(const ViewGrid& grid, double v_g, double v_h, double v_n);

/// True if the sizes are those of the mapping.
bool is_valid(const ViewGrid& grid);

/// Refuses (Error, input) a one-dimensional grid for a lobe that is not flat; the sizes must be valid.
void check_view_grid(const ViewGrid& grid, const GrooveLobe& lobe);

/// By what each SH coefficient of the view (v_g, v_h) gives that of (v_g, −v_h): every lobe is even in s_h + v_h, so −1
/// for the functions odd in h, m < 0, and 1 for the others. bands² entries.
std::vector<double> mirror_signs(int bands);

/// Calls body(view, texel, mirrored texel) for one of each pair of mirror images, on all cores.
void for_each_view(const char* title, const ViewGrid& grid,
                   const std::function<void(const glm::dvec2& view, std::size_t texel, std::size_t mirror)>& body);

/// A component of a layer as GL_LINEAR filters it.
double filtered(const PackedTexels& packed, std::size_t layer, std::size_t texels_per_layer, std::size_t component,
                const BilinearLookup& place);

/// The texels between which a position lies on one axis of `count` nodes, and the second one's share; clamped.
struct AxisLookup {
    std::size_t first = 0;
    std::size_t second = 0;
    double share = 0.0;
};
/// `position` in [0, 1] from the first node to the last.
AxisLookup look_up_axis(double position, std::size_t count);

BilinearLookup combine(const AxisLookup& columns, const AxisLookup& rows, std::size_t row_length);

/// The mapping that a number in a file names. Throws Error (input) at the reader's offset.
ViewMapping to_view_mapping(const ByteReader& reader, unsigned number);

void write_view_grid(const ViewGrid& grid, ByteWriter& writer);
/// Throws Error (input) for another mapping or a size out of bounds.
ViewGrid read_view_grid(ByteReader& reader);

}  // namespace rowland::diffraction
