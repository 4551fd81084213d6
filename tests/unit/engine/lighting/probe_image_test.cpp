#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/sh_light.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/engine/lighting/made_probes.h"

// Images of every shape are legal probes. Cooked, they have all their light, in time and memory in proportion to their
// texels.

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// A square image whose circle is bright, with a caption of `caption` rows in its upper left corner.
image::Image angular_map(int size, float corner, int caption = 0) {
    image::Image image = image::make_image(size, size);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const bool inside = std::hypot(2 * column + 1 - size, 2 * row + 1 - size) <= size;
            image.at(column, row) = glm::vec3(inside ? 0.5F : row < caption && column < size / 4 ? 1.0F : corner);
        }
    return image;
}

TEST(RecognisedMapping, ASquareImageThatIsBlackOutsideItsCircleIsAnAngularMap) {
    EXPECT_EQ(detect_mapping(angular_map(64, 0.0F), "a.hdr"), Mapping::Angular);
    EXPECT_EQ(detect_mapping(angular_map(64, 0.0F, 4), "a.hdr"), Mapping::Angular) << "a caption in a corner";
    EXPECT_EQ(ProbeImage(angular_map(64, 0.0F), Mapping::Auto).mapping(), Mapping::Angular);
}

TEST(RecognisedMapping, AnImageThatIsNotSquareIsEquirectangular) {
    for (const glm::ivec2 size : {glm::ivec2(64, 32), {1, 1}, {8, 2}, {63, 64}}) {
        const image::Image image = image::make_image(size.x, size.y);
        EXPECT_EQ(detect_mapping(image, "a.hdr"), Mapping::Equirectangular) << size.x << " x " << size.y;
    }
}

TEST(RecognisedMapping, ASquareImageWithLightInItsCornersIsRefusedByName) {
    for (const int size : {2, 3, 64})
        EXPECT_THAT(test::message_of([&] { detect_mapping(angular_map(size, 0.4F), "a.hdr"); }),
                    testing::AllOf(testing::StartsWith("a.hdr"), testing::HasSubstr("\"angular\"")));
}

TEST(RecognisedMapping, PublishedProbesAreRecognised) {
    ROWLAND_TEST_DATA(grace, "probes/grace_probe.hdr");
    ROWLAND_TEST_DATA(beach, "probes/beach_probe.hdr");
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    EXPECT_EQ(detect_mapping(image::load_image(grace), "grace"), Mapping::Angular);
    EXPECT_EQ(detect_mapping(image::load_image(beach), "beach"), Mapping::Angular);
    EXPECT_EQ(detect_mapping(image::load_image(venice), "venice"), Mapping::Equirectangular);
}

TEST(RecognisedMapping, NamesAreReadAsTheyAreWritten) {
    for (const Mapping mapping : {Mapping::Equirectangular, Mapping::Angular, Mapping::Auto})
        EXPECT_EQ(parse_mapping(mapping_name(mapping)), mapping);
}

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
        for (const int height : {4, 15, 16, 64, 127}) {
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
    EXPECT_THAT(test::message_of([] {
                    ProbeImage(image::Image{2, 1, {{}, {}}}, Mapping::Angular, "x.hdr");
                }),
                testing::AllOf(testing::StartsWith("x.hdr"), testing::HasSubstr("square")));
    EXPECT_EQ(parse_mapping("equirect"), Mapping::Equirectangular);
    EXPECT_EQ(parse_mapping("angular"), Mapping::Angular);
    EXPECT_THROW(parse_mapping("cube"), Error);
}

/// 1 × n, n × 1 and powers of ten, up to the largest sides that are read.
std::vector<glm::ivec2> shapes() {
    std::vector<glm::ivec2> all;
    for (const int n : {1, 10, 100, 1000, 10000, 32768})
        for (const int m : {1, 10}) {
            all.emplace_back(n, m);
            all.emplace_back(m, n);
        }
    for (const glm::ivec2 shape : {glm::ivec2(10, 400), {10, 4000}, {400, 10}, {1000, 100}, {100, 1000}, {7, 31}})
        all.push_back(shape);
    return all;
}

/// Brighter toward the end of each axis, so that a side that is left out or counted twice is noticed.
ProbeImage slope(const glm::ivec2& shape, Mapping mapping) {
    image::Image image = image::make_image(shape.x, shape.y);
    for (int row = 0; row < shape.y; ++row)
        for (int column = 0; column < shape.x; ++column)
            image.at(column, row) = glm::vec3(1.0F, 1.0F + static_cast<float>(column) / static_cast<float>(shape.x),
                                              1.0F + static_cast<float>(row) / static_cast<float>(shape.y));
    return {std::move(image), mapping};
}

glm::dvec3 flux(const LightSamples& texels) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < texels.size(); ++i) sum += texels.flux(i);
    return sum;
}

TEST(ProbeShape, KeepsOrdinaryImages) {
    for (const glm::ivec2 shape : {glm::ivec2(1, 1),
                                   {2, 1},
                                   {1, 1},
                                   {1024, 512},
                                   {512, 512},
                                   {128, 512},
                                   {512, 32},
                                   {16384, 8192},
                                   {32768, 4096}})
        EXPECT_EQ(resampled_size(shape.x, shape.y), shape) << shape.x << " x " << shape.y;
}

TEST(ProbeShape, LimitsTheTexelsAndTheirLength) {
    for (const glm::ivec2 shape : shapes()) {
        const glm::dvec2 size(resampled_size(shape.x, shape.y));
        EXPECT_LE(size.x * size.y, std::max(2.0 * shape.x * shape.y, 0x1p20) + size.x + size.y);
        EXPECT_LE(2 * size.y / size.x, 8.0 * 1.2) << shape.x << " x " << shape.y;
        EXPECT_GE(2 * size.y / size.x, 1 / (8.0 * 1.2)) << shape.x << " x " << shape.y;
    }
}

/// An image of 20000 texels one over the other is averaged to fewer rows: each row's flux goes to where it lies.
TEST(ProbeShape, AveragingKeepsFluxAndDirection) {
    image::Image image = image::make_image(1, 20000);
    for (int row = 5000; row < 5010; ++row) image.at(0, row) = glm::vec3(1000.0F);  // 45° above the horizon
    const ProbeImage probe(image, Mapping::Equirectangular);
    EXPECT_LT(probe.image().height, 20000);
    const ShLight sh = project(probe, 3);
    const double expected = 1000.0 * 2 * pi * (std::cos(pi * 0.25) - std::cos(pi * 0.2505));
    EXPECT_NEAR(sh.coefficients[0].x * std::sqrt(4 * pi), expected, 0.005 * expected);
    // ∫ L y over the sphere is the flux times sin 45°.
    EXPECT_NEAR(sh.coefficients[1].x * std::sqrt(4 * pi / 3), expected * std::sqrt(0.5), 0.005 * expected);
}

void expect_all_light(const glm::ivec2& shape, Mapping mapping, int key_lights = 0) {
    SCOPED_TRACE(testing::Message() << shape.x << " x " << shape.y << (mapping == Mapping::Angular ? " angular" : ""));
    const ProbeImage probe = slope(shape, mapping);
    LightProbeSettings settings;
    settings.bands = 1;
    settings.key_lights = key_lights;
    settings.light_face = 16;
    settings.prefilter.face_size = 16;
    const LightProbe cooked = build_light_probe(probe, settings);
    const glm::dvec3 mean = cooked.sh.coefficients[0] / std::sqrt(4 * pi);
    EXPECT_NEAR(mean.x, 1.0, 1e-9);
    for (int c = 1; c < 3; ++c) EXPECT_GE(mean[c], 1.0 - 1e-9);
    for (int c = 1; c < 3; ++c) EXPECT_LT(mean[c], 2.0);
    // An angular map's rim: 2e-3. Bilinear radiance between few texels has another mean than the texels.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux(unpack(cooked.light))[c] / (4 * pi), mean[c], c == 0 ? 3e-3 : 0.06);
    const EnvironmentMap map = unpack(cooked.environment);
    glm::dvec3 sum(0.0);
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < map.layout.face_size; ++row)
            for (int column = 0; column < map.layout.face_size; ++column)
                sum += cube_solid_angle(map.layout.face_size, column, row) *
                       glm::dvec3(map.texels[map.layout.index(0, face, column, row)]);
    EXPECT_NEAR(sum.x / (4 * pi), 1.0, 1e-3);  // half floats
    for (int c = 1; c < 3; ++c) EXPECT_NEAR(sum[c] / (4 * pi), mean[c], 0.06);
}

TEST(ProbeShape, EveryEquirectangularShapeGivesAllItsLight) {
    for (const glm::ivec2 shape : {glm::ivec2(1, 1), {1, 10}, {1000, 10}, {10, 400}, {32768, 1}})
        expect_all_light(shape, Mapping::Equirectangular);
    expect_all_light({1, 32768}, Mapping::Equirectangular, 1);
}

TEST(ProbeShape, EveryAngularSizeGivesAllItsLight) {
    for (const int n : {1, 2, 3, 10, 200}) expect_all_light({n, n}, Mapping::Angular);
    expect_all_light({2, 2}, Mapping::Angular, 1);
}

TEST(ProbeShape, SamplesFollowTheTexels) {
    // Texels of at most 0.0065 rad: 967 × 484 for the smallest probes, of which no texel is more than 8 times as long.
    for (const glm::ivec2 shape : {glm::ivec2(10, 400), {32768, 1}}) {
        const ProbeImage probe = slope(shape, Mapping::Equirectangular);
        const std::size_t texels = probe.image().texels.size();
        EXPECT_LE(light_samples(probe).size(), std::max<std::size_t>(2 * texels, 1 << 21)) << shape.x << ' ' << shape.y;
    }
}

}  // namespace

}  // namespace rowland::lighting
