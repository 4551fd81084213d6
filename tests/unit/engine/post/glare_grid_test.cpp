#include "engine/post/glare_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace rowland {

namespace {

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

}  // namespace

}  // namespace rowland
