#include "engine/lighting/cube_tree.h"

#include <gtest/gtest.h>

#include "engine/lighting/environment_map.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

constexpr int kSize = 16;

std::vector<glm::vec3> uneven_texels() {
    std::vector<glm::vec3> texels;
    for (int i = 0; i < 6 * kSize * kSize; ++i) texels.emplace_back(i % 7, i % 11 == 0 ? 1000 : 1, 0.5 * (i % 3));
    return texels;
}

TEST(CubeTree, EveryDepthHoldsTheWholeLight) {
    const CubeTree tree(uneven_texels(), kSize);
    ASSERT_EQ(tree.side(tree.leaf_depth()), kSize);
    std::vector<glm::dvec3> flux;
    for (int depth = 0; depth <= tree.leaf_depth(); ++depth) {
        glm::dvec3 sum(0.0);
        double solid_angle = 0;
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < tree.side(depth); ++row)
                for (int column = 0; column < tree.side(depth); ++column) {
                    sum += glm::dvec3(tree.node(depth, face, column, row).flux);
                    solid_angle += tree.node(depth, face, column, row).solid_angle;
                }
        EXPECT_NEAR(solid_angle / (4 * std::numbers::pi), 1, 1e-5);  // single precision, 1536 addends
        flux.push_back(sum);
    }
    for (const glm::dvec3& f : flux) EXPECT_LT(glm::length(f - flux[0]) / glm::length(flux[0]), 1e-5);
}

TEST(CubeTree, ALoneLampIsWhereItStands) {
    std::vector<glm::vec3> texels(std::size_t{6} * kSize * kSize, glm::vec3(0.0f));
    texels[(3 * kSize + 5) * kSize + 9] = glm::vec3(100.0f);  // face 3, column 9, row 5
    const CubeTree tree(texels, kSize);
    const auto expected = glm::normalize(cube_direction(3, (2 * 9 + 1.0) / kSize - 1, (2 * 5 + 1.0) / kSize - 1));
    for (int depth = 0; depth <= tree.leaf_depth(); ++depth) {
        const int shrink = kSize / tree.side(depth);
        const auto& node = tree.node(depth, 3, 9 / shrink, 5 / shrink);
        EXPECT_LT(glm::length(glm::dvec3(node.source) - expected), 1e-6) << depth;
    }
}

TEST(CubeTree, OfCellsKeepsTheDirectionWithinACell) {
    std::vector<CubeCell> cells(std::size_t{6} * kSize * kSize);
    const glm::dvec3 lamp = glm::normalize(cube_direction(3, (2 * 9 + 1.7) / kSize - 1, (2 * 5 + 0.4) / kSize - 1));
    cells[(3 * kSize + 5) * kSize + 9] = {.flux = {2.0, 1.0, 0.5}, .direction = 3.5 * lamp};
    const CubeTree tree(cells, kSize);
    for (int depth = 0; depth <= tree.leaf_depth(); ++depth) {
        const int shrink = kSize / tree.side(depth);
        const auto& node = tree.node(depth, 3, 9 / shrink, 5 / shrink);
        EXPECT_LT(glm::length(glm::dvec3(node.source) - lamp), 1e-6) << depth;
        EXPECT_EQ(node.flux, glm::vec3(2.0F, 1.0F, 0.5F)) << depth;
    }
}

}  // namespace
}  // namespace rowland::lighting
