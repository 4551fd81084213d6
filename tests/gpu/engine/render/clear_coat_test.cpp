// KHR_materials_clearcoat on the engine's own surface, against the formula on the CPU.
#include <gtest/gtest.h>

#include "engine/scene/light.h"
#include "tests/gpu/render_test.h"

namespace rowland::render {
namespace {

class ClearCoat : public test::RenderTest {
 protected:
    /// The middle pixel of a square, whose view is along its normal.
    glm::dvec3 middle(float coat, float roughness) {
        const ecs::Entity entity = add(
            square(), {.base_colour = kBase, .roughness = 0.6F, .clear_coat = coat, .clear_coat_roughness = roughness});
        const glm::dvec3 pixel(at(draw(), 0.0F, 0.0F));
        world_.destroy(entity);
        return pixel;
    }
    static constexpr glm::vec3 kBase{0.5F, 0.3F, 0.1F};
};

/// 4 % of a white surrounding, and all but 4 % of what is under it. The split sum's table: 5e-3 of a lobe.
TEST_F(ClearCoat, MirrorsTheSurroundingsAndDimsTheBase) {
    renderer_.set_probe(even_light(1.0F));
    const glm::dvec3 bare = middle(0.0F, 0.0F);
    for (const float coat : {0.5F, 1.0F}) {
        const glm::dvec3 coated = middle(coat, 0.0F);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(coated[c], double{coat} * 0.04 + (1.0 - double{coat} * 0.04) * bare[c], 1e-3) << coat;
    }
}

/// The coat's highlight is that of a black dielectric of its roughness; the base's stays, dimmed by 4 %.
TEST_F(ClearCoat, LightsHaveHighlightsInIt) {
    const glm::dvec3 l = glm::normalize(glm::dvec3(0.1, 0.0, 1.0));
    world_.add(world_.create(), scene::DirectionalLight{.direction = glm::vec3(l), .irradiance = glm::vec3(1.0F)});
    const glm::dvec3 v(0.0, 0.0, 1.0);
    const glm::dvec3 base = test::reflected(l, v, v, glm::dvec3(kBase), 0.0, 0.6);
    const glm::dvec3 highlight = test::reflected(l, v, v, glm::dvec3(0.0), 0.0, 0.4);
    EXPECT_GT(highlight.x, 0.1);
    const glm::dvec3 coated = middle(1.0F, 0.4F);
    // The table's error times 4 %.
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(coated[c], highlight[c] + 0.96 * base[c], 2e-3 * base[c] + 1e-4 * highlight[c]);
    const glm::dvec3 bare = middle(0.0F, 0.4F);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(bare[c], base[c], 1e-4 * base[c]);
}

}  // namespace
}  // namespace rowland::render
