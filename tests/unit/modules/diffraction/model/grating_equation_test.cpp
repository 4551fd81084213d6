#include "modules/diffraction/model/grating_equation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::diffraction {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Textbook and vendor examples, to the digits they print.
TEST(GratingEquation, GivesPublishedAngles) {
    ROWLAND_TEST_DATA(path, "data/facts/grating_angles_published.csv");
    const test::Csv facts = test::read_csv(path);
    ASSERT_EQ(facts.rows.size(), 5U);
    for (std::size_t row = 0; row < facts.rows.size(); ++row) {
        // The table's β is measured on the side of positive orders: sin α + sin β = mλ/d.
        const auto cosine =
            diffracted_cosine(std::sin(facts.number(row, "alpha_deg") * kDegree), facts.integer(row, "order"),
                              facts.number(row, "wavelength_nm"), facts.number(row, "pitch_nm"));
        const std::string& recomputed = facts.text(row, "recomputed");
        if (recomputed.starts_with("sin=")) {
            EXPECT_FALSE(cosine) << facts.text(row, "case");
            continue;
        }
        ASSERT_TRUE(cosine) << facts.text(row, "case");
        EXPECT_NEAR(std::asin(*cosine) / kDegree, std::stod(recomputed), 1e-4) << facts.text(row, "case");
    }
}

TEST(GratingEquation, InvertsToOneWavelengthAnOrder) {
    const std::vector<int> orders = {-2, -1, 0, 1, 2, 3};
    const auto peaks = visible_peaks(0.6, 1600.0, orders);  // x = 960 nm: 960, 480, 320
    ASSERT_EQ(peaks.size(), 1U);
    EXPECT_EQ(peaks[0].order, 2);
    EXPECT_DOUBLE_EQ(peaks[0].wavelength_nm, 480.0);
    const auto mirrored = visible_peaks(-0.6, 1600.0, orders);
    ASSERT_EQ(mirrored.size(), 1U);
    EXPECT_EQ(mirrored[0].order, -2);
    EXPECT_TRUE(visible_peaks(0.0, 1600.0, orders).empty());
}

TEST(GratingEquation, FoundPeaksLeaveInTheGivenDirection) {
    const double s_g = -0.2;
    const double v_g = 0.85;
    for (const Peak& peak : visible_peaks(s_g + v_g, 5000.0, all_orders(5000.0)))
        EXPECT_NEAR(*diffracted_cosine(s_g, peak.order, peak.wavelength_nm, 5000.0), v_g, 1e-14);
    EXPECT_EQ(visible_peaks(s_g + v_g, 5000.0, all_orders(5000.0)).size(), 4U);  // 3250 nm: orders 5, 6, 7, 8
}

TEST(GratingEquation, AllOrdersAreThoseThatPropagateSomewhere) {
    EXPECT_EQ(all_orders(740.0), (std::vector<int>{-3, -2, -1, 1, 2, 3}));  // 3·380 < 1480 < 4·380
    EXPECT_EQ(all_orders(380.0), (std::vector<int>{-1, 1}));                // 2·380 = 2d is grazing on both sides
    EXPECT_EQ(all_orders(50000.0).size(), 2U * 263U);
}

TEST(GratingEquation, PitchBelowHalfAWavelengthHasNoOrders) {
    EXPECT_TRUE(all_orders(190.0).empty());
    EXPECT_TRUE(all_orders(100.0).empty());
    EXPECT_FALSE(all_orders(190.1).empty());
}

/// Blu-ray (320 nm): no first order at normal incidence at any visible wavelength, but one at a slant.
TEST(GratingEquation, BluRayShowsNothingAtNormalIncidence) {
    ROWLAND_TEST_DATA(path, "data/facts/optical_media.csv");
    const test::Csv media = test::read_csv(path);
    for (std::size_t row = 0; row < media.rows.size(); ++row) {
        if (media.text(row, "quantity") != "track_pitch") continue;
        const double pitch_nm = 1000.0 * media.number(row, "value");
        const bool visible_at_normal = diffracted_cosine(0.0, 1, 380.0, pitch_nm).has_value();
        EXPECT_EQ(visible_at_normal, media.text(row, "medium") != "Blu-ray") << media.text(row, "medium");
        EXPECT_TRUE(diffracted_cosine(0.9, 1, 405.0, pitch_nm)) << media.text(row, "medium");
    }
}

}  // namespace
}  // namespace rowland::diffraction
