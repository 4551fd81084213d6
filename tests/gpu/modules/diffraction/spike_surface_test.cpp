// The paper's shader against the CPU evaluation of the same table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <optional>
#include <random>

#include "engine/gpu/context.h"
#include "engine/math/spherical_harmonics.h"
#include "engine/platform/gl_context.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "engine/scene/light.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/diffraction/runtime/vertex_light.h"
#include "tests/gpu/modules/diffraction/cook_grating.h"
#include "tests/support/eight_bit_filtering.h"

namespace rowland::diffraction {
namespace {

constexpr int kSize = 96;

/// Light of `bands` random bands around a positive mean, and nothing for the engine's own shading to reflect.
lighting::LightProbe random_light(int bands, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-0.3, 0.3);
    lighting::LightProbe probe;
    probe.sh.bands = bands;
    for (int i = 0; i < bands * bands; ++i)
        probe.sh.coefficients.emplace_back(uniform(random), uniform(random), uniform(random));
    probe.sh.coefficients[0] = glm::dvec3(3.0, 2.5, 2.0);
    probe.environment.layout = {.face_size = 4, .levels = 1};
    probe.environment.halves.assign(3 * probe.environment.layout.offset(1), 0);
    return probe;
}

/// One triangle whose vertices have different tangent frames.
scene::Mesh crooked_triangle() {
    scene::Mesh mesh;
    mesh.positions = {{-1.0F, -0.8F, 0.1F}, {1.1F, -0.9F, -0.2F}, {0.0F, 1.0F, 0.3F}};
    for (const glm::vec3 normal :
         {glm::vec3(-0.2F, 0.1F, 1.0F), glm::vec3(0.3F, 0.0F, 1.0F), glm::vec3(0.0F, 0.3F, 1.0F)})
        mesh.normals.push_back(glm::normalize(normal));
    const glm::vec3 along[] = {{1.0F, 0.2F, 0.0F}, {0.3F, -1.0F, 0.0F}, {-0.7F, 0.6F, 0.0F}};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 n = mesh.normals[i];
        mesh.tangents.emplace_back(glm::normalize(along[i] - n * glm::dot(n, along[i])), 1.0F);
    }
    mesh.uvs.resize(3);
    mesh.indices = {0, 1, 2};
    return mesh;
}

/// XYZ of one vertex by the CPU, from the table that is on the GPU.
glm::dvec3 vertex_xyz(const CookedMaterial& cooked, const lighting::ShLight& light, const scene::Mesh& mesh,
                      const glm::mat4& matrix, std::size_t vertex, const glm::vec3& eye) {
    const glm::dmat3 frame = tangent_frame(mesh.normals[vertex], glm::vec3(mesh.tangents[vertex]), matrix);
    const glm::dvec3 position = glm::dvec3(matrix * glm::vec4(mesh.positions[vertex], 1.0F));
    const glm::dvec3 view = frame * glm::normalize(glm::dvec3(eye) - position);
    lighting::ShLight rotated{.bands = light.bands, .coefficients = light.coefficients};
    math::ShRotation(frame, light.bands).apply(std::span<const glm::dvec3>(light.coefficients), rotated.coefficients);
    return evaluate_spikes(sample(std::get<SpikeTable>(cooked.tables), view.x, view.y, view.z), rotated);
}

/// Barycentric coordinates at which the ray through a pixel's centre meets the triangle, if it does so well inside.
std::optional<glm::dvec3> hit(const scene::Mesh& mesh, const glm::mat4& matrix, const scene::Camera& camera, int column,
                              int row) {
    const glm::dvec2 ndc(2.0 * (column + 0.5) / kSize - 1.0, 1.0 - 2.0 * (row + 0.5) / kSize);
    const glm::dmat4 to_world = glm::inverse(glm::dmat4(camera.projection(1.0F)) * glm::dmat4(camera.view()));
    const glm::dvec4 far = to_world * glm::dvec4(ndc, 1.0, 1.0);
    const glm::dvec3 direction = glm::dvec3(far) / far.w - glm::dvec3(camera.eye);
    glm::dvec3 p[3];
    for (std::size_t i = 0; i < 3; ++i) p[i] = glm::dvec3(matrix * glm::vec4(mesh.positions[i], 1.0F));
    // eye + t direction = w0 p0 + w1 p1 + w2 p2, w0 + w1 + w2 = 1
    const glm::dvec3 solution =
        glm::inverse(glm::dmat3(p[1] - p[0], p[2] - p[0], -direction)) * (glm::dvec3(camera.eye) - p[0]);
    const glm::dvec3 weights(1.0 - solution.x - solution.y, solution.x, solution.y);
    if (std::min({weights.x, weights.y, weights.z}) < 0.02) return std::nullopt;
    return weights;
}

struct LitFrame {
    CookedMaterial cooked;
    lighting::LightProbe probe;
    scene::Mesh mesh = crooked_triangle();
    scene::Transform transform;
    scene::Camera camera;
    std::optional<scene::DirectionalLight> lamp = std::nullopt;

    /// Draws XYZ into the framebuffer and gives the largest difference between a pixel and the CPU, over the largest
    /// component of that pixel. `compared` counts the pixels.
    double largest_difference(int& compared) const {
        const platform::HeadlessContext context({.debug = true});
        gpu::enable_debug_output(true);
        rowland::test::filter_as_asked();
        render::Renderer renderer(glm::dmat3(1.0));
        register_module(renderer, {.window = math::SphericalWindow::None});
        renderer.set_probe(probe);
        ecs::World world;
        const ecs::Entity entity = world.create();
        world.add(entity, transform);
        world.add(entity, render::make_mesh_instance(mesh));
        const auto material = make_gpu_material(cooked, glm::dmat3(1.0));
        world.add(entity, material->base());
        world.add(entity, DiffractionSurface{material});
        if (lamp) world.add(world.create(), scene::DirectionalLight(*lamp));
        scene::update_world_matrices(world);

        const gpu::Framebuffer target(
            {.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true});
        renderer.render(world, camera, target);
        return compare(target.read_rgba_float(), compared);
    }

    double compare(const std::vector<glm::vec4>& pixels, int& compared) const {
        const glm::mat4 matrix = transform.matrix();
        glm::dvec3 vertices[3];
        for (std::size_t i = 0; i < 3; ++i) vertices[i] = vertex_xyz(cooked, probe.sh, mesh, matrix, i, camera.eye);
        double largest = 0.0;
        compared = 0;
        for (int row = 0; row < kSize; ++row)
            for (int column = 0; column < kSize; ++column) {
                const auto weights = hit(mesh, matrix, camera, column, row);
                if (!weights) continue;
                const glm::dvec3 expected =
                    weights->x * vertices[0] + weights->y * vertices[1] + weights->z * vertices[2];
                const glm::dvec3 drawn = glm::vec3(pixels[static_cast<std::size_t>(row * kSize + column)]);
                const glm::dvec3 difference = glm::abs(drawn - expected);
                const glm::dvec3 size = glm::abs(expected);
                largest = std::max(
                    largest, std::max({difference.x, difference.y, difference.z}) / std::max({size.x, size.y, size.z}));
                ++compared;
            }
        return largest;
    }
};

LitFrame make_frame(const std::string& grating, const std::string& quality, int bands, unsigned seed) {
    LitFrame frame;
    frame.cooked = cook(grating, quality);
    frame.probe = random_light(bands, seed);
    frame.transform.rotation = glm::angleAxis(0.4F, glm::normalize(glm::vec3(1.0F, 2.0F, 0.5F)));
    frame.transform.scale = glm::vec3(1.0F, 1.2F, 0.8F);
    frame.camera.eye = {0.4F, 0.5F, 3.0F};
    return frame;
}

constexpr const char* kSlit = R"({"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}})";

// 2e-3: a real GPU filters textures with 8-bit weights; llvmpipe stays below 1e-5.
constexpr double kTolerance = 2e-3;

TEST(SpikeSurface, PixelsEqualTheCpuEvaluationOfTheSameTable) {
    int compared = 0;
    const LitFrame frame = make_frame(kSlit, R"({"representation": "spikes"})", 5, 1);
    const double difference = frame.largest_difference(compared);
    RecordProperty("largest_difference", std::to_string(difference));
    EXPECT_LT(difference, kTolerance);
    EXPECT_GT(compared, 1000);
}

TEST(SpikeSurface, PixelsEqualTheCpuForOtherBandsSpikesAndHalfStorage) {
    int compared = 0;
    const char* quality = R"({"representation": "spikes", "bands": 3, "spikes": 7, "view_resolution": 20,
                              "storage": "fp16"})";
    EXPECT_LT(make_frame(kSlit, quality, 3, 2).largest_difference(compared), kTolerance);
    EXPECT_GT(compared, 1000);
}

TEST(SpikeSurface, PixelsEqualTheCpuForALobeWhoseTableIsTwoDimensional) {
    int compared = 0;
    const char* grating = R"({"pitch_nm": 1000, "profile": {"type": "sinusoidal", "depth_nm": 150},
                              "groove_lobe": {"sigma": 0.3}})";
    EXPECT_LT(make_frame(grating, R"({"representation": "spikes"})", 5, 3).largest_difference(compared), kTolerance);
    EXPECT_GT(compared, 1000);
}

TEST(SpikeSurface, ADirectionalLightJoinsTheProbesLight) {
    // Without the lamp on the CPU's side the two must differ: the comparison sees the light.
    LitFrame frame = make_frame(kSlit, R"({"representation": "spikes"})", 5, 1);
    frame.lamp = scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.5F, 0.4F, 1.0F)),
                                         .irradiance = glm::vec3(2.0F)};
    int compared = 0;
    EXPECT_GT(frame.largest_difference(compared), 0.05);
}

}  // namespace
}  // namespace rowland::diffraction
