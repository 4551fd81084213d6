// The ground truth of lattices.

#include <glm/geometric.hpp>

#include "engine/image/image.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/reference/json_oracle.h"

namespace rowland::diffraction {
namespace {

using test::relative_rms;

/// PHYSICS §9: 1e-4 under the band-limited light, 0.5 % under the probe.
TEST(LatticeReference, MatchesTheOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_lattice.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    ROWLAND_TEST_DATA(probe_path, "probes/venice_sunset_256.hdr");
    const lighting::ShLight smooth = test::read_sh_light(light_path);
    const lighting::ProbeImage probe(image::load_image(probe_path), lighting::Mapping::Equirectangular);
    const std::vector<test::JsonCase> cases = test::read_json_cases(path);
    ASSERT_EQ(cases.size(), 6U);
    for (const test::JsonCase& one : cases) {
        ASSERT_TRUE(one.grating.lattice) << one.name;
        const bool band_limited = one.light == "bandlimited_light_n5";
        const IncidentLight light = band_limited ? IncidentLight(smooth) : IncidentLight(probe);
        const double error =
            relative_rms(reference_radiance(one.grating, light, colour::LightSpectra(), one.frames), one.xyz);
        EXPECT_LT(error, band_limited ? 1e-4 : 5e-3) << one.name << " under " << one.light;
    }
}

Grating crossed(const Profile& along_a, const Profile& along_b, int orders) {
    Grating grating;
    grating.orders.clear();
    grating.pitch_nm = 1000.0;
    grating.lattice = Lattice{.a_nm = {1600.0, 0.0},
                              .b_nm = {0.0, 1000.0},
                              .profile = CrossedProfile{.along_a = along_a, .along_b = along_b},
                              .orders = orders};
    return grating;
}

std::vector<ShadingPoint> some_frames() {
    std::vector<ShadingPoint> frames;
    for (int i = 0; i < 12; ++i)
        frames.push_back({.view = glm::normalize(glm::dvec3(std::cos(i), std::sin(2.0 * i), 0.6)),
                          .normal = {0.1, 0.2, 1.0},
                          .grating = {1.0, 0.1 * i, 0.0}});
    return frames;
}

lighting::ShLight smooth_light() {
    lighting::ShLight light{.bands = 3, .coefficients = {}};
    for (int i = 0; i < 9; ++i)
        light.coefficients.emplace_back(i == 0 ? glm::dvec3(8.0, 7.0, 6.0)
                                               : glm::dvec3(0.5 / i, 0.9 - 0.1 * i, 0.1 * i));
    return light;
}

/// Grooves that mirror along themselves are those of a lattice whose other axis does nothing.
TEST(LatticeReference, WithOneTrivialAxisIsTheStraightGrating) {
    Grating straight;
    straight.pitch_nm = 1600.0;
    straight.profile = BlazedProfile{.depth_nm = 250.0};
    straight.orders = {-2, -1, 1, 2};
    straight.lobe = GaussianLobe{.sigma = 2e-5};
    straight.metal = colour::Metal::Au;
    straight.cover = Cover{.ior = 1.5};
    Grating lattice = crossed(straight.profile, SlitProfile{.width_nm = 1000.0}, 2);
    lattice.metal = straight.metal;
    lattice.cover = straight.cover;
    const lighting::ShLight light = smooth_light();
    const std::vector<ShadingPoint> frames = some_frames();
    const double error = relative_rms(reference_radiance(lattice, light, colour::LightSpectra(), frames),
                                      reference_radiance(straight, light, colour::LightSpectra(), frames));
    EXPECT_LT(error, 1e-6);
}

/// Cells from 0.3 µm to 10 mm, as flat as 5°, with 10 200 orders.
TEST(LatticeReference, IsFiniteAtTheExtremes) {
    const lighting::ShLight light = smooth_light();
    const std::vector<ShadingPoint> frames{some_frames()[0], some_frames()[5]};
    const glm::dvec2 flat(std::cos(5.0 * 3.14159265358979 / 180.0), std::sin(5.0 * 3.14159265358979 / 180.0));
    for (const double side_nm : {300.0, 1000.0, 50000.0, 1e7})
        for (const glm::dvec2& direction : {glm::dvec2(0.0, 1.0), flat, -flat}) {
            Grating grating = crossed(SlitProfile{.width_nm = 0.5 * side_nm}, SinusoidalProfile{.depth_nm = 200.0},
                                      side_nm > 1000.0 ? kHighestLatticeOrder : 5);
            grating.lattice->a_nm = {side_nm, 0.0};
            grating.lattice->b_nm = side_nm * direction;
            for (const glm::dvec3& xyz : reference_radiance(grating, light, colour::LightSpectra(), frames)) {
                EXPECT_TRUE(std::isfinite(xyz.x + xyz.y + xyz.z)) << side_nm;
                EXPECT_GE(xyz.y, 0.0) << side_nm;
            }
        }
}

}  // namespace
}  // namespace rowland::diffraction
