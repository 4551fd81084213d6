#include "editor/inspector/physics/order_panes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "editor/inspector/document.h"
#include "engine/colour/light_spectra.h"
#include "engine/colour/observer.h"
#include "modules/diffraction/model/efficiency.h"

namespace rowland::inspector {
namespace {

const diffraction::Grating kCd{.pitch_nm = 1600.0, .profile = diffraction::SlitProfile{600.0}};

TEST(AngleCurve, PeaksStandWhereTheGratingEquationHasThem) {
    const AngleCurve curve = angle_curve(kCd, 550.0, 20.0);
    ASSERT_EQ(curve.peaks.size(), 4U);  // the mirror, ±1 and +2; −2 would need sin = −1.03
    for (const OrderPeak& peak : curve.peaks) {
        const double sum =
            std::sin(peak.angle_deg * std::numbers::pi / 180.0) + std::sin(20.0 * std::numbers::pi / 180.0);
        EXPECT_NEAR(1600.0 * sum, peak.order * 550.0, 1e-9);  // nm, of sines in double
    }
}

TEST(AngleCurve, APeakIsItsEfficiencyTimesItsSharpness) {
    for (const OrderPeak& peak : angle_curve(kCd, 550.0, 20.0).peaks) {
        if (peak.order == 0) continue;
        // N d/λ · D_h, the flat lobe's ½; F_N is 1 to 1e-9 where rounding of the angle leaves the peak by 1e-13.
        EXPECT_NEAR(peak.brdf, peak.efficiency * 1500.0 * 1600.0 / 550.0 * 0.5, 1e-6 * peak.brdf) << peak.order;
        EXPECT_EQ(peak.efficiency, diffraction::order_efficiency(kCd, peak.order, 550.0));
    }
}

TEST(AngleCurve, TheCurveReachesThePeaksAndAscends) {
    const AngleCurve curve = angle_curve(kCd, 480.0, -35.0);
    double highest = 0.0;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
        EXPECT_GE(curve.points[i].x, curve.points[i == 0 ? 0 : i - 1].x);
        highest = std::max(highest, curve.points[i].y);
    }
    const auto tallest = std::max_element(curve.peaks.begin(), curve.peaks.end(),
                                          [](const auto& a, const auto& b) { return a.brdf < b.brdf; });
    EXPECT_NEAR(highest, tallest->brdf, 1e-9 * highest);
}

TEST(EfficiencyCurves, AreTheModelsAndOfManyOrdersTheStrongest) {
    diffraction::Grating many = kCd;
    many.orders = {-4, -3, -2, -1, 1, 2, 3, 4};
    const auto curves = efficiency_curves(many, 5);
    ASSERT_EQ(curves.size(), 5U);
    std::vector<int> orders;
    for (const EfficiencyCurve& curve : curves) orders.push_back(curve.order);
    EXPECT_EQ(orders, (std::vector<int>{-2, -1, 0, 1, 2}));
    EXPECT_EQ(curves[3].points[10], glm::dvec2(420.0, diffraction::order_efficiency(many, 1, 420.0)));
    EXPECT_EQ(curves[2].points[10], glm::dvec2(420.0, diffraction::zero_order_efficiency(many, 420.0)));
}

/// The efficiency pane follows the fields of the cover: the first order loses its blue, and has it back after undo.
TEST(EfficiencyCurves, FollowTheCoverAndItsUndo) {
    Document document = Document::make_new(Json::parse(R"({"grating": {"pitch_nm": 1600, "orders": [1],
                                    "profile": {"type": "lamellar", "duty": 0.35, "depth_nm": 130}}})"),
                                           "m.json", ".");
    const auto blue = [&] {
        for (const EfficiencyCurve& curve : efficiency_curves(document.material().grating))
            if (curve.order == 1)
                for (const glm::dvec2& point : curve.points)
                    if (point.x == 452.0) return point.y;
        return -1.0;
    };
    EXPECT_NEAR(blue(), 0.303, 3e-3);
    document.set_choice(field_at("/cover"), "over the grooves");
    document.finish_edit();
    const double under_polycarbonate = blue();
    EXPECT_NEAR(under_polycarbonate, 0.025, 3e-3);
    document.set_value(field_at("/cover/ior"), 1.3);
    document.finish_edit();
    EXPECT_GT(blue(), 5.0 * under_polycarbonate);
    document.set_value(field_at("/cover/tint"), {1, 1, 0});
    document.finish_edit();
    EXPECT_LT(blue(), 1e-3);
    for (int step = 0; step < 3; ++step) document.undo();
    EXPECT_NEAR(blue(), 0.303, 3e-3);
    EXPECT_FALSE(document.can_undo());
}

TEST(KernelStrip, ItsCellsSumToTheKernelsRise) {
    const colour::LightSpectra d65;
    const diffraction::KernelTable kernel = tabulate(diffraction::ColourKernel(kCd, d65));
    const KernelStrip strip = kernel_strip(kernel, kCd.pitch_nm, 300);
    const double cell = (strip.end_nm - strip.begin_nm) / 300.0;
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& xyz : strip.xyz) sum += xyz * cell;
    const glm::dvec3 rise = (kernel.at(strip.end_nm) - kernel.at(strip.begin_nm)) * glm::dvec3(1.0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i], rise[i], 1e-9 * rise.y);
}

TEST(KernelStrip, ShowsThePathDifferencesThatThereAre) {
    diffraction::Grating coarse = kCd;
    coarse.orders = {1};
    const colour::LightSpectra d65;
    const KernelStrip strip = kernel_strip(tabulate(diffraction::ColourKernel(coarse, d65)), 1600.0);
    EXPECT_NEAR(strip.begin_nm, 380.0, 1.0);
    EXPECT_NEAR(strip.end_nm, 780.0, 1.0);
    coarse.orders = {0};
    EXPECT_TRUE(kernel_strip(tabulate(diffraction::ColourKernel(coarse, d65)), 1600.0).xyz.empty());
}

TEST(OrderDirections, LightLeavesAcrossTheGroovesAndMirroredAlongThem) {
    const glm::dvec3 s = glm::normalize(glm::dvec3(0.3, 0.2, 1.0));
    const auto traces = order_directions(kCd, s);
    ASSERT_EQ(traces.size(), 5U);
    for (const OrderTrace& trace : traces)
        for (const OrderSpot& spot : trace.spots) {
            EXPECT_NEAR(1600.0 * (s.x + spot.v_g), trace.order * spot.wavelength_nm, 1e-9);
            EXPECT_EQ(spot.v_h, -s.y);
            EXPECT_LT(spot.v_g * spot.v_g + spot.v_h * spot.v_h, 1.0);
        }
}

}  // namespace
}  // namespace rowland::inspector
