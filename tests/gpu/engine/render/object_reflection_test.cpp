// What mirrors show of the objects around them, against rays.
#include "engine/render/object_reflection.h"

#include <algorithm>

#include "engine/render/local_reflection.h"
#include "tests/gpu/engine/render/traced_scene.h"

namespace rowland::render {
namespace {

/// A mirror sphere between a box and two spheres, each of one radiance.
class ObjectReflectionTest : public test::TracedSceneTest {
 protected:
    ObjectReflectionTest() {
        renderer_.set_probe(even_light(kSky));
        world_.view<MeshInstance>().each([&](ecs::Entity entity, const MeshInstance&) { floor_ = entity; });
        camera_ = {.eye = {0.1F, 0.2F, 0.6F}, .target = kMiddle, .vertical_field_of_view = 0.17F};
        add_sphere(kMiddle, kRadius, {.base_colour = glm::vec3(1.0F), .metallic = 1.0F, .roughness = 0.0F});
        mirror_ = last();
        world_.add(mirror_, ReflectsObjects{mirror_});
        add_box({0.14F, 0.0F, 0.06F}, {0.06F, 0.1F, 0.05F});
        colour(kBox);
        add_sphere({-0.1F, 0.03F, 0.08F}, 0.03F);
        colour(kNear);
        add_sphere({0.0F, 0.06F, 0.3F}, 0.06F);
        colour(kFar);
        renderer_.set_effects({.object_reflections = true});
    }
    ecs::Entity last() {
        ecs::Entity newest;
        world_.view<MeshInstance>().each([&](ecs::Entity entity, const MeshInstance&) {
            if (newest.index == ecs::Entity::kNoIndex || entity.index > newest.index) newest = entity;
        });
        return newest;
    }
    void colour(double radiance) {
        auto& material = world_.get<StandardMaterial>(last());
        material.base_colour = glm::vec3(static_cast<float>(radiance));
        material.unlit = true;
    }
    /// Of the object that a ray has met, by where it did.
    static double radiance(const std::optional<Hit>& met) {
        if (!met || met->point.y < 1e-6) return static_cast<double>(kSky);
        if (met->point.z > 0.2) return kFar;
        return met->point.x > 0.1 ? kBox : kNear;
    }
    /// What the mirror shows at each pixel: an object's radiance, the sky's, or 0 at its outline and beside it.
    std::vector<double> expected() const {
        std::vector<double> result(static_cast<std::size_t>(kWidth * kHeight), 0.0);
        const glm::dvec3 middle(kMiddle);
        for (int row = 0; row < kHeight; ++row)
            for (int column = 0; column < kWidth; ++column) {
                const auto hit = seen(column, row);
                if (!hit || glm::length(hit->point - middle) > 1.001 * static_cast<double>(kRadius)) continue;
                const glm::dvec3 incident = glm::normalize(hit->point - glm::dvec3(camera_.eye));
                if (glm::dot(incident, hit->normal) > -0.2) continue;
                const auto met = trace(hit->point + 1e-5 * hit->normal, glm::reflect(incident, hit->normal));
                result[index(column, row)] = radiance(met);
            }
        return result;
    }
    /// Whether all pixels at most so many away are expected to show the same.
    static bool even(const std::vector<double>& expected, int column, int row, int reach) {
        for (int y = row - reach; y <= row + reach; ++y)
            for (int x = column - reach; x <= column + reach; ++x)
                if (expected[index(x, y)] != expected[index(column, row)]) return false;
        return true;
    }

    static constexpr float kSky = 1.0F;
    static constexpr int kReach = 2;
    static constexpr double kBox = 0.2;
    static constexpr double kNear = 0.4;
    static constexpr double kFar = 0.6;
    static constexpr float kRadius = 0.05F;
    static constexpr glm::vec3 kMiddle{0.0F, 0.06F, 0.0F};
    ecs::Entity floor_;
    ecs::Entity mirror_;
};

TEST_F(ObjectReflectionTest, AMirrorShowsObjectsWhereItsRaysMeetThem) {
    world_.destroy(floor_);
    const std::vector<float> shown = greens();
    const std::vector<double> expected = this->expected();
    for (const double object : {kBox, kNear, kFar, static_cast<double>(kSky)}) {
        int inside = 0;
        int wrong = 0;
        for (int row = kReach; row < kHeight - kReach; ++row)
            for (int column = kReach; column < kWidth - kReach; ++column) {
                // Outlines are blurred by a texel of the surroundings.
                if (expected[index(column, row)] != object || !even(expected, column, row, kReach)) continue;
                ++inside;
                wrong += std::abs(static_cast<double>(shown[index(column, row)]) - object) > 0.02 ? 1 : 0;
            }
        EXPECT_GT(inside, 30) << object;
        EXPECT_LE(wrong, inside / 50) << object;
    }
}

TEST_F(ObjectReflectionTest, TheSurroundingsAreDrawnAgainOnlyAfterAChange) {
    const std::vector<float> first = greens();
    EXPECT_GT(renderer_.report().reflections_drawn, 0);
    EXPECT_EQ(greens(), first);
    EXPECT_EQ(renderer_.report().reflections_drawn, 0);
    camera_.eye.x += 0.1F;
    greens();
    EXPECT_EQ(renderer_.report().reflections_drawn, 0);
    camera_.eye.x -= 0.1F;
    // A face in a frame.
    const auto move = [&](float along_x) {
        world_.get<scene::WorldMatrix>(last()).matrix[3].x += along_x;
        for (int face = 1; face < ObjectReflection::kFaces; ++face) greens();
        return greens();
    };
    EXPECT_NE(move(0.05F), first);
    EXPECT_EQ(move(-0.05F), first);
    EXPECT_EQ(greens(), first);
    EXPECT_EQ(renderer_.report().reflections_drawn, 0);
    renderer_.set_probe(even_light(0.5F * kSky));
    greens();
    EXPECT_GT(renderer_.report().reflections_drawn, 0);
}

TEST_F(ObjectReflectionTest, WhatLiesBelowThePlaneThatMirrorsShowIsLeftOut) {
    renderer_.set_effects({.local_reflections = true, .object_reflections = true});
    greens();
    const int with_floor = renderer_.report().reflections_drawn;
    world_.add(floor_, top_of(*world_.get<MeshInstance>(floor_).mesh));
    world_.get<StandardMaterial>(floor_).base_colour = glm::vec3(0.5F);
    greens();
    EXPECT_LT(renderer_.report().reflections_drawn, with_floor);
}

TEST_F(ObjectReflectionTest, OffOrUnmarkedNothingChanges) {
    const std::vector<float> shown = greens();
    const int programs = renderer_.report().programs;
    world_.remove<ReflectsObjects>(mirror_);
    const std::vector<float> unmarked = greens();
    EXPECT_NE(unmarked, shown);
    EXPECT_EQ(renderer_.report().reflections_drawn, 0);
    world_.add(mirror_, ReflectsObjects{mirror_});
    renderer_.set_effects({});
    EXPECT_EQ(greens(), unmarked);
    EXPECT_EQ(renderer_.report().programs, programs);  // the mirror's without the effect is the floor's
}

}  // namespace
}  // namespace rowland::render
