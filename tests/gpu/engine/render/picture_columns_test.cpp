#include "engine/render/draw_list.h"

#include <glm/gtc/matrix_transform.hpp>

#include "tests/gpu/render_test.h"

namespace rowland::render {
namespace {

// 32-bit floats, through two matrices.
constexpr float kRounding = 1e-5F;

void expect_near(const glm::vec4& drawn, const glm::vec3& expected, const std::string& where) {
    EXPECT_LT(glm::length(glm::vec3(drawn) - expected), kRounding) << where << ": " << drawn.r << ", " << drawn.b;
}

class PictureColumnsTest : public test::RenderTest {
 protected:
    ecs::Entity add_square(const glm::vec3& colour, PictureColumns columns) {
        const ecs::Entity entity = add(square(), {.base_colour = colour, .unlit = true});
        world_.add(entity, columns);
        return entity;
    }
    static constexpr glm::vec3 kRed{1.0F, 0.0F, 0.0F};
    static constexpr glm::vec3 kBlue{0.0F, 0.0F, 1.0F};
};

TEST_F(PictureColumnsTest, TwoInOnePlaceShareThePictureAtTheLine) {
    add_square(kRed, {0.0F, 0.6F});
    add_square(kBlue, {0.6F, 1.0F});
    const auto pixels = draw();
    const int line = static_cast<int>(std::lround(0.6F * kSize));
    for (int column = 5; column < kSize - 5; ++column) {
        const glm::vec4 pixel = pixels[static_cast<std::size_t>(kSize / 2 * kSize + column)];
        expect_near(pixel, column < line ? kRed : kBlue, "column " + std::to_string(column));
    }
}

TEST_F(PictureColumnsTest, WithoutThemAnEntityShowsEverywhereBesideOneThatHasThem) {
    add_square(kRed, {0.0F, 0.5F});
    add(square(), {.base_colour = kBlue, .unlit = true}, glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, -0.5F}));
    const auto pixels = draw();
    expect_near(at(pixels, -0.5F, 0.0F), kRed, "left");
    expect_near(at(pixels, 0.5F, 0.0F), kBlue, "right");
}

TEST_F(PictureColumnsTest, NoColumnsShowNothingAndAllShowAll) {
    const ecs::Entity entity = add_square(kRed, {0.7F, 0.7F});
    expect_near(at(draw(), 0.5F, 0.0F), glm::vec3(0.0F), "nothing");
    world_.get<PictureColumns>(entity) = {-3.0F, 4.0F};
    const auto pixels = draw();
    expect_near(at(pixels, -0.9F, 0.0F), kRed, "left");
    expect_near(at(pixels, 0.9F, 0.0F), kRed, "right");
}

}  // namespace
}  // namespace rowland::render
