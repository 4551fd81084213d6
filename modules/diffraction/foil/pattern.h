#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "modules/diffraction/foil/recipe.h"

namespace rowland::diffraction::foil {

/// The grooves at a texel of foil.
struct Groove {
    double rotation =
        0.0;             ///< of g, from the direction of u toward up, over π; any number, of which the fraction counts
    double pitch = 1.0;  ///< over FoilGrating::pitch_nm, at most 2; 0: no grating
};

/// The texels that a foil is drawn on: column 0 on the left, row 0 at the top.
struct Area {
    int width_px = 0;
    int height_px = 0;
    double width_mm = 0.0;
    bool repeats = false;  ///< cells fit the area's sides, so that it tiles a surface without a seam

    double texel_mm() const { return width_mm / width_px; }
    double height_mm() const { return texel_mm() * height_px; }
    /// The middle of a texel, from the lower left corner.
    glm::dvec2 position_mm(int column, int row) const {
        return texel_mm() * glm::dvec2(column + 0.5, height_px - row - 0.5);
    }
};

/// Brightness on an area's texels, 0 to 1, linear in light, row by row from the top.
using Brightness = std::vector<float>;

/// The grooves of a foil at each texel of an area, but for Foil::direction_deg of the whole, which is the surface's
/// rotation (FoilGrating::rotation_deg). May be called from several threads.
using GrooveField = std::function<Groove(int column, int row)>;

/// `pictures`: those that TwoPictures and Own name, in their order. The field refers to none of the arguments.
GrooveField groove_field(const Foil& foil, const Area& area, std::span<const Brightness> pictures = {});

/// A groove texture: three values per texel, row by row from the top. Red: rotation / π, green: half the pitch over
/// FoilGrating::pitch_nm, 0 where `has_foil` or the field has no grating. `has_foil` is empty or has a value per texel.
std::vector<std::uint16_t> groove_texels(const Area& area, const GrooveField& field,
                                         std::span<const std::uint8_t> has_foil = {});

/// The parts of groove_field(): each draws a family of types.
GrooveField facet_field(const Foil& foil, const Area& area);
GrooveField curve_field(const Foil& foil, const Area& area);
GrooveField stroke_field(const Own& own, double scale, const Area& area, const Brightness& drawing);

/// A number in [0, 1) that is as good as random for each cell, and the same everywhere.
double random_of_cell(std::int64_t column, std::int64_t row, std::uint32_t seed);

/// x − ⌊x⌋
double fraction_of(double x);

}  // namespace rowland::diffraction::foil
