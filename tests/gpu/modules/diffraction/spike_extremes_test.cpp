// The paper's shader where numbers break: grazing views, views from below, light from nothing to 10⁶.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "engine/core/json_reader.h"
#include "engine/math/spherical_harmonics.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/diffraction/runtime/vertex_light.h"
#include "tests/gpu/gl_test.h"

namespace rowland::diffraction {
namespace {

constexpr int kSize = 32;
const glm::vec3 kEye(0.0F, 0.0F, 4.0F);

lighting::LightProbe spike_light(double mean, double variation) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-variation, variation);
    lighting::LightProbe probe;
    probe.sh.bands = 5;
    for (int i = 0; i < 25; ++i) probe.sh.coefficients.emplace_back(uniform(random), uniform(random), uniform(random));
    probe.sh.coefficients[0] = glm::dvec3(mean);
    probe.environment.layout = {.face_size = 4, .levels = 1};
    probe.environment.halves.assign(3 * probe.environment.layout.offset(1), 0);
    return probe;
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
    for (int i = 0; i < 3; ++i) {
        mesh.normals.emplace_back(glm::normalize(to_world[2]));
        mesh.tangents.emplace_back(glm::vec3(glm::normalize(to_world[0])), 1.0F);
    }
    mesh.uvs.resize(3);
    mesh.indices = {0, 1, 2};
    return mesh;
}

CookedMaterial cook_spikes(const std::string& text) {
    return cook_material(parse_json(text, "test"), "test");
}

class SpikeExtremes : public rowland::test::GlTest {
 protected:
    /// XYZ at the picture's centre, on the axis of the triangle.
    glm::dvec3 draw(const CookedMaterial& cooked, const lighting::LightProbe& probe, const scene::Mesh& mesh) const {
        render::Renderer renderer(glm::dmat3(1.0));
        register_module(renderer, {.window = math::SphericalWindow::None});
        renderer.set_probe(probe);
        ecs::World world;
        const ecs::Entity entity = world.create();
        world.add(entity, scene::Transform{});
        world.add(entity, render::make_mesh_instance(mesh));
        const auto material = make_gpu_material(cooked, glm::dmat3(1.0));
        world.add(entity, material->base());
        world.add(entity, DiffractionSurface{material});
        scene::update_world_matrices(world);
        scene::Camera camera;
        camera.eye = kEye;
        camera.vertical_field_of_view = 2e-4F;
        const gpu::Framebuffer target(
            {.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true});
        renderer.render(world, camera, target);
        const std::vector<glm::vec4> pixels = target.read_rgba_float();
        for (const glm::vec4& pixel : pixels)
            EXPECT_TRUE(std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z));
        return glm::vec3(pixels[static_cast<std::size_t>(kSize / 2 * kSize + kSize / 2)]);
    }

    /// The same by the CPU, from the same table.
    static glm::dvec3 expected(const CookedMaterial& cooked, const lighting::LightProbe& probe,
                               const scene::Mesh& mesh) {
        const glm::dmat3 frame = tangent_frame(mesh.normals[0], glm::vec3(mesh.tangents[0]), glm::mat4(1.0F));
        const glm::dvec3 view = frame * glm::dvec3(0.0, 0.0, 1.0);
        lighting::ShLight rotated{.bands = 5, .coefficients = probe.sh.coefficients};
        math::ShRotation(frame, 5).apply(std::span<const glm::dvec3>(probe.sh.coefficients), rotated.coefficients);
        return evaluate_spikes(sample(std::get<SpikeTable>(cooked.tables), view.x, view.y, std::max(view.z, 1e-30)),
                               rotated);
    }

    /// Over the largest component, or 1e-30: of light 0 nothing may come.
    static double difference(const glm::dvec3& drawn, const glm::dvec3& wanted, double light) {
        const glm::dvec3 d = glm::abs(drawn - wanted);
        return std::max({d.x, d.y, d.z}) / light;
    }
};

const char* const kSlit = R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 500}}})";
const char* const kExtremeFoil = R"({"grating": {"pitch_nm": 1000, "profile": {"type": "sinusoidal", "depth_nm": 150},
    "groove_lobe": {"sigma": 0.05}}, "quality": {"representation": "spikes", "storage": "fp16"}})";
/// Order 1 shows only near grazing.
const char* const kFine = R"({"grating": {"pitch_nm": 320, "profile": {"type": "slit", "width_nm": 160},
    "orders": [-1, 1]}})";

/// Of the light's mean. The vertices are 1e-3 from the axis at 4 away: the view is 2.5e-4 off, over which a table of 32
/// rows changes by 1 % of its range; a real GPU filters textures with 8-bit weights (2e-3), llvmpipe with 1e-5.
constexpr double kTolerance = 3e-3;

TEST_F(SpikeExtremes, GrazingViewsEqualTheCpu) {
    double largest = 0.0;
    double brightest = 0.0;
    for (const char* material : {kSlit, kExtremeFoil, kFine}) {
        const CookedMaterial cooked = cook_spikes(material);
        const lighting::LightProbe probe = spike_light(3.0, 0.3);
        for (const double v_n : {1.0, 0.5, 0.05, 1e-3, 1e-5, 1e-7})
            for (const double phi : {0.0, 0.8, 3.14159265358979}) {
                const scene::Mesh mesh = tilted_triangle(v_n, phi);
                const glm::dvec3 wanted = expected(cooked, probe, mesh);
                const glm::dvec3 drawn = draw(cooked, probe, mesh);
                const double error = difference(drawn, wanted, 3.0);
                EXPECT_LT(error, kTolerance) << material << " v_n " << v_n << " phi " << phi;
                largest = std::max(largest, error);
                brightest = std::max(brightest, wanted.y);
            }
    }
    RecordProperty("largest_difference", std::to_string(largest));
    EXPECT_GT(brightest, 0.1);  // something was seen
}

/// Behind the horizon the shader stays at its rim; draw() holds every pixel to be finite.
TEST_F(SpikeExtremes, ViewsFromBelowAreFinite) {
    const CookedMaterial cooked = cook_spikes(kSlit);
    const lighting::LightProbe probe = spike_light(3.0, 0.3);
    for (const double v_n : {0.0, -1e-7, -0.3, -1.0}) draw(cooked, probe, tilted_triangle(v_n, 0.4));
}

/// Light scales what is drawn, from 10⁻⁶ to 10⁶, with no more error than at 1.
TEST_F(SpikeExtremes, LightOfAnyStrengthEqualsTheCpu) {
    const CookedMaterial cooked = cook_spikes(kSlit);
    for (const double strength : {1e-6, 1.0, 1e6}) {
        const lighting::LightProbe probe = spike_light(3.0 * strength, 0.3 * strength);
        const scene::Mesh mesh = tilted_triangle(0.6, 0.3);
        const glm::dvec3 wanted = expected(cooked, probe, mesh);
        EXPECT_GT(wanted.y, 0.05 * strength);
        EXPECT_LT(difference(draw(cooked, probe, mesh), wanted, 3.0 * strength), kTolerance) << strength;
    }
}

TEST_F(SpikeExtremes, NoLightIsBlack) {
    const CookedMaterial cooked = cook_spikes(kSlit);
    for (const double v_n : {1.0, 0.3, 1e-6})
        EXPECT_EQ(draw(cooked, spike_light(0.0, 0.0), tilted_triangle(v_n, 0.3)), glm::dvec3(0.0)) << v_n;
}

TEST_F(SpikeExtremes, GratingTooFineToDiffractIsBlack) {
    const CookedMaterial cooked =
        cook_spikes(R"({"grating": {"pitch_nm": 180, "profile": {"type": "slit", "width_nm": 90}}})");
    for (const double v_n : {1.0, 0.3, 1e-6})
        EXPECT_EQ(draw(cooked, spike_light(1e6, 1e5), tilted_triangle(v_n, 0.0)), glm::dvec3(0.0)) << v_n;
}

}  // namespace
}  // namespace rowland::diffraction
