#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/quadrature.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/files.h"
#include "tests/support/threads.h"
#include "tests/unit/modules/diffraction/gratings.h"
#include "tests/unit/modules/diffraction/reference/json_oracle.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {

namespace {

using test::compact_disc;
using test::OracleCase;
using test::relative_rms;

const ShadingPoint kFrame{.view = {0.3, 0.1, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};

lighting::ShLight uniform_light(const glm::dvec3& radiance) {
    // Y_00 = 1/(2√π).
    return {.bands = 1, .coefficients = {radiance * 2.0 * std::sqrt(std::numbers::pi)}};
}

/// PHYSICS §9: 1e-4 relative RMS, every grating by itself.
TEST(Reference, MatchesTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const std::vector<OracleCase> cases = test::read_cases(path);
    ASSERT_EQ(cases.size(), 5U);
    for (const OracleCase& one : cases) {
        const auto found = reference_radiance(one.grating, light, colour::LightSpectra(), one.frames);
        const double error = relative_rms(found, one.xyz);
        EXPECT_LT(error, 1e-4) << one.name;
    }
}

/// PHYSICS §9: 1e-4, pits 1e-3. A wrong sign of g, a lost metal, a lost λ/550, a wrong column of the table or a pit of
/// another wavelength cannot pass.
TEST(Reference, MatchesTheAsymmetricOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited_asymmetric.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const std::vector<test::JsonCase> cases = test::read_json_cases(path);
    ASSERT_EQ(cases.size(), 6U);
    for (const test::JsonCase& one : cases) {
        ASSERT_EQ(one.frames.size(), 12U) << one.name;
        const auto found = reference_radiance(one.grating, light, colour::LightSpectra(), one.frames);
        const double error = relative_rms(found, one.xyz);
        EXPECT_LT(error, one.name == "pits" ? 1e-3 : 1e-4) << one.name;
    }
}

lighting::ProbeImage load_probe(const std::filesystem::path& path, lighting::Mapping mapping) {
    return {image::load_image(path), mapping, path.string()};
}

struct ProbeCase {
    std::string name;
    std::string file;
    lighting::Mapping mapping = lighting::Mapping::Equirectangular;
    double tolerance = 0.01;
};

constexpr std::size_t kFrameStep = 4;  ///< each frame takes .2 s under a large probe

class ReferenceUnderProbe : public ::testing::TestWithParam<ProbeCase> {};

/// PHYSICS §9: 1 % on real probes at full resolution; 3 % where lamps are a texel wide.
TEST_P(ReferenceUnderProbe, MatchesTheNamedFrameSets) {
    const ProbeCase& one = GetParam();
    ROWLAND_TEST_DATA(probe_path, "probes/" + one.file);
    const auto probe = load_probe(probe_path, one.mapping);
    for (const std::string set : {"tilted_cd", "sphere"}) {
        ROWLAND_TEST_DATA(frames_path, "oracle/frames_" + set + ".csv");
        ROWLAND_TEST_DATA(oracle_path, "oracle/radiance_" + set + "_" + one.name + ".csv");
        const auto all = test::read_frames(rowland::test::read_csv(frames_path));
        const auto all_xyz = test::read_xyz(rowland::test::read_csv(oracle_path));
        std::vector<ShadingPoint> frames;
        std::vector<glm::dvec3> expected;
        for (std::size_t i = 0; i < all.size(); i += kFrameStep) {
            frames.push_back(all[i]);
            expected.push_back(all_xyz[i]);
        }
        const double error =
            relative_rms(reference_radiance(compact_disc(), probe, colour::LightSpectra(), frames), expected);
        EXPECT_LT(error, one.tolerance) << set;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Named, ReferenceUnderProbe,
    ::testing::Values(ProbeCase{"grace", "grace_probe.hdr", lighting::Mapping::Angular},
                      ProbeCase{"ennis", "ennis_probulator.hdr"}, ProbeCase{"blender_sunset", "blender_sunset.exr"},
                      ProbeCase{"royal_esplanade", "royal_esplanade_1k.hdr", lighting::Mapping::Equirectangular, 0.03}),
    [](const auto& one) { return one.param.name; });

/// PHYSICS §9: 0.5 %; the oracle's wavelengths are 2 nm apart.
TEST(Reference, MatchesVeniceSunset) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_venice_sunset_256.csv");
    ROWLAND_TEST_DATA(probe_path, "probes/venice_sunset_256.hdr");
    const auto probe = load_probe(probe_path, lighting::Mapping::Equirectangular);
    const std::vector<OracleCase> cases = test::read_cases(path);
    ASSERT_EQ(cases.size(), 5U);
    for (const OracleCase& one : cases) {
        const auto found = reference_radiance(one.grating, probe, colour::LightSpectra(), one.frames);
        const double error = relative_rms(found, one.xyz);
        EXPECT_LT(error, 0.005) << one.name;
    }
}

/// PHYSICS §9: 1e-4 under band-limited light, 0.5 % under the probe.
void expect_oracle(const std::filesystem::path& path, std::size_t count) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    ROWLAND_TEST_DATA(probe_path, "probes/venice_sunset_256.hdr");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const auto probe = load_probe(probe_path, lighting::Mapping::Equirectangular);
    const std::vector<test::JsonCase> cases = test::read_json_cases(path);
    ASSERT_EQ(cases.size(), count);
    for (const test::JsonCase& one : cases) {
        const bool band_limited = one.light == "bandlimited_light_n5";
        const auto found = reference_radiance(one.grating, band_limited ? IncidentLight(light) : IncidentLight(probe),
                                              colour::LightSpectra(), one.frames);
        const double error = relative_rms(found, one.xyz);
        EXPECT_LT(error, band_limited ? 1e-4 : 0.005) << one.name << " " << one.light;
    }
}

/// A cover of glass, one with a dye, a blazed gold grating of a narrow lobe: T(s_n), T(v_n), the phase and the metal in
/// the medium, the dye in both passes.
TEST(Reference, MatchesTheOracleOfCovers) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_cover.csv");
    expect_oracle(path, 6);
}

/// A relief and slits with a lobe, light from behind.
TEST(Reference, MatchesTheOracleOfTransmission) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_transmission.csv");
    expect_oracle(path, 4);
}

/// Under uniform light A(a) = L √(1−a²), so XYZ = Σ_m ∫ η_m cmf E L √(1−a²) dλ by hand. The integrand has a square-root
/// end where an order reaches the horizon, none here: rounding only.
TEST(Reference, UniformLightHasTheClosedForm) {
    Grating grating = compact_disc();
    grating.orders = {1};
    const glm::dvec3 rgb(0.5, 0.7, 0.2);
    const ShadingPoint frame{.view = {0.1, 0.3, 0.9}, .normal = {0, 0, 1}, .grating = {1, 0, 0}};
    const double v_g = glm::normalize(frame.view).x;
    const colour::LightSpectra spectra;
    glm::dvec3 expected(0.0);
    for (int wavelength_nm = 380; wavelength_nm <= 780; ++wavelength_nm) {
        const double a = wavelength_nm / 1600.0 - v_g;
        const double weight = (wavelength_nm == 380 || wavelength_nm == 780 ? 0.5 : 1.0) *
                              profile_efficiency(grating.profile, 1600.0, 1, wavelength_nm) * std::sqrt(1.0 - a * a);
        expected += weight * glm::dot(spectra(wavelength_nm), rgb) * colour::cie_xyz(wavelength_nm);
    }
    const auto found = reference_radiance(grating, uniform_light(rgb), spectra, std::span(&frame, 1));
    EXPECT_LT(relative_rms(found, {expected}), 1e-12);
}

TEST(Reference, ViewBelowTheHorizonIsBlack) {
    ShadingPoint below = kFrame;
    below.view.z = -0.2;
    const auto found = reference_radiance(compact_disc(), uniform_light(glm::dvec3(1.0)), colour::LightSpectra(),
                                          std::span(&below, 1));
    EXPECT_EQ(found[0], glm::dvec3(0.0));
}

TEST(Reference, GrazingViewsStayFinite) {
    std::vector<ShadingPoint> frames;
    for (const double v_n : {1e-12, 1e-6, 0.01}) {
        frames.push_back({.view = {1.0, 0.0, v_n}, .normal = {0, 0, 1}, .grating = {1, 0, 0}});
        frames.push_back({.view = {0.0, 1.0, v_n}, .normal = {0, 0, 1}, .grating = {1, 0, 0}});
    }
    for (const GrooveLobe& lobe :
         {GrooveLobe{FlatLobe{}}, GrooveLobe{GaussianLobe{1e-3}}, GrooveLobe{GaussianLobe{1e3}},
          GrooveLobe{PitsLobe{850.0, 0.3}}, GrooveLobe{PitSequenceLobe{{1200.0, 2700.0}, 0.3, 0.05}}}) {
        Grating grating = compact_disc();
        grating.lobe = lobe;
        for (const glm::dvec3& xyz :
             reference_radiance(grating, uniform_light(glm::dvec3(1.0)), colour::LightSpectra(), frames)) {
            EXPECT_TRUE(std::isfinite(xyz.x + xyz.y + xyz.z));
            EXPECT_GE(xyz.y, 0.0);
        }
    }
}

/// The obvious sum: s_n dω is ds_g ds_h, so an arc is ∫ L D_h ds_h (PHYSICS §4). 1e-3: a thousand steps of s_h cut the
/// horizon anywhere within the last.
TEST(Reference, OfAPitSequenceIsTheSumAlongTheGrooves) {
    Grating grating = compact_disc();
    grating.lobe = PitSequenceLobe{};
    const lighting::ShLight light{
        .bands = 2, .coefficients = {{3.0, 2.5, 2.0}, {0.5, 0.2, -0.3}, {0.4, 0.6, 0.8}, {0.7, -0.2, 0.1}}};
    const IncidentLight incident(light);
    const colour::LightSpectra spectra;
    for (const glm::dvec2& v : {glm::dvec2(0.3, -0.4), glm::dvec2(-0.1, 0.7)}) {
        const glm::dvec3 view(v, std::sqrt(1.0 - glm::dot(v, v)));
        glm::dvec3 expected(0.0);
        for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; ++nm) {
            const LobeDensity density(grating.lobe, nm);
            for (const int order : grating.orders) {
                const double s_g = order * nm / grating.pitch_nm - view.x;
                if (std::abs(s_g) >= 1.0) continue;
                const double r = std::sqrt(1.0 - s_g * s_g);
                constexpr int kSteps = 1000;
                glm::dvec3 arc(0.0);
                for (int i = 0; i < kSteps; ++i) {
                    const double s_h = r * ((2.0 * i + 1.0) / kSteps - 1.0);
                    arc += 2.0 * r / kSteps * density(s_h + view.y) *
                           incident.radiance({s_g, s_h, std::sqrt(r * r - s_h * s_h)});
                }
                const double step_nm = nm == colour::kVisibleMin || nm == colour::kVisibleMax ? 0.5 : 1.0;
                expected += step_nm * order_efficiency(grating, order, nm) * (observed_spectra(spectra, nm) * arc);
            }
        }
        const ShadingPoint point{.view = view, .normal = {0, 0, 1}, .grating = {1, 0, 0}};
        const glm::dvec3 found = reference_radiance(grating, light, spectra, std::span(&point, 1)).front();
        EXPECT_LT(glm::length(found - expected), 1e-3 * glm::length(expected)) << v.x << " " << v.y;
    }
}

TEST(Reference, DoesNotDependOnTheNumberOfThreads) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const OracleCase one = test::read_cases(path).front();
    rowland::test::expect_same_on_any_threads(
        [&] { return reference_radiance(one.grating, light, colour::LightSpectra(), one.frames); });
}

/// A coarse grating's hundreds of orders: finite, and no more than the light that falls in.
TEST(Reference, TakesHundredsOfOrders) {
    Grating grating = compact_disc();
    grating.pitch_nm = 50000.0;
    grating.profile = SlitProfile{20000.0};
    grating.orders = all_orders(grating.pitch_nm);
    ASSERT_EQ(grating.orders.size(), 526U);
    const auto found =
        reference_radiance(grating, uniform_light(glm::dvec3(1.0)), colour::LightSpectra(), std::span(&kFrame, 1));
    EXPECT_GT(found[0].y, 0.1);
    EXPECT_LT(found[0].y, 0.4);  // b/d
}

/// η₁ = 0.1 for light from −60°, 0.5 from +60°, linear in the angle between and held beyond: under uniform light
/// XYZ = ∫ η₁(asin a) cmf E √(1−a²) dλ. The panels' rule is exact for the half circle: rounding.
TEST(Reference, TakesATableAtTheIncidenceOfEachArc) {
    Grating grating = compact_disc();
    grating.orders = {1};
    grating.profile =
        EfficiencyTable{.orders = {1},
                        .slices = {{.incidence_deg = -60.0, .wavelengths_nm = {500.0}, .efficiencies = {0.1}},
                                   {.incidence_deg = 60.0, .wavelengths_nm = {500.0}, .efficiencies = {0.5}}}};
    const colour::LightSpectra spectra;
    for (const double v_x : {-0.6, 0.1, 0.8}) {
        const ShadingPoint frame{.view = {v_x, 0.0, 0.6}, .normal = {0, 0, 1}, .grating = {1, 0, 0}};
        const double v_g = glm::normalize(frame.view).x;
        glm::dvec3 expected(0.0);
        for (int wavelength_nm = 380; wavelength_nm <= 780; ++wavelength_nm) {
            const double a = wavelength_nm / 1600.0 - v_g;
            if (std::abs(a) >= 1.0) continue;
            const double position = std::clamp((std::asin(a) * 180.0 / std::numbers::pi + 60.0) / 120.0, 0.0, 1.0);
            const double weight = (wavelength_nm == 380 || wavelength_nm == 780 ? 0.5 : 1.0) * (0.1 + 0.4 * position) *
                                  std::sqrt(1.0 - a * a);
            expected += weight * glm::dot(spectra(wavelength_nm), glm::dvec3(1.0)) * colour::cie_xyz(wavelength_nm);
        }
        const auto found = reference_radiance(grating, uniform_light(glm::dvec3(1.0)), spectra, std::span(&frame, 1));
        EXPECT_LT(relative_rms(found, {expected}), 1e-10) << v_x;
    }
}

using test::relative_rms;

const std::vector<ShadingPoint> kFewGrooveFrames = {
    {.view = {0.3, 0.1, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}},
    {.view = {-0.7, 0.4, 0.3}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}}};

Grating compact_disc(double grooves) {
    return {.pitch_nm = 1600.0, .grooves = grooves, .profile = SlitProfile{800.0}, .orders = {-1, 1, 2}};
}

/// The slow reference: ∫∫ f_E L s_n dω dλ with the pointwise BRDF, over s_g and s_h (s_n dω = ds_g ds_h), by a midpoint
/// rule in s_g whose step of 2 nm in x resolves the 19 nm of N = 20, and Gauss–Legendre along the arc.
glm::dvec3 brute_force(const Grating& grating, const lighting::ShLight& light, const colour::LightSpectra& spectra,
                       const glm::dvec3& v) {
    const math::QuadratureRule arc = math::gauss_legendre(24, 0.0, std::numbers::pi);
    std::vector<double> basis(light.coefficients.size());
    glm::dvec3 sum(0.0);
    const int nodes = 1600;
    for (int i = 0; i < nodes; ++i) {
        const double s_g = (i + 0.5) * 2.0 / nodes - 1.0;
        const double r = std::sqrt(1.0 - s_g * s_g);
        for (std::size_t j = 0; j < arc.nodes.size(); ++j) {
            const glm::dvec3 s(s_g, r * std::cos(arc.nodes[j]), r * std::sin(arc.nodes[j]));
            math::evaluate_sh(s, light.bands, basis);
            glm::dvec3 radiance(0.0);
            for (std::size_t k = 0; k < basis.size(); ++k) radiance += basis[k] * light.coefficients[k];
            const double area = 2.0 / nodes * arc.weights[j] * s.z;
            for (int wavelength_nm = 380; wavelength_nm <= 780; wavelength_nm += 2) {
                const double step_nm = wavelength_nm == 380 || wavelength_nm == 780 ? 1.0 : 2.0;
                sum += step_nm * area * brdf_energy(grating, s, v, wavelength_nm) *
                       glm::dot(spectra(wavelength_nm), radiance) * colour::cie_xyz(wavelength_nm);
            }
        }
    }
    return sum;
}

/// Tolerance: 2 nm against 1 nm wavelengths, and steps at the borders of the listed orders' periods, which a single
/// groove's flat spectrum takes at full height and N grooves at 1/N² of it.
TEST(FewGrooves, HaveTheirTrueWidth) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    for (const double grooves : {1.0, 5.0, 20.0}) {
        const Grating grating = compact_disc(grooves);
        const auto found = reference_radiance(grating, light, colour::LightSpectra(), kFewGrooveFrames);
        for (std::size_t i = 0; i < kFewGrooveFrames.size(); ++i) {
            const glm::dvec3 v = glm::normalize(kFewGrooveFrames[i].view);
            const double error = relative_rms({found[i]}, {brute_force(grating, light, colour::LightSpectra(), v)});
            EXPECT_LT(error, grooves == 1.0 ? 3e-3 : 1e-3) << grooves << " grooves, view " << i;
        }
    }
}

/// At fixed light the distance to N → ∞ falls with every doubling, and at 49 the switch at kManyGrooves is a step of a
/// few per cent at most: what sidelobes carry into other light.
TEST(FewGrooves, MeetTheLimitOfManyAsTheirNumberGrows) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const auto many = reference_radiance(compact_disc(1500.0), light, colour::LightSpectra(), kFewGrooveFrames);
    double last = 10.0;
    for (const double grooves : {2.0, 4.0, 8.0, 16.0, 32.0, 49.0}) {
        const auto few = reference_radiance(compact_disc(grooves), light, colour::LightSpectra(), kFewGrooveFrames);
        const double error = relative_rms(few, many);
        EXPECT_LT(error, last) << grooves;
        EXPECT_GT(error, 1e-6) << grooves;
        last = error;
    }
    EXPECT_LT(last, 0.05);
}

TEST(FewGrooves, FiftyAreTreatedAsInfinitelyMany) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    EXPECT_EQ(reference_radiance(compact_disc(50.0), light, colour::LightSpectra(), kFewGrooveFrames),
              reference_radiance(compact_disc(1e6), light, colour::LightSpectra(), kFewGrooveFrames));
}

const Grating kGrating{.pitch_nm = 1600.0, .profile = SlitProfile{800.0}};

const std::vector<ShadingPoint> kFrames = {
    {.view = {0.3, 0.1, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}},
    {.view = {0.1, -0.2, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}},
    {.view = {0.3, 0.1, -0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}}};

/// Uniform light with one texel of another brightness, at x = 0.16 above the frames' surface, where order 1 looks: a
/// lamp a texel wide that arcs hit or miss.
lighting::ProbeImage probe_with_lamp(float lamp) {
    image::Image image{.width = 1024, .height = 512, .texels = std::vector(std::size_t{1024} * 512, glm::vec3(1.0F))};
    image.at(998, 200) = glm::vec3(lamp);
    return {std::move(image), lighting::Mapping::Equirectangular, "lamp"};
}

TEST(CheckedReference, GivesTheReferenceItself) {
    const auto probe = probe_with_lamp(10.0F);
    const auto plain = reference_radiance(kGrating, probe, colour::LightSpectra(), kFrames);
    const auto checked = checked_reference(kGrating, probe, colour::LightSpectra(), kFrames);
    ASSERT_EQ(checked.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(checked[i].xyz, plain[i]);
}

/// Smooth light leaves the trapezoid rule's error in wavelength; black frames have none.
TEST(CheckedReference, ErrorIsSmallUnderSmoothLight) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const auto checked = checked_reference(kGrating, test::read_sh_light(light_path), colour::LightSpectra(), kFrames);
    EXPECT_LT(checked[0].error, 1e-4);
    EXPECT_LT(checked[1].error, 1e-4);
    EXPECT_EQ(checked[2].error, 0.0);
}

/// The lamp spans texels that two nodes each sample: the estimate must see that this is coarse.
TEST(CheckedReference, ErrorGrowsWithTheContrastOfTheLight) {
    const auto soft = checked_reference(kGrating, probe_with_lamp(1.0F), colour::LightSpectra(), kFrames);
    const auto hard = checked_reference(kGrating, probe_with_lamp(1e5F), colour::LightSpectra(), kFrames);
    EXPECT_GT(hard[0].error + hard[1].error, 3.0 * (soft[0].error + soft[1].error));
    EXPECT_GT(hard[0].error + hard[1].error, 1e-4);
}

}  // namespace

}  // namespace rowland::diffraction
