#include "modules/diffraction/model/colour_kernel.h"

#include <glm/geometric.hpp>

#include "engine/core/file.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/gratings.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

using test::compact_disc;
using test::OracleCase;

/// Low-pressure sodium's D lines, as a meter of 1 nm sees them.
colour::Illuminant sodium_lamp() {
    return colour::parse_illuminant("wavelength_nm,relative_power\n588,0\n589,1\n590,0\n", "sodium");
}

/// A(a) of band-limited light in a tangent frame.
class BandlimitedArcs {
 public:
    BandlimitedArcs(const lighting::ShLight& light, const glm::dmat3& tangent)
        : arcs_(light.bands, FlatLobe{}), light_(light.coefficients.size()) {
        math::ShRotation(tangent, light.bands).apply(std::span<const glm::dvec3>(light.coefficients), light_);
    }

    glm::dvec3 operator()(double a) const {
        std::vector<double> arc_frame(light_.size(), 0.0);
        std::vector<double> c(light_.size());
        arcs_.accumulate(a, 0.0, 550.0, 1.0, arc_frame);
        arcs_.to_tangent_frame(arc_frame, c);
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * light_[i];
        return sum;
    }

 private:
    ArcCoefficients arcs_;
    std::vector<glm::dvec3> light_;
};

/// d Σ_cells A(middle) k̄, with k's mean over the cell.
glm::dvec3 correlate(const ColourKernel& kernel, const Grating& grating, const BandlimitedArcs& arcs, double v_g,
                     int cells) {
    glm::dvec3 xyz(0.0);
    const double width = 2.0 / cells;
    for (int i = 0; i < cells; ++i) {
        const double a = -1.0 + (i + 0.5) * width;
        const double x = grating.pitch_nm * (a + v_g);
        const double half = 0.5 * grating.pitch_nm * width;
        xyz += grating.pitch_nm * width * kernel.average(x - half, x + half) * arcs(a);
    }
    return xyz + kernel.zero_order_xyz() * arcs(-v_g);
}

std::vector<glm::dvec3> radiance(const Grating& grating, const std::vector<ShadingPoint>& frames,
                                 const lighting::ShLight& light, const colour::LightSpectra& spectra, int cells) {
    const ColourKernel kernel(grating, spectra);
    std::vector<glm::dvec3> result;
    for (const ShadingPoint& frame : frames) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        const glm::dvec3 v = tangent * glm::normalize(frame.view);
        result.push_back(v.z > 0.0 ? correlate(kernel, grating, {light, tangent}, v.x, cells) : glm::dvec3(0.0));
    }
    return result;
}

/// MEASUREMENTS §4 gives .2–.4 %, .01–.16 % and .005–.05 % (measured here: .18–.44, .013–.16, .005–.053): held to the
/// upper ends, a tenth more allowed.
TEST(ColourKernel, CellsOfItsAntiderivativeGiveTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    int flat_cases = 0;
    for (const OracleCase& one : test::read_cases(path)) {
        if (!is_flat(one.grating.lobe)) continue;
        ++flat_cases;
        // 1024: PHYSICS §9.
        for (const auto& [cells, bound] : {std::pair{32, 0.0045}, {64, 0.0018}, {128, 0.00055}, {1024, 1e-4}}) {
            const double error =
                test::relative_rms(radiance(one.grating, one.frames, light, colour::LightSpectra(), cells), one.xyz);
            EXPECT_LT(error, bound) << one.name << " " << cells;
        }
    }
    EXPECT_GE(flat_cases, 3);
}

/// The definition, order by order: at whole nanometres nothing is interpolated; 1e-15 relative.
TEST(ColourKernel, IsTheSumOverOrdersAtEitherSign) {
    Grating blazed = compact_disc();
    blazed.profile = BlazedProfile{260.0};
    blazed.orders = {-2, -1, 1, 3};
    const colour::LightSpectra spectra;
    const ColourKernel kernel(blazed, spectra);
    for (const double x : {-1400.0, -1000.0, -500.0, 400.0, 600.0, 1500.0, 2100.0}) {
        glm::dmat3 expected(0.0);
        for (const Peak& peak : visible_peaks(x / blazed.pitch_nm, blazed.pitch_nm, blazed.orders))
            expected += order_efficiency(blazed, peak.order, peak.wavelength_nm) / std::abs(peak.order) *
                        glm::outerProduct(colour::cie_xyz(peak.wavelength_nm), spectra(peak.wavelength_nm));
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) EXPECT_NEAR(kernel(x)[c][o], expected[c][o], 1e-15) << x;
    }
    EXPECT_EQ(kernel.begin_nm(), -1560.0);
    EXPECT_EQ(kernel.end_nm(), 2340.0);
    EXPECT_EQ(kernel(-1561.0), glm::dmat3(0.0));
    EXPECT_EQ(kernel(0.0), glm::dmat3(0.0));
    // Blazed: order 1 outshines order −1 wherever both show the same wavelength.
    EXPECT_GT(kernel(550.0)[1][1], 10.0 * kernel(-550.0)[1][1]);
}

/// d𝒦/dx = k by central differences, whose error is k''h²/6: k is linear between kinks a nanometre apart times the
/// order, so h = 1e-3 clear of kinks leaves rounding, 1e-12.
TEST(ColourKernel, AntiderivativeIsTheIntegral) {
    const ColourKernel kernel(compact_disc(), colour::LightSpectra());
    EXPECT_EQ(kernel.antiderivative(0.0), glm::dmat3(0.0));
    const double h = 1e-3;
    for (const double x : {-1200.3, -500.7, -3.0, 470.2, 651.4, 901.3, 1400.7}) {
        const glm::dmat3 slope = (kernel.antiderivative(x + h) - kernel.antiderivative(x - h)) / (2.0 * h);
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) EXPECT_NEAR(slope[c][o], kernel(x)[c][o], 1e-12) << x;
    }
    // The whole rise of one order is the trapezoid sum of its spectrum.
    Grating first = compact_disc();
    first.orders = {1};
    const colour::LightSpectra spectra;
    const glm::dvec3 white = ColourKernel(first, spectra).antiderivative(1e9) * glm::dvec3(1.0);
    const glm::dvec3 expected = order_efficiency(first, 1, 550.0) * colour::rgb_to_xyz(spectra, glm::dvec3(1.0));
    for (int o = 0; o < 3; ++o) EXPECT_NEAR(white[o], expected[o], 1e-14);
}

TEST(ColourKernel, AverageDoesNotMindTheOrderOfItsEnds) {
    const ColourKernel kernel(compact_disc(), colour::LightSpectra());
    EXPECT_EQ(kernel.average(500.0, 620.0), kernel.average(620.0, 500.0));
    EXPECT_EQ(kernel.average(555.0, 555.0), kernel(555.0));
}

TEST(ColourKernel, OrderZeroIsApart) {
    Grating grating = compact_disc();
    grating.orders = {0};
    const colour::LightSpectra spectra;
    const ColourKernel kernel(grating, spectra);
    EXPECT_EQ(kernel(0.0), glm::dmat3(0.0));
    EXPECT_EQ(kernel.begin_nm(), kernel.end_nm());
    const glm::dvec3 white = kernel.zero_order_xyz() * glm::dvec3(1.0);
    EXPECT_NEAR(white.y, 0.25, 1e-12);  // (b/d)² of a light of Y = 1
    EXPECT_EQ(ColourKernel(compact_disc(), spectra).zero_order_xyz(), glm::dmat3(0.0));
}

/// Few grooves: against the reference, which sums the same Fejér ratios by code of its own. 20 grooves' orders are 19
/// nm wide; 1024 cells of 3 nm and the reference's 1 nm steps leave 3e-7 … 9e-6 (measured).
TEST(ColourKernel, OfFewGroovesAgreesWithTheReference) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const OracleCase one = test::read_cases(path).front();
    for (const double grooves : {1.0, 4.0, 20.0, 49.0}) {
        Grating few = one.grating;
        few.grooves = grooves;
        few.orders = {-1, 0, 1, 2};
        const colour::LightSpectra spectra;
        const auto expected = reference_radiance(few, light, spectra, one.frames);
        const double error = test::relative_rms(radiance(few, one.frames, light, spectra, 1024), expected);
        EXPECT_LT(error, 5e-5) << grooves;
    }
}

/// As N grows towards what counts as many, the blurred kernel's averages tend to the sharp one's: at 49 grooves tails
/// outside a window of ±100 nm about an order's light still hold a per cent or two.
TEST(ColourKernel, BlurVanishesWithManyGrooves) {
    Grating grating = compact_disc();
    grating.orders = {1};
    const colour::LightSpectra spectra;
    const glm::dmat3 sharp = ColourKernel(grating, spectra).average(300.0, 900.0);
    double before = 1.0;
    for (const double grooves : {2.0, 8.0, 49.0}) {
        grating.grooves = grooves;
        const glm::dmat3 blurred = ColourKernel(grating, spectra).average(300.0, 900.0);
        const double difference = std::abs(blurred[1][1] / sharp[1][1] - 1.0);
        EXPECT_LT(difference, before) << grooves;
        before = difference;
    }
    EXPECT_LT(before, 0.03);
}

/// F11's lamp lines stand out as maxima of Y at m × 436, 546 and 611 nm; D65 has no such maxima.
TEST(ColourKernel, OfAFluorescentLampHasLines) {
    Grating second = compact_disc();
    second.profile = SlitProfile{500.0};
    second.orders = {2};
    const auto maxima = [&](const char* name) {
        const ColourKernel kernel(second, colour::LightSpectra(colour::illuminant(name)));
        std::vector<double> found;
        // Per unit of what the eye sees there, so that only the lamp makes maxima.
        const auto lamp = [&](double wavelength_nm) {
            const glm::dvec3 xyz = kernel(2.0 * wavelength_nm) * glm::dvec3(1.0);
            return (xyz.x + xyz.y + xyz.z);
        };
        for (double wavelength_nm = 400.0; wavelength_nm <= 700.0; wavelength_nm += 1.0)
            if (lamp(wavelength_nm) > lamp(wavelength_nm - 1.0) && lamp(wavelength_nm) > lamp(wavelength_nm + 1.0))
                found.push_back(wavelength_nm);
        return found;
    };
    const std::vector<double> lines = maxima("F11");
    for (const double line : {436.0, 546.0, 611.0})
        EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](double x) { return std::abs(x - line) <= 3.0; }))
            << line;  // the table's step is 5 nm
    // Between the lines it is dark.
    const ColourKernel kernel(second, colour::LightSpectra(colour::illuminant("F11")));
    const auto y = [&](double wavelength_nm) { return (kernel(2.0 * wavelength_nm) * glm::dvec3(1.0)).y; };
    EXPECT_LT(y(565.0), 0.1 * y(545.0));
    EXPECT_LT(y(525.0), 0.2 * y(545.0));
}

TEST(ColourKernel, UnderSodiumIsYellowAtEachOrderAndDarkBetween) {
    Grating grating = compact_disc();
    grating.profile = SlitProfile{500.0};  // a slit of half the pitch has no order 2
    const ColourKernel kernel(grating, colour::LightSpectra(sodium_lamp()));
    const glm::dvec3 line = colour::cie_xyz(589.0);
    for (double x = -1560.0; x <= 1560.0; x += 0.5) {
        const glm::dvec3 xyz = kernel(x) * glm::dvec3(0.2, 0.5, 0.9);
        const double distance = std::min({std::abs(std::abs(x) - 589.0), 0.5 * std::abs(std::abs(x) - 1178.0)});
        if (distance >= 1.0)
            EXPECT_EQ(xyz, glm::dvec3(0.0)) << x;
        else
            EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), line.x / (line.x + line.y + line.z), 1e-3) << x;
    }
}

/// 2048 entries over four orders' 3120 nm are 1.5 nm apart: the error of linear interpolation is k'h²/8
/// (measured 1.5e-4 of the whole rise).
TEST(KernelTable, KeepsTheAntiderivative) {
    const ColourKernel kernel(compact_disc(), colour::LightSpectra());
    const KernelTable table = tabulate(kernel);
    EXPECT_EQ(table.antiderivative.size(), 2048U);
    const double error = interpolation_error(table, kernel);
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 2e-4);
    // Halving the step quarters the error, until single precision's 6e-8.
    const auto error_of = [&](std::size_t entries) { return interpolation_error(tabulate(kernel, entries), kernel); };
    EXPECT_NEAR(error_of(512) / error_of(1024), 4.0, 1.0);
    // A light 60 nm wide in x, as a fitted lobe is, sees k's own mean: 𝒦's error over 60 nm against k's size
    // (measured 2.7e-4).
    double largest = 0.0;
    double difference = 0.0;
    for (double x = -1700.0; x < 1700.0; x += 7.3) {
        const glm::dmat3 exact = kernel.average(x, x + 60.0);
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) {
                largest = std::max(largest, std::abs(exact[c][o]));
                difference = std::max(difference, std::abs(table.average(x, x + 60.0)[c][o] - exact[c][o]));
            }
    }
    EXPECT_LT(difference / largest, 4e-4);
    EXPECT_EQ(table.at(-1e9), table.at(kernel.begin_nm()));
    EXPECT_EQ(table.at(1e9), table.at(kernel.end_nm()));
}

TEST(KernelTable, OfNothingIsZero) {
    Grating none = compact_disc();
    none.orders = {0};
    const ColourKernel kernel(none, colour::LightSpectra());
    const KernelTable table = tabulate(kernel, 16);
    EXPECT_EQ(table.at(3.0), glm::dmat3(0.0));
    EXPECT_EQ(interpolation_error(table, kernel), 0.0);
}

}  // namespace
}  // namespace rowland::diffraction
