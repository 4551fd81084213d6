#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "engine/scene/mesh_recipe.h"
#include "tests/gpu/render_test.h"

namespace rowland::test {

/// A white floor y = 0 with boxes and spheres on it, which the CPU can send rays into.
class TracedSceneTest : public RenderTest {
 protected:
    struct Hit {
        double distance = std::numeric_limits<double>::infinity();
        glm::dvec3 point{0.0};
        glm::dvec3 normal{0.0};
    };

    static constexpr int kWidth = 160;
    static constexpr int kHeight = 120;
    static constexpr float kFloor = 0.6F;  ///< half its side

    TracedSceneTest() {
        camera_ = {.eye = {0.25F, 0.3F, 0.6F}, .target = {0.0F, 0.03F, 0.0F}, .vertical_field_of_view = 0.5F};
        floor_ = add(scene::build_mesh(scene::PlaneRecipe{.width = 2.0 * kFloor, .depth = 2.0 * kFloor}), kWhite);
    }

    /// Standing on the floor.
    ecs::Entity add_box(const glm::vec3& foot, const glm::vec3& size) {
        const glm::dvec3 half(0.5F * size);
        boxes_.push_back({glm::dvec3(foot) - glm::dvec3(half.x, 0.0, half.z),
                          glm::dvec3(foot) + glm::dvec3(half.x, 2.0 * half.y, half.z)});
        return add(box_mesh(size), kWhite, glm::translate(glm::mat4(1.0F), foot));
    }
    ecs::Entity add_sphere(const glm::vec3& centre, float radius) { return add_sphere(centre, radius, kWhite); }
    ecs::Entity add_sphere(const glm::vec3& centre, float radius, const render::StandardMaterial& material) {
        spheres_.push_back({glm::dvec3(centre), radius});
        scene::Mesh mesh = scene::build_mesh(scene::SphereRecipe{.radius = radius, .rings = 96, .segments = 192});
        return add(std::move(mesh), material, glm::translate(glm::mat4(1.0F), centre));
    }

    /// Standing on the plane y = 0, around the Y axis.
    static scene::Mesh box_mesh(const glm::vec3& size) {
        scene::Mesh mesh;
        for (int face = 0; face < 6; ++face) {
            glm::vec3 normal(0.0F);
            normal[face / 2] = face % 2 == 0 ? 1.0F : -1.0F;
            glm::vec3 tangent(0.0F);
            tangent[(face / 2 + 1) % 3] = 1.0F;
            const glm::vec3 across = glm::cross(normal, tangent);
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::vec2& uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
                const glm::vec3 corner = normal + (2.0F * uv.x - 1.0F) * tangent + (2.0F * uv.y - 1.0F) * across;
                mesh.positions.push_back(0.5F * size * (corner + glm::vec3(0.0F, 1.0F, 0.0F)));
                mesh.normals.push_back(normal);
                mesh.tangents.emplace_back(tangent, -1.0F);
                mesh.uvs.push_back(uv);
            }
            for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + corner);
        }
        return mesh;
    }

    /// The nearest intersection beyond 1e-6 m.
    std::optional<Hit> trace(const glm::dvec3& origin, const glm::dvec3& direction) const {
        Hit hit;
        const auto meet = [&](double distance, const glm::dvec3& normal) {
            if (distance < 1e-6 || distance >= hit.distance) return;
            hit = {distance, origin + distance * direction, normal};
        };
        if (direction.y < 0.0) meet(-origin.y / direction.y, {0.0, 1.0, 0.0});
        for (const auto& [low, high] : boxes_) {
            const glm::dvec3 a = (low - origin) / direction;
            const glm::dvec3 b = (high - origin) / direction;
            const glm::dvec3 enter = glm::min(a, b);
            const glm::dvec3 leave = glm::max(a, b);
            const double first = std::max({enter.x, enter.y, enter.z});
            if (first > std::min({leave.x, leave.y, leave.z})) continue;
            const int axis = first == enter.x ? 0 : (first == enter.y ? 1 : 2);
            glm::dvec3 normal(0.0);
            normal[axis] = direction[axis] < 0.0 ? 1.0 : -1.0;
            meet(first, normal);
        }
        for (const auto& [centre, radius] : spheres_) {
            const glm::dvec3 from = origin - centre;
            const double along = glm::dot(from, direction);
            const double under = along * along - glm::dot(from, from) + radius * radius;
            if (under < 0.0) continue;
            const double distance = -along - std::sqrt(under);
            meet(distance, (from + distance * direction) / radius);
        }
        if (std::isinf(hit.distance)) return std::nullopt;
        return hit;
    }

    /// What the centre of a pixel shows; rows from the top.
    std::optional<Hit> seen(int column, int row) const {
        const glm::dvec3 forward = glm::normalize(glm::dvec3(camera_.target) - glm::dvec3(camera_.eye));
        const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera_.up)));
        const double scale = 2.0 * std::tan(0.5 * camera_.vertical_field_of_view) / kHeight;
        const glm::dvec3 direction = forward + scale * ((column + 0.5 - 0.5 * kWidth) * right +
                                                        (0.5 * kHeight - row - 0.5) * glm::cross(right, forward));
        return trace(glm::dvec3(camera_.eye), glm::normalize(direction));
    }

    /// Calls f(pixel, direction, hit) for the pixels that show a mirror sphere, but for its outline, where a pixel sees
    /// other rays: the direction and the first hit of the mirrored ray.
    template <typename Function>
    void for_each_mirrored(const glm::vec3& centre, float radius, const Function& f) const {
        for (int row = 0; row < kHeight; ++row)
            for (int column = 0; column < kWidth; ++column) {
                const auto hit = seen(column, row);
                if (!hit || glm::length(hit->point - glm::dvec3(centre)) > 1.001 * static_cast<double>(radius))
                    continue;
                const glm::dvec3 incident = glm::normalize(hit->point - glm::dvec3(camera_.eye));
                if (glm::dot(incident, hit->normal) > -0.2) continue;
                const glm::dvec3 mirrored = glm::reflect(incident, hit->normal);
                f(index(column, row), mirrored, trace(hit->point + 1e-5 * hit->normal, mirrored));
            }
    }

    /// Green of all pixels, rows from the top.
    std::vector<float> greens() {
        renderer_.render(world_, camera_, picture_);
        std::vector<float> result;
        for (const glm::vec4& pixel : picture_.read_rgba_float()) result.push_back(pixel.g);
        return result;
    }
    static std::size_t index(int column, int row) { return static_cast<std::size_t>(row * kWidth + column); }

    /// Two unit vectors across a unit vector.
    static std::pair<glm::dvec3, glm::dvec3> axes_across(const glm::dvec3& n) {
        const glm::dvec3 a = std::abs(n.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
        const glm::dvec3 x = glm::normalize(glm::cross(a, n));
        return {x, glm::cross(n, x)};
    }

    const render::StandardMaterial kWhite{.base_colour = glm::vec3(1.0F), .roughness = 1.0F};
    std::vector<std::pair<glm::dvec3, glm::dvec3>> boxes_;  ///< lowest and highest corner
    std::vector<std::pair<glm::dvec3, double>> spheres_;
    ecs::Entity floor_;
    gpu::Framebuffer picture_{
        gpu::FramebufferDesc{.width = kWidth, .height = kHeight, .colours = {gpu::Format::RGBA32F}, .depth = true}};
};

}  // namespace rowland::test
