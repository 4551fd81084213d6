// The paper's shader against the CPU's evaluation of the same table, also where numbers break: grazing views, views
// from below, light from nothing to 10⁶.

#include <glm/geometric.hpp>
#include <random>

#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

constexpr const char* kSpikes = R"({"representation": "spikes"})";

class Spikes : public GratingPicture {};

TEST_F(Spikes, PixelsEqualTheCpuForEveryMappingStorageAndNumberOfSpikes) {
    const struct {
        const char* grating;
        const char* settings;
    } rows[] = {{kSlitCd, ""},
                {kSlitCd, R"(, "view_mapping": "parabolic")"},
                {kSlitCd, R"(, "view_mapping": "one-dimensional", "storage": "fp32")"},
                {kSlitCd, R"(, "view_mapping": "one-dimensional", "storage": "unorm8")"},
                {kSlitCd, R"(, "bands": 3, "spikes": 7, "view_resolution": 20, "storage": "fp16")"},
                {kFoil, R"(, "view_resolution": 16)"}};
    for (const auto& row : rows) {
        const CookedMaterial cooked =
            cook(row.grating, std::string(R"({"representation": "spikes")") + row.settings + "}");
        SCOPED_TRACE(std::string(row.grating) + row.settings);
        show(cooked, -0.6);
        expect_drawn(table_xyz<SpikeTable>(cooked, light_.sh));
        EXPECT_GT(compared_, 500);
    }
}

TEST_F(Spikes, KeyLightsAreShadedApartWhereTheMaterialAsksForThem) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kSlitCd, R"({"representation": "spikes", "key_lights": 64})");
    show(cooked, 0.5);
    const auto residual = table_xyz<SpikeTable>(cooked, light_.residual);
    expect_drawn(sum(residual, key_lights(cooked)));
    EXPECT_GT(largest_difference(draw(), residual), 0.1);
}

/// Light whose mean in each colour is Y₀ times `mean`, and that varies over 5 bands.
GratingLight varied_light(double mean, double variation) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-variation, variation);
    lighting::LightProbe probe;
    probe.sh.bands = 5;
    for (int i = 0; i < 25; ++i) probe.sh.coefficients.emplace_back(uniform(random), uniform(random), uniform(random));
    probe.sh.coefficients[0] = glm::dvec3(mean);
    GratingLight light{.sh = probe.sh, .residual = probe.sh, .version = 1};
    light.probe = std::make_shared<const lighting::LightProbe>(std::move(probe));
    return light;
}

/// A triangle that fills the picture and has one tangent frame, whose normal the eye sees under the cosine `v_n`, at
/// the azimuth `phi` from g. The view turns by little over it, as its vertices are within 1e-3 of each other.
scene::Mesh tilted_triangle(double v_n, double phi) {
    const double r = std::sqrt(1.0 - v_n * v_n);
    // In the frame (g, h, n) the view is (r cos φ, r sin φ, v_n); that direction must be +Z of the world.
    const glm::dvec3 view(r * std::cos(phi), r * std::sin(phi), v_n);
    const glm::dvec3 across =
        glm::normalize(glm::cross(std::abs(view.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), view));
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(across, glm::cross(view, across), view));
    scene::Mesh mesh;
    mesh.positions = {{-1e-3F, -1e-3F, 0.0F}, {1e-3F, -1e-3F, 0.0F}, {0.0F, 1e-3F, 0.0F}};
    mesh.normals.assign(3, glm::vec3(glm::normalize(to_world[2])));
    mesh.tangents.assign(3, glm::vec4(glm::vec3(glm::normalize(to_world[0])), 1.0F));
    mesh.uvs.resize(3);
    mesh.indices = {0, 1, 2};
    return mesh;
}

class SpikeExtremes : public GratingPicture {
 protected:
    SpikeExtremes() {
        light_ = varied_light(3.0, 0.3);
        transform_ = {};
        camera_.eye = {0.0F, 0.0F, 4.0F};
        camera_.vertical_field_of_view = 2e-4F;
    }

    /// XYZ at the picture's centre, on the axis of tilted_triangle().
    glm::dvec3 drawn(const CookedMaterial& cooked, double v_n, double phi) {
        mesh_ = tilted_triangle(v_n, phi);
        show(cooked);
        world_.add(entity_, render::make_mesh_instance(scene::Mesh(mesh_)));
        const std::vector<glm::vec4> pixels = draw();
        for (const glm::vec4& pixel : pixels)
            EXPECT_TRUE(std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z));
        return glm::vec3(pixels[static_cast<std::size_t>(kSize / 2 * kSize + kSize / 2)]);
    }

    /// The same by the CPU, from the same table.
    glm::dvec3 by_cpu(const CookedMaterial& cooked) const {
        const glm::dvec3 view = vertex_frame(0) * glm::dvec3(0.0, 0.0, 1.0);
        return evaluate_spikes(sample(std::get<SpikeTable>(cooked.tables), view.x, view.y, std::max(view.z, 1e-30)),
                               vertex_light(0, light_.sh, 5));
    }
};

constexpr const char* kNarrowSlit = R"({"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 500}})";
constexpr const char* kNarrowFoil = R"({"pitch_nm": 1000, "profile": {"type": "sinusoidal", "depth_nm": 150},
                                        "groove_lobe": {"sigma": 0.05}})";
/// Order 1 shows only near grazing.
constexpr const char* kFine = R"({"pitch_nm": 320, "profile": {"type": "slit", "width_nm": 160}, "orders": [-1, 1]})";

/// Of the light's mean. The vertices are 1e-3 from the axis at 4 away: the view is 2.5e-4 off, over which a table of 32
/// rows changes by 1 % of its range; a real GPU filters textures with 8-bit weights (2e-3), llvmpipe with 1e-5.
constexpr double kTolerance = 3e-3;

double largest_component_of(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TEST_F(SpikeExtremes, GrazingViewsEqualTheCpu) {
    double largest = 0.0;
    double brightest = 0.0;
    for (const char* grating : {kNarrowSlit, kNarrowFoil, kFine}) {
        const CookedMaterial cooked = cook(grating, R"({"representation": "spikes", "storage": "fp16"})");
        for (const double v_n : {1.0, 0.5, 0.05, 1e-3, 1e-5, 1e-7})
            for (const double phi : {0.0, 0.8, std::numbers::pi}) {
                const glm::dvec3 found = drawn(cooked, v_n, phi);
                const glm::dvec3 expected = by_cpu(cooked);
                const double error = largest_component_of(found - expected) / 3.0;
                EXPECT_LT(error, kTolerance) << grating << " v_n " << v_n << " phi " << phi;
                largest = std::max(largest, error);
                brightest = std::max(brightest, expected.y);
            }
    }
    RecordProperty("largest_difference", std::to_string(largest));
    EXPECT_GT(brightest, 0.1);
}

/// Behind the horizon the shader stays at its rim; drawn() holds every pixel to be finite.
TEST_F(SpikeExtremes, ViewsFromBelowAreFinite) {
    const CookedMaterial cooked = cook(kNarrowSlit, kSpikes);
    for (const double v_n : {0.0, -1e-7, -0.3, -1.0}) drawn(cooked, v_n, 0.4);
}

/// Light scales what is drawn, from 10⁻⁶ to 10⁶, with no more error than at 1.
TEST_F(SpikeExtremes, LightOfAnyStrengthEqualsTheCpu) {
    const CookedMaterial cooked = cook(kNarrowSlit, kSpikes);
    std::uint64_t version = 1;
    for (const double strength : {1e-6, 1.0, 1e6}) {
        light_ = varied_light(3.0 * strength, 0.3 * strength);
        light_.version = ++version;
        const glm::dvec3 found = drawn(cooked, 0.6, 0.3);
        EXPECT_GT(by_cpu(cooked).y, 0.05 * strength);
        EXPECT_LT(largest_component_of(found - by_cpu(cooked)) / (3.0 * strength), kTolerance) << strength;
    }
}

TEST_F(SpikeExtremes, NoLightAndATooFineGratingAreBlack) {
    const CookedMaterial too_fine = cook(R"({"pitch_nm": 180, "profile": {"type": "slit", "width_nm": 90}})", kSpikes);
    light_ = varied_light(1e6, 1e5);
    for (const double v_n : {1.0, 0.3, 1e-6}) EXPECT_EQ(drawn(too_fine, v_n, 0.0), glm::dvec3(0.0)) << v_n;
    light_ = varied_light(0.0, 0.0);
    light_.version = 2;
    const CookedMaterial slit = cook(kNarrowSlit, kSpikes);
    for (const double v_n : {1.0, 0.3, 1e-6}) EXPECT_EQ(drawn(slit, v_n, 0.3), glm::dvec3(0.0)) << v_n;
}

}  // namespace
}  // namespace rowland::diffraction
