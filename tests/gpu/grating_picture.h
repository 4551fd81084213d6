#pragma once

// Pictures of gratings against the CPU: what the tests of all representations share.

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/colour/working_space.h"
#include "engine/image/image.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/light_texels.h"
#include "engine/lighting/prefilter.h"
#include "engine/lighting/probe_image.h"
#include "engine/math/sh_rotation.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "engine/scene/camera.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "modules/diffraction/bake/lobe_table.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/tangent_light.h"
#include "tests/gpu/cook_grating.h"
#include "tests/gpu/gl_test.h"

namespace rowland::diffraction {

/// A smooth probe: no radiance is below 0, nor does it change within a few texels.
inline lighting::ProbeImage smooth_probe() {
    image::Image picture;
    picture.width = 64;
    picture.height = 32;
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column) {
            const double theta = 3.14159265358979 * (row + 0.5) / picture.height;
            const double phi = 6.28318530717959 * ((column + 0.5) / picture.width - 0.5);
            const glm::dvec3 s(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
            picture.texels.emplace_back(glm::vec3(1.0 + 0.6 * s.y + 0.3 * s.x * s.z, 0.8 + 0.5 * s.x * s.y - 0.2 * s.z,
                                                  0.7 + 0.4 * s.z + 0.3 * s.y * s.y));
        }
    return {std::move(picture), lighting::Mapping::Equirectangular};
}

/// A frame's light: a probe, and key lights that come on top of it.
inline LightParts light_of(const lighting::ProbeImage& probe, std::vector<lighting::KeyLight> keys,
                           std::uint64_t version = 1) {
    constexpr int kBands = 10;
    LightParts light;
    light.residual = lighting::project(probe, kBands);
    light.sh = light.residual;
    const lighting::ShLight lobes = lighting::project(keys, kBands);
    for (std::size_t i = 0; i < light.sh.coefficients.size() && !keys.empty(); ++i)
        light.sh.coefficients[i] += lobes.coefficients[i];
    light.key_lights = std::move(keys);
    light.texels = std::make_shared<const lighting::LightTexels>(lighting::light_texels(probe, {}, 0.1));
    light.radiance = std::make_shared<const lighting::PackedEnvironmentMap>(
        lighting::finest_level(lighting::pack(lighting::prefilter(probe))));
    light.probe_sh = light.residual;
    light.probe_texels = light.texels;
    light.version = version;
    return light;
}

inline std::vector<lighting::KeyLight> three_keys() {
    return {{.direction = glm::normalize(glm::dvec3(0.5, 0.3, 0.8)), .flux = {1.0, 0.8, 0.5}, .concentration = 300.0},
            {.direction = glm::normalize(glm::dvec3(-0.8, 0.5, 0.2)), .flux = {0.2, 0.5, 1.0}, .concentration = 60.0},
            {.direction = glm::normalize(glm::dvec3(0.1, -0.9, 0.15)), .flux = {0.9, 0.2, 0.1}, .concentration = 1e4}};
}

inline constexpr const char* kSlitCd = R"({"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}})";
inline constexpr const char* kBlazed =
    R"({"pitch_nm": 1200, "profile": {"type": "blazed", "depth_nm": 250}, "orders": [-1, 1, 2]})";
inline constexpr const char* kFoil = R"({"pitch_nm": 1000, "profile": {"type": "sinusoidal", "depth_nm": 150},
                                         "groove_lobe": {"sigma": 0.3}})";

/// One triangle whose vertices have different tangent frames, one of a mirrored bitangent.
inline scene::Mesh crooked_triangle() {
    scene::Mesh mesh;
    mesh.positions = {{-1.0F, -0.8F, 0.1F}, {1.1F, -0.9F, -0.2F}, {0.0F, 1.0F, 0.3F}};
    for (const glm::vec3 normal :
         {glm::vec3(-0.2F, 0.1F, 1.0F), glm::vec3(0.3F, 0.0F, 1.0F), glm::vec3(0.0F, 0.3F, 1.0F)})
        mesh.normals.push_back(glm::normalize(normal));
    const glm::vec3 along[] = {{1.0F, 0.2F, 0.0F}, {0.6F, -1.0F, 0.0F}, {0.9F, 0.6F, 0.0F}};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 n = mesh.normals[i];
        mesh.tangents.emplace_back(glm::normalize(along[i] - n * glm::dot(n, along[i])), -1.0F);
    }
    mesh.uvs.resize(3);
    mesh.indices = {0, 1, 2};
    return mesh;
}

/// The same in one plane, with its normal and different grating vectors.
inline scene::Mesh flat_triangle() {
    scene::Mesh mesh = crooked_triangle();
    const glm::vec3 n(0.0F, 0.0F, 1.0F);
    for (std::size_t i = 0; i < 3; ++i) {
        mesh.positions[i].z = 0.0F;
        mesh.normals[i] = n;
        const glm::vec3 g(mesh.tangents[i]);
        mesh.tangents[i] = glm::vec4(glm::normalize(g - n * glm::dot(n, g)), 1.0F);
    }
    return mesh;
}

/// A DiffractionSurfaceType under light that the test sets, whatever the renderer's is.
class UnderLight final : public render::MaterialType {
 public:
    UnderLight(const DiffractionSettings& settings, const LightParts& light)
        : inner_(glm::dmat3(1.0), settings), light_(&light) {}

    std::string name() const override { return "diffraction"; }
    void add_shaders(gpu::ShaderLibrary& library) const override { inner_.add_shaders(library); }
    bool owns(ecs::World& world, ecs::Entity entity) const override { return inner_.owns(world, entity); }
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity) const override {
        return inner_.program(world, entity);
    }
    void update(ecs::World& world, const render::FrameLight& frame) override {
        LightParts light = *light_;
        light.light_strengths = frame.light_strengths;  // of the world's own lights
        inner_.update(world, light);
    }
    void bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const override {
        inner_.bind(world, entity, program);
    }

 private:
    DiffractionSurfaceType inner_;
    const LightParts* light_;
};

/// What the CPU shades: a point of a triangle.
struct Point {
    glm::dvec3 weights{0.0};  ///< barycentric
    glm::dvec3 position{0.0};
    glm::dmat3 to_tangent{1.0};  ///< rows g, h, n: the vertices', interpolated and made orthonormal
    glm::dvec3 view{0.0};        ///< toward the eye, in (g, h, n)
    double footprint = 0.0;      ///< half the pixel's extent in v_g
    glm::dvec2 beside{0.0};      ///< (v_g, v_h) of the next column's pixel less this one's; sign as it comes
    glm::dvec2 below{0.0};       ///< the same of the next row's
};

/// Of the picture's maximum. A real GPU filters textures with 8-bit weights, 2e-3 of a step between texels; tables of
/// halves are 5e-4 exact.
inline constexpr double kPictureTolerance = 2e-3;

/// One triangle with a grating, drawn as XYZ.
class GratingPicture : public rowland::test::GlTest {
 protected:
    static constexpr int kSize = 64;

    GratingPicture() {
        transform_.rotation = glm::angleAxis(0.4F, glm::normalize(glm::vec3(1.0F, 2.0F, 0.5F)));
        camera_.eye = {0.4F, 0.5F, 3.0F};
    }

    /// Makes the scene: after the mesh and the light are set.
    void show(const CookedMaterial& cooked, double groove_rotation = 0.0, int slices_per_frame = 1 << 20) {
        renderer_.emplace(glm::dmat3(1.0));
        const DiffractionSettings settings{.window = math::SphericalWindow::None, .slices_per_frame = slices_per_frame};
        renderer_->add_material_type(std::make_unique<UnderLight>(settings, light_));
        lighting::LightProbe dark;
        dark.sh = {.bands = 3, .coefficients = std::vector<glm::dvec3>(9, glm::dvec3(0.0))};
        dark.environment.layout = {.face_size = 4, .levels = 1};
        dark.environment.halves.assign(3 * dark.environment.layout.offset(1), 0);
        renderer_->set_probe(dark);
        rotation_ = groove_rotation;
        entity_ = world_.create();
        world_.add(entity_, scene::Transform(transform_));
        world_.add(entity_, render::make_mesh_instance(scene::Mesh(mesh_)));
        use(cooked);
    }
    void use(const CookedMaterial& cooked) {
        material_ = make_gpu_material(cooked, glm::dmat3(1.0));
        world_.add(entity_, render::StandardMaterial(material_->base()));
        world_.add(entity_, DiffractionSurface{material_, static_cast<float>(rotation_)});
    }
    /// Rows from the top down.
    std::vector<glm::vec4> draw() {
        world_.get<scene::Transform>(entity_) = transform_;
        scene::update_world_matrices(world_);
        renderer_->render(world_, camera_, target_);
        return target_.read_rgba_float();
    }

    /// Tangent frame of a vertex, rows g, h, n.
    glm::dmat3 vertex_frame(std::size_t vertex) const {
        return tangent_frame(mesh_.normals[vertex], mesh_.tangents[vertex], transform_.matrix(), rotation_);
    }
    lighting::ShLight vertex_light(std::size_t vertex, const lighting::ShLight& light, int bands) const {
        const lighting::ShLight limited = lighting::limit_bands(light, bands);
        lighting::ShLight rotated = limited;
        math::ShRotation(vertex_frame(vertex), bands)
            .apply(std::span<const glm::dvec3>(limited.coefficients), rotated.coefficients);
        return rotated;
    }
    glm::dvec3 vertex_view(std::size_t vertex) const {
        const glm::dvec3 position(transform_.matrix() * glm::vec4(mesh_.positions[vertex], 1.0F));
        return vertex_frame(vertex) * glm::normalize(glm::dvec3(camera_.eye) - position);
    }
    /// Interpolates what a vertex shader makes.
    static glm::dvec3 mix(const Point& point, const std::vector<glm::dvec3>& vertices) {
        return point.weights.x * vertices[0] + point.weights.y * vertices[1] + point.weights.z * vertices[2];
    }

    /// Draws a material whose map is looked up at the vertices, which `map_xyz` does on the CPU, and its key lights at
    /// the vertices or at the pixels.
    void expect_map_at_vertices(const CookedMaterial& cooked, const std::function<glm::dvec3(const Point&)>& map_xyz) {
        const auto lights_xyz = [&](const Point& point) { return key_light_xyz(cooked, light_.key_lights, point); };
        std::vector<glm::dvec3> maps;
        std::vector<glm::dvec3> lights;
        for (std::size_t vertex = 0; vertex < 3; ++vertex) {
            Point point;
            point.to_tangent = vertex_frame(vertex);
            point.view = vertex_view(vertex);
            maps.push_back(map_xyz(point));
            lights.push_back(lights_xyz(point));
        }
        const bool at_vertices = cooked.material.quality.lights_at_vertices;
        const auto expected = [&](const Point& point) {
            return mix(point, maps) + (at_vertices ? mix(point, lights) : lights_xyz(point));
        };
        EXPECT_LT(largest_difference(draw(), expected), kPictureTolerance) << at_vertices;
        EXPECT_GT(largest_difference(draw(), map_xyz), 0.1);
    }

    /// The triangle's plane at a pixel's centre.
    Point point_at(int column, int row) const {
        Point point = place_at(column, row);
        // Shaders take differences within two by two pixels.
        point.beside = glm::dvec2(place_at(column ^ 1, row).view) - glm::dvec2(point.view);
        point.below = glm::dvec2(place_at(column, row ^ 1).view) - glm::dvec2(point.view);
        point.footprint = 0.5 * (std::abs(point.beside.x) + std::abs(point.below.x));
        return point;
    }

    /// Largest difference between the picture and `expected`, over the picture's largest component.
    double largest_difference(const std::vector<glm::vec4>& pixels,
                              const std::function<glm::dvec3(const Point& point)>& expected) {
        double difference = 0.0;
        brightest_ = 0.0;
        compared_ = 0;
        for (int row = 0; row < kSize; ++row)
            for (int column = 0; column < kSize; ++column) {
                const Point point = point_at(column, row);
                if (std::min({point.weights.x, point.weights.y, point.weights.z}) < 0.02) continue;
                const glm::dvec3 wanted = expected(point);
                const glm::dvec3 drawn = glm::vec3(pixels[static_cast<std::size_t>(row * kSize + column)]);
                for (int o = 0; o < 3; ++o) {
                    // A NaN is no agreement.
                    difference = std::isfinite(drawn[o]) ? std::max(difference, std::abs(drawn[o] - wanted[o])) : 1e30;
                    brightest_ = std::max(brightest_, std::abs(wanted[o]));
                }
                ++compared_;
            }
        RecordProperty("largest_difference", std::to_string(difference / brightest_));
        return difference / brightest_;
    }

    /// XYZ of key lights at a point, with the kernel smoothed as on the GPU.
    static glm::dvec3 key_light_xyz(const CookedMaterial& cooked, const std::vector<lighting::KeyLight>& keys,
                                    const Point& point) {
        const DirectMaterial material = direct_material(cooked);
        const BlurredKernel& kernel = smoothed(cooked);
        glm::dvec3 xyz(0.0);
        if (point.view.z <= 0.0) return xyz;
        const DirectView view{point.view.x, point.view.y, point.footprint};
        const bool tabled = cooked.zero_order_xyz == glm::dmat3(0.0);
        for (const lighting::KeyLight& key : keys)
            xyz += tabled ? lobe_radiance(lobe_table(cooked, key), material, key, point.to_tangent, view)
                          : direct_radiance(kernel, material, light_spot(key, point.to_tangent), view);
        return xyz;
    }
    static const LobeTable& lobe_table(const CookedMaterial& cooked, const lighting::KeyLight& key) {
        static std::map<std::tuple<double, double, double, double, double>, LobeTable> tables;
        const double pitch = cooked.material.grating.pitch_nm;
        const std::tuple name(pitch, key.concentration, key.flux.x, key.flux.y, key.flux.z);
        const auto found = tables.find(name);
        if (found != tables.end()) return found->second;
        return tables.emplace(name, make_lobe_table(smoothed(cooked), pitch, key, 4096)).first->second;
    }
    static DirectMaterial direct_material(const CookedMaterial& cooked) {
        return {.pitch_nm = cooked.material.grating.pitch_nm,
                .zero_order_xyz = cooked.zero_order_xyz,
                .lobe = cooked.material.grating.lobe};
    }
    static const BlurredKernel& smoothed(const CookedMaterial& cooked) {
        static std::map<double, BlurredKernel> kernels;  // by the pitch: every grating here has its own
        const double pitch = cooked.material.grating.pitch_nm;
        const auto found = kernels.find(pitch);
        if (found != kernels.end()) return found->second;
        return kernels.emplace(pitch, blur(cooked.kernel, 0.2 * pitch, 4096)).first->second;
    }

    std::optional<render::Renderer> renderer_;
    ecs::World world_;
    ecs::Entity entity_;
    LightParts light_ = light_of(smooth_probe(), {});
    scene::Mesh mesh_ = crooked_triangle();
    scene::Transform transform_;
    scene::Camera camera_;
    double rotation_ = 0.0;
    std::shared_ptr<const GpuMaterial> material_;
    gpu::Framebuffer target_{
        gpu::FramebufferDesc{.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true}};
    double brightest_ = 0.0;
    int compared_ = 0;

 private:
    Point place_at(int column, int row) const {
        const glm::mat4 matrix = transform_.matrix();
        const glm::dvec2 ndc(2.0 * (column + 0.5) / kSize - 1.0, 1.0 - 2.0 * (row + 0.5) / kSize);
        const glm::dmat4 to_world = glm::inverse(glm::dmat4(camera_.projection(1.0F)) * glm::dmat4(camera_.view()));
        const glm::dvec4 far = to_world * glm::dvec4(ndc, 1.0, 1.0);
        const glm::dvec3 eye(camera_.eye);
        const glm::dvec3 direction = glm::dvec3(far) / far.w - eye;
        glm::dvec3 p[3];
        for (std::size_t i = 0; i < 3; ++i) p[i] = glm::dvec3(matrix * glm::vec4(mesh_.positions[i], 1.0F));
        // eye + t direction = w0 p0 + w1 p1 + w2 p2, w0 + w1 + w2 = 1
        const glm::dvec3 solution = glm::inverse(glm::dmat3(p[1] - p[0], p[2] - p[0], -direction)) * (eye - p[0]);
        Point point;
        point.weights = {1.0 - solution.x - solution.y, solution.x, solution.y};
        point.position = eye + solution.z * direction;
        glm::dvec3 g(0.0);
        glm::dvec3 n(0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dmat3 axes = glm::transpose(vertex_frame(i));
            g += point.weights[static_cast<int>(i)] * axes[0];
            n += point.weights[static_cast<int>(i)] * axes[2];
        }
        n = glm::normalize(n);
        g = glm::normalize(g - n * glm::dot(n, g));
        point.to_tangent = glm::transpose(glm::dmat3(g, glm::cross(n, g), n));
        point.view = point.to_tangent * glm::normalize(eye - point.position);
        return point;
    }
};

}  // namespace rowland::diffraction
