#include "engine/lighting/probe_image.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

using std::numbers::pi;

/// The lines that a probe of a recipe or of a file would log.
std::string warnings(int width, int height, Mapping mapping, float radiance = 1.0F) {
    image::Image image = image::make_image(width, height);
    for (glm::vec3& texel : image.texels) texel = glm::vec3(radiance);
    testing::internal::CaptureStderr();
    warn_about(ProbeImage(std::move(image), mapping), "a.hdr");
    return testing::internal::GetCapturedStderr();
}

TEST(ProbeImage, SquareImagesAsEquirectangularAreWarnedAbout) {
    EXPECT_NE(warnings(64, 64, Mapping::Equirectangular).find("did you mean the mapping \"angular\"?"),
              std::string::npos);
    for (const glm::ivec2 size : {glm::ivec2(64, 32), {64, 63}, {1, 1}})
        EXPECT_EQ(warnings(size.x, size.y, Mapping::Equirectangular), "") << size.x << " x " << size.y;
    EXPECT_EQ(warnings(64, 64, Mapping::Angular), "");
}

TEST(ProbeImage, TexelsThatAreNoRadianceAreWarnedAbout) {
    EXPECT_NE(warnings(4, 2, Mapping::Equirectangular, -1.0F).find("8 negative"), std::string::npos);
}

TEST(ProbeImage, CentreLooksAlongMinusZRightIsPlusXTopIsPlusY) {
    for (const Mapping mapping : test::kMappings) {
        const ProbeImage probe = test::constant_probe(mapping, 8);
        const double width = probe.image().width;
        const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-12; };
        EXPECT_TRUE(near(probe.direction(width / 2, 4), {0, 0, -1}));
        // A quarter turn right and up: a quarter of the width, or of the angular map's radius of half a turn.
        EXPECT_TRUE(near(probe.direction(width * 3 / 4, 4), {1, 0, 0}));
        const double up = mapping == Mapping::Angular ? 2 : 0;
        EXPECT_TRUE(near(probe.direction(width / 2, up), {0, 1, 0}));
    }
}

TEST(ProbeImage, LookupFollowsTheSameAxes) {
    // Light that is its own direction, made positive: what a look-up returns is where it looked.
    const auto encode = [](const glm::dvec3& d) { return d + 1.0; };
    for (const Mapping mapping : test::kMappings) {
        const ProbeImage probe = test::made_probe(mapping, 128, encode);
        for (int i = 0; i < 500; ++i) {
            const glm::dvec3 d = test::spread_direction(i, 500);
            if (mapping == Mapping::Angular && d.z > 0.98) continue;  // the rim has no neighbours to interpolate to
            // A texel is π/128 = .025 rad here; bilinear error of a sine is its square over 8, more where it is
            // oblique.
            EXPECT_LT(glm::length(probe.radiance(d) - 1.0 - d), 0.004) << i;
        }
    }
}

TEST(ProbeImage, LookupAtATexelCentreIsTheTexel) {
    for (const Mapping mapping : test::kMappings) {
        const ProbeImage probe = test::made_probe(
            mapping, 16, [](const glm::dvec3& d) { return glm::dvec3(d.x + 2, d.y + 2, 7 * d.z + 9); });
        for (int row = 0; row < 16; ++row)
            for (int column = 0; column < probe.image().width; ++column) {
                if (probe.solid_angle(column, row) == 0) continue;
                const glm::dvec3 seen = probe.radiance(probe.direction(column + 0.5, row + 0.5));
                EXPECT_LT(glm::length(seen - glm::dvec3(probe.image().at(column, row))), 1e-9) << column << ", " << row;
            }
    }
}

TEST(ProbeImage, OneTexelIsLightFromEverywhere) {
    for (const Mapping mapping : test::kMappings) {
        const ShLight light = project(ProbeImage({1, 1, {glm::vec3(2.0F, 1.0F, 0.5F)}}, mapping), 4);
        const double all = std::sqrt(4 * pi);
        EXPECT_LT(glm::length(light.coefficients[0] - all * glm::dvec3(2, 1, 0.5)), 1e-12);
        for (std::size_t i = 1; i < light.coefficients.size(); ++i)
            // What sums over 64 rows leave; measured: 9e-4.
            EXPECT_LT(glm::length(light.coefficients[i]), 1e-3 * all) << i;
    }
}

TEST(ProbeImage, WhatLiesOutsideTheDiscNeverLeaks) {
    // made_probe fills the corners with 1e6.
    const ProbeImage probe = test::constant_probe(Mapping::Angular, 31);
    for (int i = 0; i < 20000; ++i) {
        // Crowded around +Z, which is the rim.
        const double angle = 0.3 * i / 20000;
        const double phi = i * 2.4;
        const glm::dvec3 d(std::sin(angle) * std::cos(phi), std::sin(angle) * std::sin(phi), std::cos(angle));
        EXPECT_NEAR(probe.radiance(d).x, 1, 1e-12) << i;
    }
    EXPECT_NEAR(probe.radiance({0, 0, 1}).x, 1, 1e-12);
}

TEST(ProbeImage, EquirectangularColumnsWrap) {
    const ProbeImage probe = test::made_probe(Mapping::Equirectangular, 2, [](const glm::dvec3& d) {
        return glm::dvec3(d.z > 0.4 && d.x > 0 ? 4.0 : 0.0);  // of four columns the last
    });
    EXPECT_NEAR(probe.radiance({0, 0, 1}).x, 2, 1e-12);  // halfway between the last column and the first
    EXPECT_NEAR(probe.radiance({1e-12, 0, 1}).x, probe.radiance({-1e-12, 0, 1}).x, 1e-9);
}

TEST(ProbeImage, SolidAnglesSumToTheSphere) {
    for (const Mapping mapping : test::kMappings)
        for (const int height : {4, 15, 16, 64, 127, 512}) {
            const ProbeImage probe = test::constant_probe(mapping, height);
            double sum = 0;
            for (int row = 0; row < height; ++row)
                for (int column = 0; column < probe.image().width; ++column) sum += probe.solid_angle(column, row);
            // An angular map loses the slivers inside the disc of texels whose centre is outside: O(1/height²).
            // An equirectangular one only rounds, over up to half a million texels.
            const double tolerance = mapping == Mapping::Angular ? 0.6 / (height * height) + 1e-6 : 1e-11;
            EXPECT_NEAR(sum / (4 * pi), 1, tolerance) << height;
        }
}

TEST(ProbeImage, AngularSolidAngleIsTheIntegralOverTheTexel) {
    for (const int size : {16, 63, 100}) {
        const ProbeImage probe = test::constant_probe(Mapping::Angular, size);
        for (int row = 0; row < size; row += 5)
            for (int column = 0; column < size; column += 3) {
                double sum = 0;
                constexpr int kSteps = 60;
                for (int j = 0; j < kSteps; ++j)
                    for (int i = 0; i < kSteps; ++i) {
                        const double u = 2 * (column + (i + 0.5) / kSteps) / size - 1;
                        const double v = 2 * (row + (j + 0.5) / kSteps) / size - 1;
                        const double angle = pi * std::hypot(u, v);
                        if (angle < pi) sum += angle > 0 ? std::sin(angle) / angle : 1;
                    }
                const double side = 2 * pi / (size * kSteps);
                if (probe.solid_angle(column, row) == 0) continue;  // centre outside
                EXPECT_NEAR(probe.solid_angle(column, row), sum * side * side, 1e-4 * std::pow(2 * pi / size, 2))
                    << size << ": " << column << ", " << row;
            }
    }
}

TEST(ProbeImage, TexelsThatAreNoLightAreCountedAndBlack) {
    image::Image image{2, 1, {{1, std::nanf(""), 2}, {-3, 4, std::numeric_limits<float>::infinity()}}};
    image.texels.emplace_back(0, -1, 5);
    image.texels.emplace_back(1, 2, 3);
    image.height = 2;
    const ProbeImage probe(image, Mapping::Equirectangular);
    EXPECT_EQ(probe.report().nan, 1u);
    EXPECT_EQ(probe.report().infinite, 1u);
    EXPECT_EQ(probe.report().negative, 1u);
    EXPECT_EQ(probe.report().total(), 3u);
    EXPECT_EQ(probe.image().at(0, 0), glm::vec3(1, 0, 2));
    EXPECT_EQ(probe.image().at(1, 0), glm::vec3(0, 4, 0));
    EXPECT_EQ(probe.image().at(0, 1), glm::vec3(0, 0, 5));
    EXPECT_EQ(probe.image().at(1, 1), glm::vec3(1, 2, 3));
}

TEST(ProbeImage, BadShapesAndMappingsAreRefused) {
    EXPECT_THROW(ProbeImage(image::Image{}, Mapping::Equirectangular, "x.hdr"), Error);
    try {
        const ProbeImage taken(image::Image{2, 1, {{}, {}}}, Mapping::Angular, "x.hdr");
        FAIL() << "an oblong angular map was taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.info().file, "x.hdr");
        EXPECT_NE(error.info().expected.find("square"), std::string::npos);
    }
    EXPECT_EQ(parse_mapping("equirect"), Mapping::Equirectangular);
    EXPECT_EQ(parse_mapping("angular"), Mapping::Angular);
    EXPECT_THROW(parse_mapping("cube"), Error);
}

}  // namespace
}  // namespace rowland::lighting
