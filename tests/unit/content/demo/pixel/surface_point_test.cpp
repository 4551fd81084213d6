#include <glm/gtc/matrix_transform.hpp>

#include "content/demo/pixel/surface_point.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/gpu/render_test.h"

namespace rowland::demo {

namespace {

// The mesh and its matrix are 32-bit.
constexpr double kRounding = 1e-6;

class SurfacePointTest : public test::RenderTest {
 protected:
    /// A square with grooves, placed by `matrix`.
    ecs::Entity grating(const glm::mat4& matrix, float groove_rotation, float handedness = 1.0F) {
        scene::Mesh mesh = square();
        for (glm::vec4& tangent : mesh.tangents) tangent.w = handedness;
        const ecs::Entity entity = add(std::move(mesh), {}, matrix);
        world_.add(entity, diffraction::DiffractionSurface{.groove_rotation = groove_rotation});
        return entity;
    }
    std::optional<diffraction::ShadingPoint> seen(ecs::Entity entity, const glm::vec3& point, const glm::vec3& eye) {
        return frame_at(placed_grating(world_, entity).value(), hit_, point, eye);
    }
    static void expect_near(const glm::dvec3& value, const glm::dvec3& expected) {
        EXPECT_LT(glm::length(value - expected), kRounding) << value.x << ", " << value.y << ", " << value.z;
    }
    const TriangleHit hit_{.triangle = 1, .weights = {0.25F, 0.25F}, .distance = 1.0F};
};

TEST_F(SurfacePointTest, LooksFromThePointToTheEye) {
    const auto frame = seen(grating(glm::mat4(1.0F), 0.0F), {0.5F, 0.0F, 0.0F}, {0.5F, 3.0F, 4.0F});
    ASSERT_TRUE(frame);
    expect_near(frame->view, {0.0, 0.6, 0.8});
    expect_near(frame->normal, {0.0, 0.0, 1.0});
    expect_near(frame->grating, {1.0, 0.0, 0.0});
}

TEST_F(SurfacePointTest, GroovesTurnFromTheTangentTowardTheBitangent) {
    const float quarter = 1.5707963F;
    const auto right = seen(grating(glm::mat4(1.0F), quarter), {}, {0.0F, 0.0F, 2.0F});
    const auto left = seen(grating(glm::mat4(1.0F), quarter, -1.0F), {}, {0.0F, 0.0F, 2.0F});
    ASSERT_TRUE(right && left);
    expect_near(right->grating, {0.0, 1.0, 0.0});
    expect_near(left->grating, {0.0, -1.0, 0.0});
}

TEST_F(SurfacePointTest, FollowsThePlacementEvenStretchedOrMirrored) {
    const glm::mat4 lying = glm::rotate(glm::mat4(1.0F), -1.5707963F, {1.0F, 0.0F, 0.0F});
    const glm::mat4 stretched = glm::scale(lying, {3.0F, 0.5F, 1.0F});
    const auto frame = seen(grating(stretched, 0.0F), {}, {0.0F, 2.0F, 0.0F});
    ASSERT_TRUE(frame);
    expect_near(frame->normal, {0.0, 1.0, 0.0});
    expect_near(frame->grating, {1.0, 0.0, 0.0});
    const glm::mat4 mirrored = glm::scale(glm::mat4(1.0F), {1.0F, -1.0F, 1.0F});
    const auto turned = seen(grating(mirrored, 0.5F), {}, {0.0F, 0.0F, 2.0F});
    ASSERT_TRUE(turned);
    // The bitangent is mirrored with the rest.
    expect_near(turned->grating, {std::cos(0.5), -std::sin(0.5), 0.0});
}

TEST_F(SurfacePointTest, TheBackIsNotMeasured) {
    EXPECT_FALSE(seen(grating(glm::mat4(1.0F), 0.0F), {}, {0.0F, 0.0F, -2.0F}));
    EXPECT_FALSE(placed_grating(world_, world_.create()));
}

}  // namespace

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
