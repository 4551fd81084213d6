#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "engine/lighting/light_samples.h"
#include "engine/math/spherical_harmonics.h"
#include "tests/unit/engine/lighting/made_probes.h"

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
    const LightSamples gathered = merge_samples(texels, 16);
    ASSERT_EQ(gathered.size(), 1U);
    EXPECT_NEAR(gathered.red[0], total(texels).x, 1e-6 * total(texels).x);
    const glm::dvec3 place(gathered.x[0], gathered.y[0], gathered.z[0]);
    EXPECT_LT(glm::length(place - probe.direction(40.5, 50.5)), 1e-6);
}

/// A room with a lamp of 0.1 rad.
ProbeImage room() {
    return test::made_probe(Mapping::Equirectangular, 64, [](const glm::dvec3& d) {
        const double lamp = glm::dot(d, glm::normalize(glm::dvec3(1.0, 2.0, -0.5))) > 0.995 ? 200.0 : 0.0;
        return glm::dvec3(1.0 + d.x + lamp, 2.0 + 0.5 * lamp, d.y > 0.0 ? 1.0 : 0.0);
    });
}

LightSamples one_light(const glm::dvec3& direction, float flux) {
    const glm::vec3 s(direction);
    return {.x = {s.x}, .y = {s.y}, .z = {s.z}, .red = {flux}, .green = {0.0F}, .blue = {0.5F * flux}};
}

glm::dvec3 flux_of(const LightSamples& texels) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < texels.size(); ++i) sum += glm::dvec3(texels.red[i], texels.green[i], texels.blue[i]);
    return sum;
}

ShLight sh_of(const LightSamples& texels, int bands) {
    ShLight sh{.bands = bands, .coefficients = std::vector<glm::dvec3>(static_cast<std::size_t>(bands * bands))};
    std::vector<double> basis(sh.coefficients.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        math::evaluate_sh(glm::normalize(glm::dvec3(texels.x[i], texels.y[i], texels.z[i])), bands, basis);
        for (std::size_t k = 0; k < basis.size(); ++k)
            sh.coefficients[k] += basis[k] * glm::dvec3(texels.red[i], texels.green[i], texels.blue[i]);
    }
    return sh;
}

void expect_near(const ShLight& a, const ShLight& b, double tolerance) {
    for (std::size_t k = 0; k < b.coefficients.size(); ++k)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(a.coefficients[k][c], b.coefficients[k][c], tolerance * b.coefficients[0][c]) << k << ' ' << c;
}

TEST(PackedLight, ACompactLampKeepsItsPlaceAndFlux) {
    constexpr int kFace = 8;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 d = test::spread_direction(i, 200);
        const LightSamples read = unpack(pack(one_light(d, 0.37F), kFace));
        ASSERT_EQ(read.size(), 1U);
        // At most half a step of 1/256 of a side of 2/8 along either axis, in the middle of a face.
        EXPECT_LT(glm::distance(glm::dvec3(read.x[0], read.y[0], read.z[0]), d), 0.5 / 256 * 2 / kFace * 1.5);
        EXPECT_NEAR(read.red[0], 0.37, 0.37 / 2048);
        EXPECT_EQ(read.green[0], 0.0F);
        EXPECT_NEAR(read.blue[0], 0.185, 0.185 / 2048);
    }
}

TEST(PackedLight, KeepsTheLowBandsOfAProbe) {
    const LightSamples texels = light_samples(room());
    const LightSamples read = unpack(pack(texels, 64));
    EXPECT_LE(read.size(), std::size_t{6} * 64 * 64);
    // Rounding to 1/2048 averages out. All of a texel's light lies at one point; its spread over a side h ≤ 2/64 is
    // lost, l(l+1)/24 h² of band l: 8e-4 of band 4.
    expect_near(sh_of(read, 5), sh_of(texels, 5), 1e-3);
}

TEST(PackedLight, ProbesOfAnyBrightnessFitHalves) {
    for (const float flux : {1e-30F, 1e-3F, 1e30F}) {
        const PackedLight packed = pack(one_light({0.0, 1.0, 0.0}, flux), 4);
        EXPECT_NEAR(unpack(packed).red[0] / flux, 1.0, 1.0 / 2048);
    }
}

TEST(PackedLight, BlackLightsAreLeftOut) {
    EXPECT_EQ(unpack(PackedLight()).size(), 0U);
    EXPECT_EQ(unpack(pack(LightSamples(), 4)).size(), 0U);
    EXPECT_EQ(unpack(pack(one_light({0.0, 1.0, 0.0}, 0.0F), 4)).size(), 0U);
}

TEST(PackedLight, KeyLightsAndWhatTheyLeaveAreTheWhole) {
    const PackedLight packed = pack(light_samples(room()), 64);
    const LightSamples whole = unpack(packed);
    // Whatever the lobes, also one narrower than any texel and one brighter than what it is taken from.
    const std::array<KeyLight, 3> keys{{{glm::normalize(glm::dvec3(1.0, 2.0, -0.5)), {6.0, 3.0, 0.0}, 300.0},
                                        {{0.0, -1.0, 0.0}, {1.0, 2.0, 30.0}, 40.0},
                                        {glm::normalize(glm::dvec3(-1.0, 0.3, 0.2)), {0.1, 0.2, 0.3}, 1e6}}};
    const LightSamples left = unpack(packed, keys);
    const glm::dvec3 taken = keys[0].flux + keys[1].flux + keys[2].flux;
    // Sums of 2e4 floats.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux_of(left)[c] + taken[c], flux_of(whole)[c], 1e-5 * flux_of(whole)[c]);
    // Lobes are cut into pieces of h ≤ 2/128, and lose l(l+1)/24 h² of band l: 2e-4 of band 4.
    ShLight sum = sh_of(left, 5);
    const ShLight lobes = project(keys, 5);
    for (std::size_t k = 0; k < sum.coefficients.size(); ++k) sum.coefficients[k] += lobes.coefficients[k];
    expect_near(sum, sh_of(whole, 5), 2e-4);
}

TEST(PackedLight, DoesNotDependOnTheNumberOfThreads) {
    const PackedLight packed = pack(light_samples(room()), 16);
    const std::array<KeyLight, 2> keys{
        {{{0.0, 1.0, 0.0}, {1.0, 1.0, 1.0}, 60.0}, {{1.0, 0.0, 0.0}, {1.0, 2.0, 3.0}, 80.0}}};
    const ThreadLimit one(1);
    const LightSamples a = unpack(packed, keys);
    const ThreadLimit two(2);
    const LightSamples b = unpack(packed, keys);
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.red, b.red);
}

}  // namespace

}  // namespace rowland::lighting
