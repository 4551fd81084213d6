#include "engine/scene/ray.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "engine/scene/mesh_recipe.h"

namespace rowland::scene {
namespace {

TEST(Ray, MeetsTheBoxOfEveryMeshThatItHits) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number(-2.0F, 2.0F);
    const Mesh sphere = build_mesh(SphereRecipe{.radius = 1.0, .rings = 8, .segments = 12});
    const Mesh flat = build_mesh(PlaneRecipe{.width = 2.0, .depth = 1.0, .subdivisions = 1});
    int hits = 0;
    int misses = 0;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray{glm::vec3(number(random), number(random), number(random)),
                      glm::vec3(number(random), number(random), number(random))};
        for (const Mesh* mesh : {&sphere, &flat}) {
            if (nearest_hit(ray, *mesh)) {
                ++hits;
                EXPECT_TRUE(meets(ray, bounds(*mesh)));
            } else {
                misses += meets(ray, bounds(*mesh)) ? 0 : 1;
            }
        }
    }
    EXPECT_GT(hits, 200);
    EXPECT_GT(misses, 1000);
}

}  // namespace
}  // namespace rowland::scene
