// The bright line of a disc: the formula, what finds it in a picture, and drawn pictures beside the formula.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

#include "tests/evidence/photographs/disc_line.h"
#include "tests/evidence/photographs/find_line.h"
#include "tests/evidence/photographs/measure_disc.h"
#include "tests/support/files.h"

namespace rowland::evidence {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kPi = std::numbers::pi;

TEST(LineFormula, CrossesInThePlaneOfLampAndEye) {
    // By triangles of 3, 4, 5 and 5, 12, 13 on one side.
    const LampAndEye setup{.lamp = {0.0, 4.0, 4.0}, .eye = {0.0, 5.0, -11.0}};
    EXPECT_THAT(line_azimuths(setup, 1.0), ElementsAre(DoubleNear(0.0, 1e-12), DoubleNear(kPi, 1e-12)));
    EXPECT_NEAR(across_tracks(setup, 1.0, 0.0), 3.0 / 5.0 - 12.0 / 13.0, 1e-15);
    EXPECT_NEAR(across_tracks(setup, 1.0, kPi), -5.0 / std::sqrt(41.0) + 2.0 / std::sqrt(5.0), 1e-15);
    EXPECT_NEAR(line_wavelength_nm(setup, 1.0, 0.0, 1300.0, 1), 420.0, 1e-12);
    EXPECT_NEAR(line_wavelength_nm(setup, 1.0, 0.0, 1300.0, 3), 140.0, 1e-12);
}

TEST(LineFormula, FollowsTheSinesOfDistantLampAndEye) {
    // Lamp at 60° from the normal and azimuth 90°, eye at 30° and azimuth 0°: the components in the disc are √3/2 and
    // ½.
    constexpr double kFar_m = 1e8;
    const LampAndEye setup{.lamp = kFar_m * glm::dvec3(0.5 * std::sqrt(3.0), 0.5, 0.0),
                           .eye = kFar_m * glm::dvec3(0.0, 0.5 * std::sqrt(3.0), 0.5)};
    const std::vector<double> azimuths = line_azimuths(setup, 0.04);
    EXPECT_THAT(azimuths, ElementsAre(DoubleNear(kPi / 3.0, 1e-8), DoubleNear(kPi * 4.0 / 3.0, 1e-8)));
    // From the grating vector the lamp is at 30° and the eye at −60°: sin 30° sin 60° = sin 60° sin 30°.
    EXPECT_NEAR(line_wavelength_nm(setup, 0.04, azimuths[0], 1600.0, 2), 800.0, 1e-5);
}

TEST(LineFormula, HasTheAnglesOfThePhotographs) {
    const LampAndEye at = lamp_and_eye(kCameras[0], 90.0);
    EXPECT_NEAR(glm::degrees(std::acos(at.lamp.y / kLamp.distance_m)), 83.5, 1e-12);
    EXPECT_NEAR(at.lamp.x, 0.7 * std::sin(glm::radians(83.5)), 1e-15);
    EXPECT_NEAR(at.eye.z, 0.227 * std::sin(glm::radians(38.0)), 1e-15);
    EXPECT_EQ(all_turns_deg().size(), 34U);
}

std::vector<double> bell(int count, double middle, double deviation) {
    std::vector<double> samples;
    for (int i = 0; i < count; ++i)
        samples.push_back(std::exp(-0.5 * std::pow(std::remainder(i - middle, count) / deviation, 2)));
    return samples;
}

TEST(Peaks, LieBetweenSamplesAndAcrossTheSeamOfACircle) {
    for (const double middle : {50.3, 0.4, 99.8}) {
        const std::vector<Peak> found = peaks(bell(100, middle, 6.0), 0.1, 5, true);
        ASSERT_EQ(found.size(), 1U);
        EXPECT_NEAR(std::remainder(found[0].position - middle, 100.0), 0.0, 0.02);
    }
}

TEST(Peaks, ThatAnEndCutsOffAreLeftOut) {
    EXPECT_EQ(peaks(bell(100, 50.0, 6.0), 0.1, 5, false).size(), 1U);
    EXPECT_TRUE(peaks(bell(100, 3.0, 6.0), 0.1, 5, false).empty());
}

TEST(Peaks, FainterThanTheThresholdAreLeftOut) {
    EXPECT_TRUE(peaks(bell(100, 50.0, 6.0), 1.1, 5, true).empty());
}

constexpr double kPositionLimit_deg = 1.0;
constexpr double kWavelengthLimit_nm = 5.0;
/// At these each disc shows two orders or more.
constexpr std::array<int, 6> kTurns_deg = {35, 65, 95, 125, 150, 170};

class DrawnLine : public testing::TestWithParam<const char*> {
 protected:
    DiscErrors measured(const Disturbance& disturbance = {}) {
        return measure_disc(bench_, GetParam(), kCameras[0], kTurns_deg, kPictureSize, disturbance);
    }

    Bench bench_{test::content_path("scenes/bench.glb")};
};

TEST_P(DrawnLine, LiesAndIsColouredAsTheFormulaSays) {
    const DiscErrors errors = measured();
    EXPECT_EQ(errors.pictures, 30);
    EXPECT_GT(errors.expected, 10);
    EXPECT_EQ(errors.missed, 0);
    EXPECT_GE(errors.position_deg.count, errors.expected);
    EXPECT_LT(errors.position_deg.largest, kPositionLimit_deg);
    EXPECT_GE(errors.all_wavelengths_nm().count, 5);
    EXPECT_GE(std::ranges::count_if(errors.wavelength_nm, [](const ErrorSum& order) { return order.count > 0; }), 2);
    EXPECT_LT(errors.all_wavelengths_nm().largest, kWavelengthLimit_nm);
}

TEST_P(DrawnLine, OfAnotherPitchHasOtherWavelengths) {
    const DiscErrors errors = measured({.pitch_factor = 1.01});
    EXPECT_LT(errors.position_deg.largest, kPositionLimit_deg);
    EXPECT_GT(errors.all_wavelengths_nm().largest, kWavelengthLimit_nm);
}

TEST_P(DrawnLine, OfTurnedGroovesLiesElsewhere) {
    EXPECT_GT(measured({.groove_rotation_deg = 2.0}).position_deg.rms(), kPositionLimit_deg);
}

INSTANTIATE_TEST_SUITE_P(Discs, DrawnLine, testing::Values("CD-R", "DVD-R"));

}  // namespace
}  // namespace rowland::evidence
