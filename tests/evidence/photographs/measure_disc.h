#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "tests/evidence/photographs/bench.h"

namespace rowland::evidence {

struct ErrorSum {
    int count = 0;
    double largest = 0.0;
    double squares = 0.0;

    /// `error` may have a sign.
    void add(double error) {
        ++count;
        largest = std::max(largest, std::abs(error));
        squares += error * error;
    }
    void add(const ErrorSum& other) {
        count += other.count;
        largest = std::max(largest, other.largest);
        squares += other.squares;
    }
    double rms() const { return count > 0 ? std::sqrt(squares / count) : 0.0; }
};

inline constexpr int kOrders = 3;  ///< that the scene's gratings have, with both signs
inline constexpr std::array<double, 4> kBands_nm = {450.0, 530.0, 600.0, 650.0};
inline constexpr std::array<double, 5> kRadii_m = {0.025, 0.033, 0.041, 0.049, 0.058};
inline constexpr double kPlottedRadius_m = kRadii_m[2];
inline constexpr int kPictureSize = 256;

/// What pictures of one disc from one camera show, beside the formula.
struct DiscErrors {
    int pictures = 0;
    /// Of every crossing of kRadii_m that is found, to the nearest azimuth of the formula, degrees.
    ErrorSum position_deg;
    /// Crossings of the formula at which an order has a wavelength between the first and the last of kBands_nm, and
    /// those of them where none was found within 5°.
    int expected = 0;
    int missed = 0;
    /// Of orders 1 to 3, each with both signs: the formula's wavelength where the spot of a lamp of one colour is
    /// found, less the mean wavelength of the lamp, nm.
    std::array<ErrorSum, kOrders> wavelength_nm;
    /// (turned angle, azimuth) of the crossings of kPlottedRadius_m, degrees.
    std::vector<std::array<double, 2>> found_deg;

    ErrorSum all_wavelengths_nm() const;
};

/// Draws a disc under a white lamp and lamps of kBands_nm, turned by each of `turns_deg`.
DiscErrors measure_disc(Bench& bench, const std::string& disc, const Station& camera, std::span<const int> turns_deg,
                        int size = kPictureSize, const Disturbance& disturbance = {});

/// From kFirstTurn_deg to kLastTurn_deg.
std::vector<int> all_turns_deg();

}  // namespace rowland::evidence
