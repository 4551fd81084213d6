
#include <algorithm>

#include "engine/lighting/environment_map.h"
#include "tests/support/files.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

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

glm::dvec3 texel_direction(const CubeLayout& layout, int level, int face, int column, int row) {
    const double size = layout.size(level);
    return glm::normalize(cube_direction(face, (2 * column + 1) / size - 1, (2 * row + 1) / size - 1));
}

glm::dvec3 level_mean(const EnvironmentMap& map, int level) {
    glm::dvec3 sum(0.0);
    const int size = map.layout.size(level);
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size; ++column)
                sum += cube_solid_angle(size, column, row) *
                       glm::dvec3(map.texels[map.layout.index(level, face, column, row)]);
    return sum / (4 * pi);
}

glm::dvec3 probe_mean(const ProbeImage& probe) {
    glm::dvec3 sum(0.0);
    for (int row = 0; row < probe.image().height; ++row)
        for (int column = 0; column < probe.image().width; ++column)
            sum += probe.solid_angle(column, row) * glm::dvec3(probe.image().at(column, row));
    return sum / (4 * pi);
}

/// The slow reference: GGX-weighted mean over every texel of level 0, with view = normal.
glm::dvec3 brute_force(const EnvironmentMap& map, const glm::dvec3& normal, double alpha) {
    glm::dvec3 sum(0.0);
    double total = 0;
    const int size = map.layout.face_size;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size; ++column) {
                const double cosine = glm::dot(normal, texel_direction(map.layout, 0, face, column, row));
                if (cosine <= 0) continue;
                const double cos_half_squared = (1 + cosine) / 2;
                const double root = cos_half_squared * (alpha * alpha - 1) + 1;
                const double weight = cosine * alpha * alpha / (pi * root * root) * cube_solid_angle(size, column, row);
                sum += weight * glm::dvec3(map.texels[map.layout.index(0, face, column, row)]);
                total += weight;
            }
    return sum / total;
}

TEST(Prefilter, ConstantLightStaysConstant) {
    for (const Mapping mapping : test::kMappings) {
        const EnvironmentMap map = prefilter(test::constant_probe(mapping, 128));
        for (const glm::vec3& texel : map.texels)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(texel[c], 1, 1e-5);
    }
}

TEST(Prefilter, FaceSizeFollowsTheProbe) {
    const auto size = [](Mapping mapping, int height, int wanted) {
        return environment_layout(test::constant_probe(mapping, height), {wanted}).face_size;
    };
    EXPECT_EQ(size(Mapping::Equirectangular, 512, 256), 256);
    EXPECT_EQ(size(Mapping::Equirectangular, 512, 64), 64);
    EXPECT_EQ(size(Mapping::Equirectangular, 200, 256), 64);
    EXPECT_EQ(size(Mapping::Angular, 640, 256), 128);
    EXPECT_EQ(size(Mapping::Equirectangular, 2, 256), 16);
    EXPECT_EQ(environment_layout(test::constant_probe(Mapping::Equirectangular, 2), {}).levels, 3);
}

TEST(Prefilter, LevelZeroLooksWhereTheProbeLooks) {
    for (const Mapping mapping : test::kMappings) {
        const ProbeImage probe =
            test::made_probe(mapping, 256, [](const glm::dvec3& d) { return glm::dvec3(1 + d.x, 1 + d.y, 1 + d.z); });
        const EnvironmentMap map = prefilter(probe, {64});
        for (int face = 0; face < 6; ++face)
            for (const auto& [column, row] : {std::pair{3, 50}, {31, 31}, {60, 7}}) {
                const glm::dvec3 seen(map.texels[map.layout.index(0, face, column, row)]);
                EXPECT_LT(glm::length(seen - 1.0 - texel_direction(map.layout, 0, face, column, row)), 0.002) << face;
            }
    }
}

TEST(Prefilter, MuchFinerProbesGiveTheSameLevelZero) {
    const auto light = [](const glm::dvec3& d) { return glm::dvec3(1 + d.x, 2 + d.y * d.z, d.z > 0.7 ? 5.0 : 1.0); };
    const ProbeImage fine = test::made_probe(Mapping::Equirectangular, 512, light);  // 16 columns a texel: scattered
    const EnvironmentMap scattered = prefilter(fine, {16});
    const EnvironmentMap gathered = prefilter(test::made_probe(Mapping::Equirectangular, 128, light), {16});
    EXPECT_LT(glm::length(level_mean(scattered, 0) - probe_mean(fine)), 0.002);
    double square = 0;
    for (std::size_t i = 0; i < scattered.layout.offset(1); ++i)
        square += std::pow(glm::length(scattered.texels[i] - gathered.texels[i]), 2);
    // The step's edge passes through some texels, which see it to a texel of the coarser probe.
    EXPECT_LT(std::sqrt(square / static_cast<double>(scattered.layout.offset(1))), 0.1);
}

TEST(Prefilter, RealProbesKeepTheirMeanInEveryLevel) {
    for (const char* name : {"probes/royal_esplanade_1k.hdr", "probes/blender_sunset.exr"}) {
        ROWLAND_TEST_DATA(path, name);
        const ProbeImage probe(image::load_image(path), Mapping::Equirectangular, name);
        const EnvironmentMap map = prefilter(probe, {64});
        const glm::dvec3 mean = probe_mean(probe);
        for (int level = 0; level < map.layout.levels; ++level) {
            const glm::dvec3 kept = level_mean(map, level) / mean;
            // The contract's 1 %; the last level has 96 texels, whose centres alone sample it to 2 %.
            const double tolerance = level + 1 < map.layout.levels ? 0.01 : 0.02;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(kept[c], 1, tolerance) << name << ", level " << level;
        }
    }
}

TEST(Prefilter, TexelSizedLampsAreSpreadWithoutFireflies) {
    // Lamps 10 000 times the mean: every level must agree with the exact sum, near the lamps and away from them.
    ROWLAND_TEST_DATA(path, "probes/royal_esplanade_1k.hdr");
    const EnvironmentMap map = prefilter({image::load_image(path), Mapping::Equirectangular}, {64});
    const double mean = level_mean(map, 0).y;
    for (int level = 1; level < map.layout.levels; ++level) {
        const int size = map.layout.size(level);
        const double roughness = static_cast<double>(level) / (map.layout.levels - 1);
        for (int face = 0; face < 6; ++face)
            for (int i = 0; i < 6; ++i) {
                const int column = (i * 7 + face) % size;
                const int row = (i * 11 + 3 * face) % size;
                const glm::dvec3 exact =
                    brute_force(map, texel_direction(map.layout, level, face, column, row), roughness * roughness);
                const double seen = map.texels[map.layout.index(level, face, column, row)].y;
                // Nodes are a quarter of their distance wide; measured 1 % at most of the lamps' share.
                EXPECT_NEAR(seen, exact.y, 0.02 * exact.y + 0.01 * mean) << level << ": " << face << ", " << i;
            }
    }
}

}  // namespace

}  // namespace rowland::lighting
