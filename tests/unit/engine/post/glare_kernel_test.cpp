#include "engine/post/glare_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rowland {

namespace {

using post::GlarePattern;

const post::GlareGrid grid_of_kernel{.cells = {40, 30}, .period = {128, 64}, .cell = 0.01F};
const glm::mat2 no_turn(1.0F);

TEST(GlareKernel, KeepsThePlaceAndTheSumOfAPoint) {
    const glm::mat3 weight(0.1F, 0.2F, 0.3F, -0.4F, 0.5F, 0.6F, 0.7F, 0.8F, 0.9F);
    for (const glm::vec2 offset : {glm::vec2(0.0F), {0.123F, -0.077F}, {-0.2049F, 0.15F}}) {
        glm::mat3 sum(0.0F);
        glm::vec2 moment(0.0F);
        const std::vector<glm::mat3> kernel = glare_kernel({.points = {{offset, weight}}}, no_turn, grid_of_kernel);
        for (std::size_t i = 0; i < kernel.size(); ++i) {
            glm::ivec2 at(static_cast<int>(i) % 128, static_cast<int>(i) / 128);
            if (at.x >= 64) at.x -= 128;
            if (at.y >= 32) at.y -= 64;
            sum += kernel[i];
            moment += kernel[i][1].y / 0.5F * grid_of_kernel.cell * glm::vec2(at);
        }
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) EXPECT_NEAR(sum[c][o], weight[c][o], 1e-6F);
        EXPECT_NEAR(moment.x, offset.x, 1e-6F);
        EXPECT_NEAR(moment.y, offset.y, 1e-6F);
    }
}

TEST(GlareKernel, LeavesOutWhatCanReachNoPixel) {
    for (const glm::vec2 offset : {glm::vec2(0.42F, 0.0F), {-0.42F, 0.1F}, {0.0F, 0.32F}, {1e6F, -1e6F}})
        for (const glm::mat3& weight : glare_kernel({.points = {{offset, glm::mat3(1.0F)}}}, no_turn, grid_of_kernel))
            ASSERT_EQ(weight, glm::mat3(0.0F)) << offset.x;
}

TEST(GlareKernel, TurnsThePattern) {
    const glm::mat2 quarter(0.0F, 1.0F, -1.0F, 0.0F);
    const GlarePattern pattern{.points = {{{0.1F, 0.02F}, glm::mat3(1.0F)}}};
    EXPECT_EQ(reach_of(pattern, quarter), glm::vec2(0.02F, 0.1F));
    EXPECT_EQ(glare_kernel(pattern, quarter, grid_of_kernel),
              glare_kernel({.points = {{{-0.02F, 0.1F}, glm::mat3(1.0F)}}}, no_turn, grid_of_kernel));
}

}  // namespace

}  // namespace rowland
