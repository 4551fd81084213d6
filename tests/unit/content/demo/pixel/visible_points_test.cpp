#include "content/demo/pixel/visible_points.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/mesh_recipe.h"

namespace rowland::demo {
namespace {

constexpr glm::ivec2 kSize{32, 20};

/// Spheres, one in front of the other, and a tilted disc that reaches out of the picture.
std::vector<PlacedMesh> meshes() {
    const auto sphere = std::make_shared<const scene::Mesh>(
        scene::build_mesh(scene::SphereRecipe{.radius = 0.3, .rings = 12, .segments = 24}));
    const auto disc = std::make_shared<const scene::Mesh>(
        scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.2, .outer_radius = 1.5}));
    const glm::mat4 one(1.0F);
    return {{sphere, glm::translate(one, {0.1F, 0.0F, 0.0F})},
            {sphere, glm::scale(glm::translate(one, {-0.1F, 0.1F, -0.8F}), {2.0F, 1.0F, 1.0F})},
            {disc, glm::rotate(glm::translate(one, {0.0F, -0.3F, 0.0F}), 0.3F, {1.0F, 0.0F, 1.0F})}};
}

/// The nearest of all meshes, asked one by one.
std::optional<VisiblePoint> asked(const Ray& ray, const std::vector<PlacedMesh>& placed) {
    std::optional<VisiblePoint> nearest;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const glm::mat4 to_mesh = glm::inverse(placed[i].to_world);
        const auto hit = nearest_hit(
            {glm::vec3(to_mesh * glm::vec4(ray.origin, 1.0F)), glm::mat3(to_mesh) * ray.direction}, *placed[i].mesh);
        if (!hit || (nearest && hit->distance >= nearest->hit.distance)) continue;
        nearest = VisiblePoint{i, *hit, ray.origin + hit->distance * ray.direction};
    }
    return nearest;
}

TEST(VisiblePoints, AreWhatARayThroughEachTexelMeetsFirst) {
    const scene::Camera camera{.eye = {0.3F, 0.5F, 2.0F}, .vertical_field_of_view = 0.8F};
    const std::vector<PlacedMesh> placed = meshes();
    const auto points = visible_points(camera, kSize, placed);
    std::vector<int> seen(placed.size(), 0);
    for (int row = 0; row < kSize.y; ++row)
        for (int column = 0; column < kSize.x; ++column) {
            const auto& point = points[static_cast<std::size_t>(row * kSize.x + column)];
            const auto expected = asked(ray_through(camera, {column + 0.5, row + 0.5}, kSize), placed);
            ASSERT_EQ(point.has_value(), expected.has_value()) << column << ", " << row;
            if (!point) continue;
            EXPECT_EQ(point->mesh, expected->mesh);
            // Metres; 32-bit numbers, once in the mesh's space and once in the world's.
            EXPECT_LT(glm::length(point->point - expected->point), 1e-4F);
            ++seen[point->mesh];
        }
    for (const int count : seen) EXPECT_GT(count, 5);
}

}  // namespace
}  // namespace rowland::demo
