#include "engine/lighting/light_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace rowland::lighting {
namespace {

ProbeImage uniform(int width, int height, Mapping mapping) {
    image::Image image{.width = width, .height = height, .texels = {}};
    image.texels.resize(static_cast<std::size_t>(width * height), glm::vec3(1.0F, 2.0F, 3.0F));
    return {std::move(image), mapping};
}

glm::dvec3 total(const LightSamples& texels) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < texels.size(); ++i) sum += glm::dvec3(texels.red[i], texels.green[i], texels.blue[i]);
    return sum;
}

/// The flux of a uniform probe is 4π times its radiance: floats, 1e-5; the angular map's rim, 1e-3.
TEST(LightSamples, CoverTheSphereOnce) {
    const double sphere = 4.0 * std::numbers::pi;
    EXPECT_NEAR(total(light_samples(uniform(64, 32, Mapping::Equirectangular))).z / sphere, 3.0, 3e-5);
    EXPECT_NEAR(total(light_samples(uniform(64, 64, Mapping::Angular))).y / sphere, 2.0, 2e-3);
}

TEST(LightSamples, CoarseTexelsAreCut) {
    EXPECT_EQ(light_samples(uniform(64, 32, Mapping::Equirectangular), {}, 0.05).size(), 4U * 64U * 32U);
    EXPECT_EQ(light_samples(uniform(64, 32, Mapping::Equirectangular), {}, 0.1).size(), 64U * 32U);
}

/// To a double's sum of floats; also for a lobe that falls between texels.
TEST(LightSamples, LobesAreTakenOutFluxForFlux) {
    const ProbeImage probe = uniform(64, 32, Mapping::Equirectangular);
    const glm::dvec3 all = total(light_samples(probe, {}, 0.1));
    for (const double concentration : {0.5, 30.0, 1e3, 1e7}) {
        const KeyLight key{glm::normalize(glm::dvec3(0.4, 0.3, 0.7)), {3.0, 2.0, 1.0}, concentration};
        const LightSamples left = light_samples(probe, std::span(&key, 1), 0.1);
        EXPECT_LT(glm::length(all - total(left) - key.flux), 1e-4 * glm::length(key.flux)) << concentration;
    }
}

/// The mean cosine to the axis is 1 − 1/κ, and of its square 1 − 2/κ + 2/κ². Floats: 1e-7 of 1.
TEST(LightSamples, ANarrowLobeKeepsItsMoments) {
    for (const double concentration : {100.0, 1e4, 1e6}) {
        const KeyLight key{glm::normalize(glm::dvec3(0.4, 0.3, 0.7)), {3.0, 2.0, 1.0}, concentration};
        LightSamples samples;
        subtract_narrow_lobe(key, samples);
        EXPECT_LT(glm::length(total(samples) + key.flux), 1e-6);
        glm::dvec3 mean(0.0);
        double square = 0.0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double weight = -samples.red[i] / key.flux.x;
            const double cosine = glm::dot(samples.direction(i), key.direction);
            mean += weight * samples.direction(i);
            square += weight * cosine * cosine;
        }
        EXPECT_LT(glm::distance(mean, (1.0 - 1.0 / concentration) * key.direction), 1e-6) << concentration;
        EXPECT_NEAR(square, 1.0 - 2.0 / concentration * (1.0 - 1.0 / concentration), 1e-6) << concentration;
    }
}

TEST(LightSamples, GatheringKeepsFluxAndPlace) {
    image::Image image{.width = 256, .height = 128, .texels = {}};
    image.texels.resize(std::size_t{256} * 128, glm::vec3(0.0F));
    image.at(40, 50) = glm::vec3(100.0F);
    const ProbeImage probe(image, Mapping::Equirectangular);
    const LightSamples texels = light_samples(probe, {}, 0.1);
    const LightSamples gathered = gather_texels(texels, 16);
    ASSERT_EQ(gathered.size(), 1U);
    EXPECT_NEAR(gathered.red[0], total(texels).x, 1e-6 * total(texels).x);
    const glm::dvec3 place(gathered.x[0], gathered.y[0], gathered.z[0]);
    EXPECT_LT(glm::length(place - probe.direction(40.5, 50.5)), 1e-6);
}

}  // namespace
}  // namespace rowland::lighting
