#include "editor/trade/probe_statistics.h"

#include <gtest/gtest.h>

namespace rowland::trade {
namespace {

lighting::ProbeImage uniform_but(std::size_t texel, float value) {
    image::Image image{.width = 64, .height = 32, .texels = std::vector<glm::vec3>(2048, glm::vec3(0.5F))};
    image.texels[texel] = glm::vec3(value);
    return {std::move(image), lighting::Mapping::Equirectangular};
}

TEST(ProbeStatistics, OfAUniformProbe) {
    const ProbeStatistics found = statistics_of(uniform_but(0, 0.5F));
    EXPECT_EQ(found.width, 64);
    EXPECT_EQ(found.height, 32);
    EXPECT_NEAR(found.mean, 0.5, 1e-6);
    EXPECT_NEAR(found.peak_over_mean, 1.0, 1e-6);
    EXPECT_NEAR(found.brightest_fraction, 1e-3, 1e-8);
}

TEST(ProbeStatistics, ALampOfATexel) {
    // A texel at the equator: 2π/64 · π/32 sr of 4π, but for 4e-4: .0767 % of the sphere, which gives .0767 of .5767.
    const ProbeStatistics found = statistics_of(uniform_but(16 * 64 + 20, 50.0F));
    EXPECT_NEAR(found.mean, 0.5 + 49.5 * 7.666e-4, 1e-4);
    EXPECT_NEAR(found.peak_over_mean, 50.0 / found.mean, 1e-6);
    EXPECT_NEAR(found.brightest_fraction, (50.0 * 7.666e-4 + 0.5 * 2.334e-4) / found.mean, 1e-4);
}

TEST(ProbeStatistics, OfABlackProbe) {
    image::Image image{.width = 8, .height = 4, .texels = std::vector<glm::vec3>(32, glm::vec3(0.0F))};
    const ProbeStatistics found = statistics_of({std::move(image), lighting::Mapping::Equirectangular});
    EXPECT_EQ(found.mean, 0.0);
    EXPECT_EQ(found.peak_over_mean, 0.0);
}

}  // namespace
}  // namespace rowland::trade
