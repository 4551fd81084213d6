#include "modules/diffraction/foil/pattern.h"

#include <cmath>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/foil/kinegram.h"

namespace rowland::diffraction::foil {

double fraction_of(double x) {
    return x - std::floor(x);
}

double random_of_cell(std::int64_t column, std::int64_t row, std::uint32_t seed) {
    // The finaliser of SplitMix64 [Steele et al. 2014] over the three numbers.
    const auto mixed = [](std::uint64_t x) {
        x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
        x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
        return x ^ (x >> 31U);
    };
    std::uint64_t x = mixed(std::uint64_t{seed} + 0x9E3779B97F4A7C15U);
    x = mixed(x ^ static_cast<std::uint64_t>(column));
    x = mixed((x + 0x9E3779B97F4A7C15U) ^ static_cast<std::uint64_t>(row));
    return static_cast<double>(x >> 11U) * 0x1.0p-53;
}

GrooveField groove_field(const Foil& foil, const Area& area, std::span<const Brightness> pictures) {
    if (const auto* two = std::get_if<TwoPictures>(&foil.type)) {
        ROWLAND_CHECK_OP(pictures.size(), ==, 2U);
        return kinegram_field(*two, foil.scale, area, pictures[0], pictures[1]);
    }
    if (const auto* own = std::get_if<Own>(&foil.type)) {
        ROWLAND_CHECK_OP(pictures.size(), ==, 1U);
        return stroke_field(*own, foil.scale, area, pictures[0]);
    }
    if (GrooveField facets = facet_field(foil, area)) return facets;
    return curve_field(foil, area);
}

std::vector<std::uint16_t> groove_texels(const Area& area, const GrooveField& field,
                                         std::span<const std::uint8_t> has_foil) {
    const auto width = static_cast<std::size_t>(area.width_px);
    std::vector<std::uint16_t> texels(3 * width * static_cast<std::size_t>(area.height_px), 0);
    parallel_for(static_cast<std::size_t>(area.height_px), [&](std::size_t row) {
        for (std::size_t column = 0; column < width; ++column) {
            const std::size_t texel = row * width + column;
            if (!has_foil.empty() && has_foil[texel] == 0) continue;
            const Groove groove = field(static_cast<int>(column), static_cast<int>(row));
            if (groove.pitch <= 0.0) continue;
            // Rotations 0 and 1 are the same grooves.
            texels[3 * texel] = static_cast<std::uint16_t>(std::lround(65535.0 * fraction_of(groove.rotation)));
            texels[3 * texel + 1] = static_cast<std::uint16_t>(std::lround(std::fmin(32767.5 * groove.pitch, 65535.0)));
        }
    });
    return texels;
}

}  // namespace rowland::diffraction::foil
