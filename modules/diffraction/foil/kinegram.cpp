#include "modules/diffraction/foil/kinegram.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "modules/diffraction/foil/grating.h"

namespace rowland::diffraction::foil {

namespace {

constexpr double kFinest_nm = 420.0;
constexpr double kCoarsest_nm = 4600.0;
/// Beyond these the eye sees less than a hundredth of what it sees of the middle wavelength.
constexpr double kFirstSeen_nm = 420.0;
constexpr double kLastSeen_nm = 690.0;

/// Whether grooves for the tilt `own` send visible light to the eye at the tilt `other`.
bool seen_at(const TwoPictures& two, double own_deg, double other_deg) {
    const double path_nm =
        std::abs(kMiddleWavelength_nm * path_over_pitch(two, other_deg) / path_over_pitch(two, own_deg));
    for (const int order : {1, 2})
        if (path_nm / order > kFirstSeen_nm && path_nm / order < kLastSeen_nm) return true;
    return false;
}

bool is_drawable(const TwoPictures& two, double tilt_deg) {
    const double pitch_nm = kMiddleWavelength_nm / std::abs(path_over_pitch(two, tilt_deg));
    return pitch_nm >= kFinest_nm && pitch_nm <= kCoarsest_nm;
}

bool are_apart(const TwoPictures& two, double a_deg, double b_deg) {
    return !seen_at(two, a_deg, b_deg) && !seen_at(two, b_deg, a_deg);
}

/// The tilt for B nearest to its own, in whole degrees, that does with that of A.
std::optional<int> nearest_tilt_for_b(const TwoPictures& two) {
    std::optional<int> nearest;
    for (int tilt = -60; tilt <= 60; ++tilt)
        if (is_drawable(two, tilt) && are_apart(two, two.tilts_deg.x, tilt) &&
            (!nearest || std::abs(tilt - two.tilts_deg.y) < std::abs(*nearest - two.tilts_deg.y)))
            nearest = tilt;
    return nearest;
}

/// The fraction of 64 cells that are darker than cell (i, j) in an ordered dither [Bayer 1973], plus half a cell.
double bayer_threshold(unsigned i, unsigned j) {
    unsigned rank = 0;
    for (unsigned bit = 0; bit < 3; ++bit) {
        const unsigned x = i >> bit & 1U;
        const unsigned y = j >> bit & 1U;
        rank = rank << 2U | ((x ^ y) << 1U | y);
    }
    return (rank + 0.5) / 64.0;
}

}  // namespace

double path_over_pitch(const TwoPictures& two, double tilt_deg) {
    const auto sine = [](double degrees) { return std::sin(degrees * std::numbers::pi / 180.0); };
    return sine(-tilt_deg) + sine(two.lamp_deg - tilt_deg);
}

glm::dvec2 picture_pitches_nm(const TwoPictures& two) {
    return {kMiddleWavelength_nm / std::abs(path_over_pitch(two, two.tilts_deg.x)),
            kMiddleWavelength_nm / std::abs(path_over_pitch(two, two.tilts_deg.y))};
}

std::optional<Refusal> tilt_refusal(const TwoPictures& two) {
    for (int i = 0; i < 2; ++i) {
        const double tilt_deg = two.tilts_deg[i];
        if (!is_drawable(two, tilt_deg))
            return Refusal{
                .key = fmt::format("tilts_deg/{}", i),
                .found = fmt::format("grooves of {:.3g} um at {:g} degrees",
                                     1e-3 * kMiddleWavelength_nm / std::abs(path_over_pitch(two, tilt_deg)), tilt_deg),
                .expected = fmt::format("{:g} to {:g} um", 1e-3 * kFinest_nm, 1e-3 * kCoarsest_nm),
                .remedy = fmt::format("at {:g} degrees the card mirrors the lamp: take tilts 5 to 25 degrees from it",
                                      0.5 * two.lamp_deg)};
    }
    if (are_apart(two, two.tilts_deg.x, two.tilts_deg.y)) return std::nullopt;
    const std::optional<int> better = nearest_tilt_for_b(two);
    return Refusal{.key = "tilts_deg",
                   .found = fmt::format("{:g} and {:g} degrees", two.tilts_deg.x, two.tilts_deg.y),
                   .expected = "tilts at which each picture is seen without the other",
                   .remedy = better ? fmt::format("try {:g} and {}", two.tilts_deg.x, *better) : "try -10 and 10"};
}

GrooveField kinegram_field(const TwoPictures& two, double scale, const Area& area, Brightness a, Brightness b) {
    const int cell_px = std::max(1, static_cast<int>(std::lround(two.cell_mm * scale / area.texel_mm())));
    const glm::dvec2 pitches_nm = picture_pitches_nm(two);
    const glm::dvec2 pitches = pitches_nm / std::max(pitches_nm.x, pitches_nm.y);
    const auto pictures =
        std::make_shared<const std::array<Brightness, 2>>(std::array<Brightness, 2>{std::move(a), std::move(b)});
    return [=](int column, int row) {
        const int line = row / cell_px;
        const int picture = line % 2;
        const double threshold =
            bayer_threshold(static_cast<unsigned>(column / cell_px), static_cast<unsigned>(line / 2));
        const std::size_t texel =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(area.width_px) + static_cast<std::size_t>(column);
        const bool bright = (*pictures)[static_cast<std::size_t>(picture)][texel] > threshold;
        // Upright grooves send the lamp's light aside: bare metal would mirror the room around the pictures.
        return bright ? Groove{0.5, pitches[picture]} : Groove{0.0};
    };
}

}  // namespace rowland::diffraction::foil
