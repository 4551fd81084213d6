#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/post/glare.h"

namespace rowland {

namespace {

using post::GlarePattern;

TEST(GlareGrid, HasRoomForWhatLeavesThePicture) {
    for (const glm::ivec2 size : {glm::ivec2(1920, 1080), {1280, 720}, {720, 1280}, {7680, 4320}, {33, 50}, {1, 1}}) {
        for (const float tan_half : {0.01F, 0.18F, 1.0F, 5.0F}) {
            for (const float reach : {0.0F, 0.003F, 0.1F, 2.0F}) {
                const glm::vec2 tangents(tan_half * static_cast<float>(size.x) / static_cast<float>(size.y), tan_half);
                const post::GlareGrid grid = post::glare_grid(size, tangents, glm::vec2(reach, 0.5F * reach));
                for (int axis = 0; axis < 2; ++axis) {
                    EXPECT_TRUE(std::has_single_bit(static_cast<unsigned>(grid.period[axis])));
                    EXPECT_LE(grid.period[axis], post::kLargestGlarePeriod[axis]);
                    const float offset = axis == 0 ? reach : 0.5F * reach;
                    const int cells_of_reach =
                        std::min(static_cast<int>(std::ceil(offset / grid.cell)) + 1, grid.cells[axis] - 1);
                    EXPECT_GE(grid.period[axis], grid.cells[axis] + cells_of_reach) << size.x << " " << reach;
                    const float widest = tangents[axis] / std::sqrt(1.0F + tangents[axis] * tangents[axis]);
                    EXPECT_LE(2.0F * widest, static_cast<float>(grid.cells[axis] - 1) * grid.cell);
                }
            }
        }
    }
}

TEST(GlareGrid, HasCellsOfTwoToThreePixels) {
    const glm::vec2 tangents(0.5F * 16.0F / 9.0F, 0.5F);
    for (const glm::ivec2 size : {glm::ivec2(320, 180), {1280, 720}, {1920, 1080}}) {
        for (const float reach : {0.001F, 0.02F, 0.2F, 2.0F}) {
            const float pixels = post::glare_grid(size, tangents, glm::vec2(reach)).cell * static_cast<float>(size.y);
            EXPECT_GE(pixels, 2.0F * 0.999F) << size.x << " " << reach;
            EXPECT_LE(pixels, 3.2F) << size.x << " " << reach;
        }
    }
}

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
