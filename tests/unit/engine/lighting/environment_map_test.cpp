#include "engine/lighting/environment_map.h"

#include <gtest/gtest.h>

#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

TEST(CubeMap, FacesFollowTheOpenGlTable) {
    // OpenGL 4.5 core, table 8.19: the major axis, and the axes that s and t grow along.
    const glm::dvec3 major[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const glm::dvec3 along_s[] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
    const glm::dvec3 along_t[] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    for (int face = 0; face < 6; ++face) {
        EXPECT_EQ(cube_direction(face, 0, 0), major[face]);
        EXPECT_EQ(cube_direction(face, 1, 0) - cube_direction(face, 0, 0), along_s[face]);
        EXPECT_EQ(cube_direction(face, 0, 1) - cube_direction(face, 0, 0), along_t[face]);
    }
}

TEST(CubeMap, PointIsTheInverseOfDirection) {
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 d = test::spread_direction(i, 500);
        const CubePoint p = cube_point(d);
        EXPECT_LE(std::max(std::abs(p.s), std::abs(p.t)), 1);
        EXPECT_LT(glm::length(glm::normalize(cube_direction(p.face, p.s, p.t)) - d), 1e-14);
    }
}

TEST(CubeMap, SolidAnglesSumToTheSphere) {
    for (const int size : {1, 2, 16, 64}) {
        double sum = 0;
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size; ++column) sum += 6 * cube_solid_angle(size, column, row);
        EXPECT_NEAR(sum / (4 * std::numbers::pi), 1, 1e-12);
    }
}

TEST(CubeMap, TexelsOfAllLevelsFollowOneAnother) {
    const CubeLayout layout{16, 3};
    std::size_t expected = 0;
    for (int level = 0; level < 3; ++level)
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < layout.size(level); ++row)
                for (int column = 0; column < layout.size(level); ++column)
                    EXPECT_EQ(layout.index(level, face, column, row), expected++);
    EXPECT_EQ(layout.offset(3), expected);
}

TEST(CubeMap, PackedHalvesSpanWhatProbesHold) {
    EnvironmentMap map{{1, 1}, std::vector<glm::vec3>(6)};
    for (const float top : {3e-9f, 1.0f, 65505.0f, 2e6f, 1e30f}) {
        map.texels[0] = {top, top / 3, top * 1e-6f};
        map.texels[1] = glm::vec3(0.0f);
        const PackedEnvironmentMap packed = pack(map);
        const EnvironmentMap read = unpack(packed);
        EXPECT_EQ(read.layout, map.layout);
        for (int c = 0; c < 3; ++c)
            // Eleven bits; at a millionth of the largest value ten orders of magnitude above underflow remain: 16384e-6
            // is still a normal half (> 6.1e-5).
            EXPECT_NEAR(read.texels[0][c] / map.texels[0][c], 1, 1.0 / 2048) << top;
        EXPECT_EQ(read.texels[1], glm::vec3(0.0f));
    }
}

TEST(CubeMap, DarknessPacks) {
    const EnvironmentMap map{{1, 1}, std::vector<glm::vec3>(6, glm::vec3(0.0f))};
    EXPECT_EQ(unpack(pack(map)).texels, map.texels);
}

}  // namespace
}  // namespace rowland::lighting
