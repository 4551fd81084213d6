// Images of every shape are legal probes. Cooked, they have all their light, in time and memory in proportion to their
// texels.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/lighting/light_probe.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/probe_image.h"

namespace rowland::lighting {
namespace {

using std::numbers::pi;

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
        EXPECT_EQ(probe_shape(shape.x, shape.y), shape) << shape.x << " x " << shape.y;
}

TEST(ProbeShape, LimitsTheTexelsAndTheirLength) {
    for (const glm::ivec2 shape : shapes()) {
        const glm::dvec2 size(probe_shape(shape.x, shape.y));
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
    for (const glm::ivec2 shape : {glm::ivec2(1, 1), {1, 10}, {1000, 10}, {10, 400}, {10, 4000}, {32768, 1}})
        expect_all_light(shape, Mapping::Equirectangular);
    expect_all_light({1, 32768}, Mapping::Equirectangular, 1);
}

TEST(ProbeShape, EveryAngularSizeGivesAllItsLight) {
    for (const int n : {1, 2, 3, 10, 1000}) expect_all_light({n, n}, Mapping::Angular);
    expect_all_light({2, 2}, Mapping::Angular, 1);
}

TEST(ProbeShape, SamplesFollowTheTexels) {
    // Texels of at most 0.0065 rad: 967 × 484 for the smallest probes, of which no texel is more than 8 times as long.
    for (const glm::ivec2 shape : {glm::ivec2(10, 400), {1, 20000}, {32768, 1}}) {
        const ProbeImage probe = slope(shape, Mapping::Equirectangular);
        const std::size_t texels = probe.image().texels.size();
        EXPECT_LE(light_samples(probe).size(), std::max<std::size_t>(2 * texels, 1 << 21)) << shape.x << ' ' << shape.y;
    }
}

}  // namespace
}  // namespace rowland::lighting
