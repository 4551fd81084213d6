#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/colour/colour_space.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_image.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "engine/scene/camera.h"
#include "engine/scene/light.h"
#include "engine/scene/transform.h"
#include "tests/gpu/gl_test.h"

namespace rowland::test {

/// A renderer whose working space is Rec.709, and a camera on +z that looks at a square of the plane z = 0.
class RenderTest : public GlTest {
 public:
    /// A square in the plane z = 0 that faces +z; u grows with x, v against y, as in a picture.
    static scene::Mesh square(float half = 1.0F) {
        scene::Mesh mesh;
        mesh.positions = {{-half, -half, 0.0F}, {half, -half, 0.0F}, {half, half, 0.0F}, {-half, half, 0.0F}};
        mesh.normals.assign(4, {0.0F, 0.0F, 1.0F});
        // glTF's bitangent, cross(n, t) w, points up in the picture.
        mesh.tangents.assign(4, {1.0F, 0.0F, 0.0F, 1.0F});
        mesh.uvs = {{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        return mesh;
    }

 protected:
    static constexpr int kSize = 33;  ///< odd, so that a pixel looks straight ahead

    RenderTest() { renderer_.set_probe(even_light(0.0F)); }

    /// The same radiance from everywhere.
    static lighting::LightProbe even_light(float radiance) {
        lighting::LightProbe probe;
        probe.sh.bands = 3;
        probe.sh.coefficients.assign(9, glm::dvec3(0.0));
        probe.sh.coefficients[0] =
            glm::dvec3(static_cast<double>(radiance) * 3.5449077018110318);  // 2 √π: Y_00 is 1 / (2 √π)
        probe.ambient = lighting::ambient_coefficients(probe.sh);
        probe.environment.layout = {.face_size = 4, .levels = 1};
        probe.environment.scale = radiance;
        probe.environment.halves.assign(3 * probe.environment.layout.offset(1), 0x3C00);  // 1
        return probe;
    }

    ecs::Entity add(scene::Mesh mesh, const render::StandardMaterial& material,
                    const glm::mat4& matrix = glm::mat4(1.0F)) {
        const ecs::Entity entity = world_.create();
        world_.add(entity, render::make_mesh_instance(std::move(mesh)));
        world_.add(entity, render::StandardMaterial(material));
        world_.add(entity, scene::WorldMatrix{matrix});
        return entity;
    }

    /// Replaces the sun, the one directional light that this makes.
    void set_sun(const glm::vec3& toward, bool casts_shadow = true) {
        if (world_.alive(sun_)) world_.destroy(sun_);
        sun_ = world_.create();
        world_.add(sun_, scene::DirectionalLight{.direction = glm::normalize(toward),
                                                 .irradiance = glm::vec3(3.0F),
                                                 .casts_shadow = casts_shadow});
    }

    /// A texture of so many texels across, without a filter, row 0 at v = 0.
    static render::SurfaceTexture texture(int width, const std::vector<glm::vec4>& texels) {
        auto made = std::make_shared<gpu::Texture>(
            gpu::TextureDesc{
                .format = gpu::Format::RGBA32F, .width = width, .height = static_cast<int>(texels.size()) / width},
            gpu::Sampling{.filter = gpu::Filter::Nearest, .wrap_s = gpu::Wrap::Repeat, .wrap_t = gpu::Wrap::Repeat});
        made->upload(std::span<const glm::vec4>(texels));
        return {.texture = std::move(made), .uv_set = 0, .transform = {}};
    }

    /// Rows from the top down.
    std::vector<glm::vec4> draw(render::Shading shading = render::Shading::Full) {
        renderer_.render(world_, camera_, target_, shading);
        return target_.read_rgba_float();
    }
    /// The pixel that shows (x, y) of the plane z = 0 for the camera as it is at first.
    static glm::vec4 at(const std::vector<glm::vec4>& pixels, float x, float y) {
        const float scale = 0.5F * kSize / kHalfView;
        const auto column = static_cast<int>(0.5F * kSize + x * scale);
        const auto row = static_cast<int>(0.5F * kSize - y * scale);
        return pixels[static_cast<std::size_t>(row * kSize + column)];
    }
    /// Where on z = 0 the pixel's centre that at() returns lies.
    static glm::vec3 position_of(float x, float y) {
        const float scale = 0.5F * kSize / kHalfView;
        const float column = std::floor(0.5F * kSize + x * scale) + 0.5F;
        const float row = std::floor(0.5F * kSize - y * scale) + 0.5F;
        return {(column - 0.5F * kSize) / scale, (0.5F * kSize - row) / scale, 0.0F};
    }

    static constexpr float kHalfView = 1.2F;  ///< of the plane z = 0
    static constexpr float kEye = 3.0F;

    render::Renderer renderer_{glm::inverse(colour::rec709_to_xyz())};
    ecs::World world_;
    ecs::Entity sun_;
    scene::Camera camera_{.eye = {0.0F, 0.0F, kEye}, .vertical_field_of_view = 2.0F * std::atan(kHalfView / kEye)};
    gpu::Framebuffer target_{
        gpu::FramebufferDesc{.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true}};
};

/// What a GGX surface (height-correlated Smith, Schlick) sends to `v` of unit irradiance on a surface that faces `l`.
/// The light's angular radius widens the distribution of half vectors by half of it.
inline glm::dvec3 reflected(const glm::dvec3& l, const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& base,
                            double metallic, double roughness, double angular_radius = 0.0) {
    using std::numbers::pi;
    const glm::dvec3 h = glm::normalize(l + v);
    const double n_l = std::max(glm::dot(n, l), 0.0);
    const double n_v = glm::dot(n, v);
    const double n_h = glm::dot(n, h);
    const double a2 = std::pow(roughness, 4.0);
    const double seen_a2 = a2 + std::pow(0.5 * std::sin(angular_radius), 2.0);
    const double d = seen_a2 / (pi * std::pow(n_h * n_h * (seen_a2 - 1.0) + 1.0, 2.0));
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
    const double g = n_l > 0.0 ? 1.0 / (1.0 + lambda(n_l) + lambda(n_v)) : 0.0;
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), base, metallic);
    const glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1.0 - glm::dot(v, h), 5.0);
    const glm::dvec3 specular = n_l > 0.0 ? fresnel * (d * g / (4.0 * n_l * n_v)) : glm::dvec3(0.0);
    return (base * ((1.0 - metallic) / pi) + specular) * n_l;
}

}  // namespace rowland::test
