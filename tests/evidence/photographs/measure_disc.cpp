#include "tests/evidence/photographs/measure_disc.h"

#include <glm/trigonometric.hpp>
#include <limits>

#include "tests/evidence/photographs/find_line.h"

namespace rowland::evidence {

namespace {

/// Maxima fainter than these fractions of the brightest point under the white lamp do not count: of that picture, and
/// of all pictures of the disc from there. In some the line is dark, and the disc's gloss would be taken for it.
constexpr double kFaintest = 0.02;
constexpr double kFaintestOfAll = 0.002;
constexpr double kMissed_deg = 5.0;

double nearest_deg(const std::vector<double>& azimuths, double azimuth) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double other : azimuths) nearest = std::min(nearest, azimuth_difference(azimuth, other));
    return glm::degrees(nearest);
}

/// Whether an order shows a wavelength of the range of the bands.
bool is_visible(double path_nm) {
    for (int order = 1; order <= kOrders; ++order)
        if (path_nm / order >= kBands_nm.front() && path_nm / order <= kBands_nm.back()) return true;
    return false;
}

void compare_positions(const DrawnPicture& picture, const LampAndEye& setup, double pitch_nm, double turned_deg,
                       double threshold, DiscErrors& errors) {
    for (const double radius_m : kRadii_m) {
        const std::vector<double> expected = line_azimuths(setup, radius_m);
        std::vector<double> found;
        for (const Crossing& crossing : find_crossings(picture, radius_m, threshold)) {
            found.push_back(crossing.azimuth);
            errors.position_deg.add(nearest_deg(expected, crossing.azimuth));
            if (radius_m == kPlottedRadius_m) errors.found_deg.push_back({turned_deg, glm::degrees(crossing.azimuth)});
        }
        for (const double azimuth : expected) {
            if (!is_visible(line_wavelength_nm(setup, radius_m, azimuth, pitch_nm, 1))) continue;
            ++errors.expected;
            if (nearest_deg(found, azimuth) > kMissed_deg) ++errors.missed;
        }
    }
}

void compare_wavelengths(const DrawnPicture& picture, const LampAndEye& setup, double pitch_nm, double band_nm,
                         double threshold, DiscErrors& errors) {
    for (const Spot& spot : find_spots(picture, threshold)) {
        const double path_nm = line_wavelength_nm(setup, spot.radius_m, spot.azimuth, pitch_nm, 1);
        const int order = std::clamp(static_cast<int>(std::lround(path_nm / band_nm)), 1, kOrders);
        errors.wavelength_nm.at(static_cast<std::size_t>(order - 1)).add(path_nm / order - band_nm);
    }
}

}  // namespace

ErrorSum DiscErrors::all_wavelengths_nm() const {
    ErrorSum sum;
    for (const ErrorSum& order : wavelength_nm) sum.add(order);
    return sum;
}

DiscErrors measure_disc(Bench& bench, const std::string& disc, const Station& camera, std::span<const int> turns_deg,
                        int size, const Disturbance& disturbance) {
    DiscErrors errors;
    std::vector<DrawnPicture> white;
    const double pitch_nm = bench.show(disc, {}, disturbance);
    double brightest = 0.0;
    for (const int turned_deg : turns_deg) {
        white.push_back(bench.draw(lamp_and_eye(camera, turned_deg), size));
        brightest = std::max(brightest, white.back().greatest_brightness());
    }
    std::vector<double> thresholds;
    for (std::size_t i = 0; i < white.size(); ++i) {
        thresholds.push_back(std::max(kFaintest * white[i].greatest_brightness(), kFaintestOfAll * brightest));
        compare_positions(white[i], lamp_and_eye(camera, turns_deg[i]), pitch_nm, turns_deg[i], thresholds.back(),
                          errors);
        ++errors.pictures;
    }
    for (const double band_nm : kBands_nm) {
        bench.show(disc, band_nm, disturbance);
        for (std::size_t i = 0; i < turns_deg.size(); ++i) {
            const LampAndEye at = lamp_and_eye(camera, turns_deg[i]);
            compare_wavelengths(bench.draw(at, size), at, pitch_nm, band_nm, thresholds[i], errors);
            ++errors.pictures;
        }
    }
    return errors;
}

std::vector<int> all_turns_deg() {
    std::vector<int> turns;
    for (int turned_deg = kFirstTurn_deg; turned_deg <= kLastTurn_deg; turned_deg += kTurnStep_deg)
        turns.push_back(turned_deg);
    return turns;
}

}  // namespace rowland::evidence
