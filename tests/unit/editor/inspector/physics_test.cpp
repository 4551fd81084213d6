#include "editor/inspector/physics.h"

#include <fmt/format.h>

#include <cstdio>
#include <glm/geometric.hpp>
#include <sstream>

#include "editor/inspector/document.h"
#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

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
    const auto curves = efficiency_curves(many, 0.0, 5);
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

using diffraction::Grating;

std::vector<Grating> gratings() {
    const Grating slit{.pitch_nm = 1600.0, .profile = diffraction::SlitProfile{800.0}, .metal = colour::Metal::Al};
    Grating dense = slit;
    dense.pitch_nm = 320.0;
    dense.profile = diffraction::LamellarProfile{.duty = 0.5, .depth_nm = 60.0};
    Grating blazed = slit;
    blazed.profile = diffraction::BlazedProfile{250.0};
    blazed.metal.reset();
    Grating agu = slit;
    agu.normalization = diffraction::Normalization::Agu;
    Grating table{.pitch_nm = 1600.0, .orders = {-1, 1}};
    table.profile =
        diffraction::EfficiencyTable{.orders = {-1, 0, 1}, .slices = {{0.0, {400.0, 700.0}, {.2, .3, .2, .1, .4, .3}}}};
    Grating dyed = slit;
    dyed.cover = diffraction::Cover{.ior = 1.58, .tint = {0.25, 0.45, 0.9}};
    return {slit, dense, blazed, agu, table, dyed};
}

TEST(EnergyBalance, FractionsSumToOne) {
    for (const Grating& grating : gratings())
        for (const double nm : {400.0, 550.0, 700.0})
            for (const double s_g : {-0.9, 0.0, 0.5}) {
                const EnergyBalance b = energy_balance(grating, nm, s_g);
                for (const double part : {b.orders, b.zero, b.evanescent, b.absorbed, b.residual}) EXPECT_GE(part, 0.0);
                // Sums of five doubles near 1.
                EXPECT_NEAR(b.orders + b.zero + b.evanescent + b.absorbed + b.residual, 1.0, 1e-12);
            }
}

TEST(EnergyBalance, ASlitsFractionsAreThoseOfTheFormula) {
    const Grating slit = gratings()[0];
    const EnergyBalance b = energy_balance(slit, 550.0, 0.0);
    const double r = colour::metal_reflectance(colour::Metal::Al, 550.0);
    // Half of the pitch reflects: η_0 = R/4, η_±1 = R/π², η_±2 = 0, all of which leave at normal incidence.
    EXPECT_NEAR(b.zero, r / 4.0, 1e-12);
    EXPECT_NEAR(b.orders, 2.0 * r / (3.14159265358979 * 3.14159265358979), 1e-12);
    EXPECT_NEAR(b.absorbed, 1.0 - r, 1e-12);
    EXPECT_EQ(b.evanescent, 0.0);
}

TEST(EnergyBalance, OrdersThatCannotLeaveAreEvanescent) {
    const Grating dense = gratings()[1];  // 320 nm: at normal incidence no order of 550 nm leaves
    const EnergyBalance straight = energy_balance(dense, 550.0, 0.0);
    EXPECT_EQ(straight.orders, 0.0);
    EXPECT_GT(straight.evanescent, 0.1);
    const EnergyBalance grazing = energy_balance(dense, 550.0, 0.9);  // +1: 1.72 − 0.9 < 1
    EXPECT_NEAR(grazing.orders, straight.evanescent / 2.0, 1e-12);
}

TEST(EnergyBalance, ATableAbsorbsWhatItsOrdersLeaveOver) {
    EXPECT_NEAR(energy_balance(gratings()[4], 400.0, 0.0).absorbed, 0.3, 1e-12);
    EXPECT_NEAR(energy_balance(gratings()[4], 700.0, 0.0).absorbed, 0.2, 1e-12);
}

diffraction::Material foil(const glm::dvec2& a_nm, const glm::dvec2& b_nm) {
    diffraction::Material material;
    material.grating.orders.clear();
    const diffraction::SinusoidalProfile grooves{110.0};
    material.grating.lattice = diffraction::Lattice{
        .a_nm = a_nm, .b_nm = b_nm, .profile = diffraction::CrossedProfile{grooves, grooves}, .orders = 1};
    material.grating.pitch_nm = 1000.0;
    return material;
}

/// The brightest texel with u_h near 0 and u_g > 0.
double brightest_u_g(const PatternFigure& figure) {
    double best = 0.0;
    for (double u = 0.1; u < figure.half_width; u += 0.005)
        if (best == 0.0 || figure.at(u, 0.0).y > figure.at(best, 0.0).y) best = u;
    return best;
}

TEST(PatternFigure, AnOrderIsASpectrumWithVioletInside) {
    const PatternFigure figure = pattern_figure(foil({1000.0, 0.0}, {0.0, 1000.0}));
    ASSERT_GT(figure.size, 0);
    // u = λ/a: 440 nm, 550 nm and 640 nm.
    const glm::dvec3 violet = figure.at(0.44, 0.0);
    const glm::dvec3 green = figure.at(0.55, 0.0);
    const glm::dvec3 red = figure.at(0.64, 0.0);
    EXPECT_GT(violet.z, 2.0 * violet.y);
    EXPECT_GT(green.y, 1.2 * green.x);
    EXPECT_GT(red.x, 1.5 * red.y);
    EXPECT_LT(figure.at(0.25, 0.0).y, 0.01 * green.y);  // between the middle and the order
    EXPECT_LT(figure.at(0.55, 0.25).y, 0.01 * green.y);
    EXPECT_GT(figure.at(0.55, 0.55).y, 0.01 * green.y);  // order (1, 1) on the diagonal
}

TEST(PatternFigure, ItFollowsTheLattice) {
    const double at = brightest_u_g(pattern_figure(foil({1000.0, 0.0}, {0.0, 1000.0})));
    const double wider = brightest_u_g(pattern_figure(foil({2000.0, 0.0}, {0.0, 1000.0})));
    EXPECT_NEAR(wider, at / 2.0, 0.01);  // two texels
    EXPECT_NEAR(at, 0.55, 0.03);
    // b (500, 1000): a* = (1, −0.5)/1000 nm, so that order (1, 0) leaves the g axis.
    const PatternFigure skewed = pattern_figure(foil({1000.0, 0.0}, {500.0, 1000.0}));
    EXPECT_GT(skewed.at(0.55, -0.275).y, 10.0 * skewed.at(0.55, 0.0).y);
}

TEST(PatternFigure, WithoutLightItIsEmpty) {
    diffraction::Material dark = foil({1000.0, 0.0}, {0.0, 1000.0});
    dark.grating.lattice->profile = diffraction::ApertureProfile{1000.0, 1000.0};  // all light goes to order 0
    EXPECT_EQ(pattern_figure(dark).size, 0);
}

const std::filesystem::path kMaterials = test::content_path("materials");

/// The frame of a point as the programs read it, and as we do.
constexpr auto kUniform = diffraction::GrooveLayout::FlatUniform;
const diffraction::ShadingPoint kFrame{.view = {0.2, 0.6, 0.77}, .normal = {0.0, 1.0, 0.1}, .grating = {1.0, 0.0, 0.3}};

/// The numbers of the row that rowland-trade prints.
glm::dvec3 evaluated(const std::string& arguments, const std::filesystem::path& folder) {
    write_file_atomic(folder / "frames.csv", "vx,vy,vz,nx,ny,nz,gx,gy,gz\n0.2,0.6,0.77,0,1,0.1,1,0,0.3\n");
    const std::string frames = (folder / "frames.csv").string();
    const test::Ended ended =
        test::run(test::command(ROWLAND_TRADE, fmt::format("evaluate {} --frames '{}'", arguments, frames)));
    EXPECT_EQ(ended.code, 0) << ended.err;
    std::istringstream text(ended.out);
    std::string line;
    std::getline(text, line);
    std::getline(text, line);
    glm::dvec3 xyz(-1.0);
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &xyz.x, &xyz.y, &xyz.z), 3) << line;
    return xyz;
}

void expect_same(const glm::dvec3& a, const glm::dvec3& b, double relative, const std::string& what) {
    EXPECT_LE(glm::length(a - b), relative * glm::length(b)) << what << ": " << a.y << " and " << b.y;
    EXPECT_GT(b.y, 0.0) << what;
}

struct Lit {
    diffraction::CookedMaterial cooked;
    lighting::ProbeImage image;
    diffraction::EvaluationLight light;
};

/// A shipped material under a probe.
Lit lit(const char* material, const std::filesystem::path& probe) {
    lighting::ProbeImage image(image::load_image(probe), lighting::Mapping::Equirectangular);
    diffraction::EvaluationLight light(image, 16, math::SphericalWindow::None);
    return {diffraction::bake_material(with_efficiencies(Document::open(kMaterials / material).material(), material)),
            std::move(image), std::move(light)};
}

// The panes' numbers follow material and probe, and are what the programs print of them.
TEST(PointRadiance, IsWhatEvaluatePrints) {
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    ROWLAND_TEST_DATA(sunset, "probes/pmndrs_sunset.exr");
    const test::TemporaryFolder folder;
    glm::dvec3 last(0.0);
    for (const auto& [material, probe] : {std::pair{"cd.json", venice}, std::pair{"ruled_1200.json", sunset}}) {
        const auto [cooked, image, light] = lit(material, probe);
        const PointRadiance point = point_radiance(cooked, image, light, kFrame, kUniform);

        const std::string of_probe = fmt::format("--probe '{}'", probe.string());
        const std::string source = (kMaterials / material).string();
        // Nine digits are printed.
        expect_same(point.reference,
                    evaluated(fmt::format("--material '{}' {} --method reference", source, of_probe), folder.path()),
                    1e-8, "reference");
        const std::string baked = (folder.path() / "m.material").string();
        ASSERT_EQ(test::run({ROWLAND_COOK, "cook", source, "--output", baked}).code, 0);
        expect_same(point.drawn, evaluated(fmt::format("--cooked '{}' {}", baked, of_probe), folder.path()), 1e-8,
                    "drawn");
        EXPECT_GT(glm::distance(point.reference, last), 0.01 * glm::length(last)) << "another probe or material";
        last = point.reference;
    }
}

TEST(PointRadiance, ItsSpectrumIsItsColour) {
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    const auto [cooked, image, light] = lit("cd.json", venice);
    const PointRadiance point = point_radiance(cooked, image, light, kFrame, kUniform);
    ASSERT_EQ(point.spectrum.size(), 401U);
    glm::dvec3 xyz(0.0);
    for (std::size_t i = 0; i < point.spectrum.size(); ++i) {
        const double weight = i == 0 || i + 1 == point.spectrum.size() ? 0.5 : 1.0;  // trapezoid
        xyz += weight * point.spectrum[i] * colour::cie_xyz(380.0 + static_cast<double>(i));
    }
    // The reference takes finer steps where the probe is sharp, and samples the panels of an arc at other points.
    expect_same(xyz, point.reference, 5e-3, "spectrum");
}

TEST(ViewSweep, TheReferenceAndWhatIsDrawnAreThoseOfAPoint) {
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    const auto [cooked, image, light] = lit("cd.json", venice);
    const ViewSweep sweep = view_sweep(cooked, image, light, kFrame, kUniform, 5, 9);
    diffraction::ShadingPoint straight = kFrame;
    straight.view = glm::normalize(kFrame.normal);
    const PointRadiance point = point_radiance(cooked, image, light, straight, kUniform);
    EXPECT_NEAR(sweep.angles_deg[4], 0.0, 1e-12);
    EXPECT_NEAR(sweep.reference[4], point.reference.y, 1e-9 * point.reference.y);
    EXPECT_NEAR(sweep.drawn[4], point.drawn.y, 1e-9 * point.drawn.y);
    EXPECT_GT(std::abs(sweep.harmonics[4] - point.drawn.y), 1e-6 * point.drawn.y);
}

FilmCurves curves_of(const FilmInputs& inputs) {
    return film_curves(inputs, std::stop_token(), [](const FilmCurves&) {}).value();
}

TEST(FilmCurves, OfTheTableAreWithinOnePercentWhereGltfsFormulaIsNot) {
    const FilmCurves soap = curves_of({});
    EXPECT_TRUE(soap.complete);
    EXPECT_LT(soap.table_error, 0.01);
    EXPECT_GT(soap.formula_error, 0.05);
    ASSERT_EQ(soap.over_thickness.table.size(), soap.thicknesses_nm.size());
    ASSERT_EQ(soap.over_angle.table.size(), soap.angles_deg.size());
}

TEST(FilmCurves, FollowEveryInput) {
    const FilmCurves before = curves_of({});
    const thin_film::Layer soap;
    for (const FilmInputs& changed :
         {FilmInputs{.film = {.layers = {soap, {.index = 1.5}}, .base = std::complex<double>(1.0)}},
          FilmInputs{.film = {.layers = {soap}, .base = colour::Metal::Au}}, FilmInputs{.roughness = 0.4},
          FilmInputs{.illuminant = "A"}}) {
        const FilmCurves after = curves_of(changed);
        EXPECT_NE(after.over_angle.exact, before.over_angle.exact);
        EXPECT_NE(after.over_angle.table, before.over_angle.table);
    }
    EXPECT_NE(curves_of({.angle_deg = 60.0}).spectrum, before.spectrum);
}

TEST(FilmCurves, OfNoFilmAreThoseOfTheBase) {
    const FilmCurves bare = curves_of({.film = {.layers = {{.thickness_nm = 0.0}}, .base = std::complex(1.5, 0.0)}});
    for (std::size_t i = 0; i < bare.spectrum.size(); ++i) EXPECT_NEAR(bare.spectrum[i].y, bare.bare[i].y, 1e-12);
    EXPECT_NEAR(bare.over_angle.exact.front().y, 0.04, 1e-4);
}

TEST(FilmCurves, OfAThickFilmAreThoseOfItsLast800Nanometres) {
    const auto curves = curves_of({.film = {.layers = {{.thickness_nm = 5000.0}}, .base = colour::Metal::Al}});
    EXPECT_EQ(curves.thicknesses_nm.front(), 5000.0 - 800.0);
    EXPECT_EQ(curves.thicknesses_nm.back(), 5000.0);
    EXPECT_EQ(curves.over_thickness.exact.back(), curves.over_angle.exact.front());
}

TEST(FilmCurves, AreShownWithoutTheTableFirstAndStopWhenAsked) {
    std::stop_source stop;
    bool shown = false;
    const auto stopped = film_curves({}, stop.get_token(), [&](const FilmCurves& curves) {
        shown = !curves.complete && !curves.over_angle.exact.empty() && curves.over_angle.table.empty();
        stop.request_stop();
    });
    EXPECT_TRUE(shown);
    EXPECT_FALSE(stopped);
}

}  // namespace
}  // namespace rowland::inspector
