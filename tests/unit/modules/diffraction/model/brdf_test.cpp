#include <cmath>
#include <numbers>

#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

Grating slit(double grooves) {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = SlitProfile{600.0};
    grating.grooves = grooves;
    grating.orders = all_orders(grating.pitch_nm);
    return grating;
}

/// A unit vector above the surface with the given s_g.
glm::dvec3 direction(double s_g, double s_h) {
    return {s_g, s_h, std::sqrt(1.0 - s_g * s_g - s_h * s_h)};
}

TEST(Brdf, AguPeakIsTheSincOfTheFillFactor) {
    const Grating grating = slit(1500.0);
    const double wavelength_nm = 512.0;  // mλ/d is exact in binary: the peak itself is hit
    for (const int order : {-2, -1, 0, 1, 2, 3}) {
        const glm::dvec3 s = direction(0.25, 0.1);
        const glm::dvec3 v = direction(order * wavelength_nm / grating.pitch_nm - s.x, -0.2);
        const double expected = sinc(order * 600.0 / 1600.0) * sinc(order * 600.0 / 1600.0);
        // u rounds by 1e-16, which N = 1500 makes a phase of 1e-12.
        EXPECT_NEAR(brdf_agu(grating, s, v, wavelength_nm, 3.0), 3.0 * expected, 1e-10) << order;
    }
}

/// PHYSICS §3: f_A/f_E = 2λ/(N d (b/d)²) at every peak of a slit with a flat lobe.
TEST(Brdf, AguAndEnergyDifferByTheStatedRatio) {
    const Grating grating = slit(1500.0);
    for (const double wavelength_nm : {400.0, 550.0, 700.0})
        for (const int order : {-2, -1, 1, 2}) {
            const glm::dvec3 s = direction(0.05, 0.1);
            const glm::dvec3 v = direction(order * wavelength_nm / grating.pitch_nm - s.x, -0.2);
            const double ratio = brdf_agu(grating, s, v, wavelength_nm) / brdf_energy(grating, s, v, wavelength_nm);
            EXPECT_NEAR(ratio, 2.0 * wavelength_nm / (1500.0 * 1600.0 * std::pow(600.0 / 1600.0, 2)), 1e-12 * ratio);
        }
}

/// ∫ f_E s_n dω over the hemisphere, dω s_n = dg dh, is the listed orders' efficiency where they propagate for certain.
TEST(Brdf, OrdersIntegrateToTheirEfficiency) {
    Grating grating = slit(60.0);
    grating.orders = {1};
    grating.lobe = GaussianLobe{0.1};  // its whole bump is inside the disc for v near the normal
    const double wavelength_nm = 500.0;
    const glm::dvec3 v = direction(0.0, 0.0);
    const int nodes = 4000;
    double sum = 0.0;
    for (int i = 0; i < nodes; ++i) {
        const double s_g = (i + 0.5) / nodes;
        for (int j = 0; j < 400; ++j) {
            const double s_h = (j + 0.5) / 400.0 * 1.6 - 0.8;
            if (s_g * s_g + s_h * s_h < 1.0)
                sum += brdf_energy(grating, direction(s_g, s_h), v, wavelength_nm) / nodes * 1.6 / 400.0;
        }
    }
    // Order 1's period, x ∈ [½, 3/2], lies in s_g ∈ [.16, .47]; the rule resolves the lobes of N = 60.
    EXPECT_NEAR(sum, order_efficiency(grating, 1, wavelength_nm), 1e-4 * sum);
}

TEST(Brdf, IsBlackBelowTheSurfaceAndForOrdersNotListed) {
    Grating grating = slit(1500.0);
    grating.orders = {2};
    const double wavelength_nm = 512.0;
    const glm::dvec3 v = direction(0.0, 0.0);
    EXPECT_GT(brdf_energy(grating, direction(0.64, 0.0), v, wavelength_nm), 0.0);
    EXPECT_EQ(brdf_energy(grating, direction(0.32, 0.0), v, wavelength_nm), 0.0);
    glm::dvec3 below = direction(0.64, 0.0);
    below.z = -below.z;
    EXPECT_EQ(brdf_energy(grating, below, v, wavelength_nm), 0.0);
}

/// PHYSICS §9: 1e-12 relative where the ratio is above 1e-20, else 1e-20 absolute, against 60-digit arithmetic.
TEST(Fejer, MatchesHighPrecisionInDouble) {
    ROWLAND_TEST_DATA(path, "oracle/fejer_ratio.csv");
    const test::Csv oracle = test::read_csv(path);
    ASSERT_GT(oracle.rows.size(), 100U);
    for (std::size_t row = 0; row < oracle.rows.size(); ++row) {
        const double expected = oracle.number(row, "ratio");
        const double found = fejer(oracle.number(row, "N"), oracle.number(row, "delta"));
        const double tolerance = expected > 1e-20 ? 1e-12 * expected : 1e-20;
        EXPECT_NEAR(found, expected, tolerance)
            << "N " << oracle.text(row, "N") << " delta " << oracle.text(row, "delta");
    }
}

/// PHYSICS §9: 1e-5 absolute in float.
TEST(Fejer, MatchesHighPrecisionInFloat) {
    ROWLAND_TEST_DATA(path, "oracle/fejer_ratio.csv");
    const test::Csv oracle = test::read_csv(path);
    for (std::size_t row = 0; row < oracle.rows.size(); ++row) {
        const auto grooves = static_cast<float>(oracle.number(row, "N"));
        const auto delta = static_cast<float>(oracle.number(row, "delta"));
        EXPECT_NEAR(fejer(grooves, delta), oracle.number(row, "ratio"), 1e-5)
            << "N " << oracle.text(row, "N") << " delta " << oracle.text(row, "delta");
    }
}

/// ∫F_N = 1/N over a period. The midpoint rule with more than N nodes is exact for this trigonometric polynomial.
TEST(Fejer, MeanOverAPeriodIsOneOverN) {
    for (const int grooves : {1, 2, 7, 49, 1500}) {
        double sum = 0.0;
        const int nodes = 4 * grooves;
        for (int i = 0; i < nodes; ++i) sum += fejer(static_cast<double>(grooves), (i + 0.5) / nodes - 0.5);
        EXPECT_NEAR(sum / nodes, 1.0 / grooves, 1e-12) << grooves;
    }
}

TEST(Fejer, OneGrooveDoesNotInterfere) {
    for (const double delta : {0.0, 1e-9, 0.3, 0.5, 1.0}) EXPECT_EQ(fejer(1.0, delta), 1.0);
}

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

TEST(GratingEquation, AllOrdersAreThoseThatPropagateSomewhere) {
    EXPECT_EQ(all_orders(740.0), (std::vector<int>{-3, -2, -1, 1, 2, 3}));  // 3·380 < 1480 < 4·380
    EXPECT_EQ(all_orders(380.0), (std::vector<int>{-1, 1}));                // 2·380 = 2d is grazing on both sides
    EXPECT_EQ(all_orders(50000.0).size(), 2U * 263U);
    EXPECT_TRUE(all_orders(190.0).empty());
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
