#include "engine/post/glare.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tests/gpu/engine/post/post_test.h"

namespace rowland {

namespace {

using post::GlarePattern;
using post::GlareSettings;

/// A picture and how its pixels lie in direction cosines.
struct GlareScene {
    glm::ivec2 size{0};
    float vertical_fov = 0.0F;
    std::vector<glm::vec4> pixels{};

    explicit GlareScene(glm::ivec2 of_size, float fov)
        : size(of_size), vertical_fov(fov), pixels(static_cast<std::size_t>(size.x * size.y), {0, 0, 0, 1}) {}

    std::size_t index(glm::ivec2 at) const { return static_cast<std::size_t>(at.y * size.x + at.x); }
    double tan_half() const { return std::tan(0.5 * vertical_fov); }
    glm::dvec2 tangents(glm::dvec2 pixel) const {
        return (2.0 * (pixel + 0.5) - glm::dvec2(size)) / static_cast<double>(size.y) * tan_half();
    }
    glm::dvec2 cosines(glm::dvec2 pixel) const {
        const glm::dvec2 t = tangents(pixel);
        return t / std::sqrt(1.0 + glm::dot(t, t));
    }
    glm::dvec2 pixel_of(glm::dvec2 cosines) const {
        const glm::dvec2 t = cosines / std::sqrt(1.0 - glm::dot(cosines, cosines));
        return 0.5 * (t / tan_half() * static_cast<double>(size.y) + glm::dvec2(size)) - 0.5;
    }
    /// A pixel's area in direction cosines.
    double area(glm::ivec2 pixel) const {
        const glm::dvec2 t = tangents(pixel);
        const double squared_cosine = 1.0 / (1.0 + glm::dot(t, t));
        const double side = 2.0 * tan_half() / size.y;
        return side * side * squared_cosine * squared_cosine;
    }
    /// Light of a colour, spread as a Gaussian of so many pixels. Its sum is the colour.
    void add_spot(glm::dvec2 centre, double sigma, glm::vec3 colour) {
        std::vector<double> parts;
        for_each([&](glm::ivec2 at) {
            const glm::dvec2 beside = glm::dvec2(at) - centre;
            parts.push_back(std::exp(-0.5 * glm::dot(beside, beside) / (sigma * sigma)));
        });
        double sum = 0.0;
        for (const double part : parts) sum += part;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] += glm::vec4(static_cast<float>(parts[i] / sum) * colour, 0.0F);
    }
    template <typename Visit>
    void for_each(Visit visit) const {
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) visit(glm::ivec2(x, y));
    }
    /// The light of a picture of this size, pixels weighted by their area.
    glm::dvec3 energy(const std::vector<glm::vec4>& picture) const {
        glm::dvec3 sum(0.0);
        for_each([&](glm::ivec2 at) { sum += area(at) * glm::dvec3(picture[index(at)]); });
        return sum;
    }
};

/// Two orders on either side with colours that change along them; they keep 90 % of the light.
std::shared_ptr<GlarePattern> two_orders(double per_order) {
    auto pattern = std::make_shared<GlarePattern>();
    pattern->straight = glm::mat3(0.3F);
    constexpr int kPoints = 40;
    for (int i = 0; i < kPoints; ++i) {
        const float t = (static_cast<float>(i) + 0.5F) / kPoints;
        glm::mat3 weight(0.0F);
        weight[0] = {0.8F * t, 0.1F, 0.1F * t};
        weight[1] = {0.3F * (1.0F - t), 0.5F, 0.2F * t};
        weight[2] = {0.0F, 0.2F, 1.4F * (1.0F - t)};
        for (const float order : {-2.0F, -1.0F, 1.0F, 2.0F})
            pattern->points.push_back(
                {glm::vec2(order * static_cast<float>(per_order) * (1.0F + t), 0.0F), 0.15F / kPoints * weight});
    }
    return pattern;
}

/// The promise of glare.h, summed over all pixels and points with a Gaussian for the grid's blur.
std::vector<glm::dvec3> summed(const GlareScene& scene, const GlareSettings& settings) {
    const glm::dvec2 half(scene.tan_half() * scene.size.x / scene.size.y, scene.tan_half());
    const glm::dmat2 turn(std::cos(settings.angle), std::sin(settings.angle), -std::sin(settings.angle),
                          std::cos(settings.angle));
    glm::dvec2 reach(0.0);
    for (const auto& point : settings.pattern->points)
        reach = glm::max(reach, glm::abs(turn * glm::dvec2(point.offset)));
    const double cell = post::glare_grid(scene.size, half, reach).cell;
    const double variance = 3.0 * 0.25 * cell * cell;
    constexpr int kReach = 12;  ///< pixels to which the blur matters
    std::vector<glm::dvec3> out;
    scene.for_each([&](glm::ivec2 at) {
        const glm::dvec3 here(scene.pixels[scene.index(at)]);
        out.push_back(glm::dmat3(settings.pattern->straight) * here);
    });
    scene.for_each([&](glm::ivec2 from) {
        const glm::dvec3 light(scene.pixels[scene.index(from)]);
        if (light.r + light.g + light.b < 1e-2) return;
        const glm::dvec2 cosines = scene.cosines(from);
        const double factor = scene.area(from) / (2.0 * std::numbers::pi * variance);
        for (const auto& point : settings.pattern->points) {
            const glm::dvec2 seen = cosines + turn * glm::dvec2(point.offset);
            const glm::dvec3 colour = factor * (glm::dmat3(point.weight) * light);
            const glm::ivec2 centre(glm::floor(scene.pixel_of(seen)));
            for (int y = std::max(centre.y - kReach, 0); y < std::min(centre.y + kReach, scene.size.y); ++y) {
                for (int x = std::max(centre.x - kReach, 0); x < std::min(centre.x + kReach, scene.size.x); ++x) {
                    const glm::dvec2 beside = scene.cosines({x, y}) - seen;
                    out[scene.index({x, y})] += std::exp(-0.5 * glm::dot(beside, beside) / variance) * colour;
                }
            }
        }
    });
    return out;
}

class GlarePassTest : public test::PostTest {
 protected:
    std::vector<glm::vec4> draw(const GlareScene& scene, const GlareSettings& settings) {
        const gpu::Framebuffer drawn = target(scene.size);
        pass_.draw(picture(scene.pixels, scene.size), settings, settings.threshold, drawn);
        return drawn.colour().read();
    }
    /// A pattern of one point that moves all light.
    static GlareSettings moving_by(glm::vec2 offset, float vertical_fov) {
        auto pattern = std::make_shared<GlarePattern>();
        pattern->straight = glm::mat3(0.0F);
        pattern->points = {{offset, glm::mat3(1.0F)}};
        return {.pattern = pattern, .vertical_fov = vertical_fov, .threshold = 0.0F};
    }

    post::GlarePass pass_{library_};
};

TEST_F(GlarePassTest, AgreesWithTheSumOverAllPixelsAndPoints) {
    for (const glm::ivec2 size : {glm::ivec2(90, 50), glm::ivec2(51, 64)}) {  // one pass, two sizes
        GlareScene scene(size, 0.9F);
        scene.add_spot(glm::dvec2(size) * 0.45, 2.5, {300.0F, 250.0F, 200.0F});
        scene.add_spot(glm::dvec2(size) * glm::dvec2(0.8, 0.2), 2.5, {20.0F, 90.0F, 150.0F});
        const GlareSettings settings{
            .pattern = two_orders(0.1), .vertical_fov = 0.9F, .angle = 0.4F, .threshold = 0.0F};
        const std::vector<glm::vec4> drawn = draw(scene, settings);
        const std::vector<glm::dvec3> expected = summed(scene, settings);
        double brightest = 0.0;
        double worst = 0.0;
        scene.for_each([&](glm::ivec2 at) {
            const std::size_t i = scene.index(at);
            const glm::dvec3 glare = expected[i] - 0.3 * glm::dvec3(scene.pixels[i]);
            for (int c = 0; c < 3; ++c) {
                brightest = std::max(brightest, glare[c]);
                worst = std::max(worst, std::abs(drawn[i][c] - expected[i][c]));
            }
        });
        // The grid's blur is not quite a Gaussian.
        EXPECT_LE(worst, 0.02 * brightest) << size.x;
    }
}

TEST_F(GlarePassTest, PutsEachWavelengthOnItsPixel) {
    constexpr double kPitch_nm = 2000.0;
    for (const float fov : {0.4F, 1.1F}) {
        GlareScene scene({240, 135}, fov);
        const glm::dvec2 lamp(70.0, 40.0);
        scene.add_spot(lamp, 1.5, glm::vec3(100.0F));
        for (const double order : {-1.0, 1.0, 2.0}) {
            for (const double wavelength_nm : {450.0, 550.0, 650.0}) {
                const glm::dvec2 offset = order * wavelength_nm / kPitch_nm * glm::dvec2(0.8, 0.6);
                const glm::dvec2 expected = scene.pixel_of(scene.cosines(lamp) + offset);
                if (expected.x < 8.0 || expected.y < 8.0 || expected.x > 231.0 || expected.y > 126.0) continue;
                const std::vector<glm::vec4> drawn = draw(scene, moving_by(offset, fov));
                glm::dvec2 centroid(0.0);
                double sum = 0.0;
                scene.for_each([&](glm::ivec2 at) {
                    const double light = scene.area(at) * static_cast<double>(drawn[scene.index(at)].g);
                    centroid += light * scene.cosines(at);
                    sum += light;
                });
                centroid = scene.pixel_of(centroid / sum);
                EXPECT_LE(glm::length(centroid - expected), 0.2)
                    << fov << " " << order << " " << wavelength_nm << " at " << centroid.x << ", " << centroid.y;
            }
        }
    }
}

TEST_F(GlarePassTest, KeepsEnergyWhereNothingLeaves) {
    for (const float fov : {0.5F, 1.2F}) {
        GlareScene scene({160, 90}, fov);
        scene.add_spot({36.3, 21.6}, 0.6, {1000.0F, 700.0F, 400.0F});
        auto pattern = two_orders(0.02);
        const std::vector<glm::vec4> drawn = draw(scene, {.pattern = pattern, .vertical_fov = fov, .threshold = 0.0F});
        glm::mat3 passed = pattern->straight;
        for (const auto& point : pattern->points) passed += point.weight;
        const glm::dvec3 expected = glm::dmat3(passed) * scene.energy(scene.pixels);
        const glm::dvec3 energy = scene.energy(drawn);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(energy[c] / expected[c], 1.0, 0.01) << fov << " " << c;
    }
}

TEST_F(GlarePassTest, WhatLeavesThePictureIsLost) {
    GlareScene scene({160, 90}, 0.7F);
    scene.add_spot({150.0, 45.0}, 1.0, glm::vec3(1e4F));
    // To the right of the picture, where a transform without room would bring it back on the left.
    for (const float offset : {0.2F, 0.3F, 0.6F, 1.2F, 1.9F}) {
        const std::vector<glm::vec4> drawn = draw(scene, moving_by({offset, 0.0F}, 0.7F));
        for (const glm::vec4& pixel : drawn) ASSERT_LE(std::abs(pixel.r), 1e-3F) << offset;
    }
}

TEST_F(GlarePassTest, AMovingLampOfLessThanAPixelDoesNotFlicker) {
    const GlareSettings settings{.pattern = two_orders(0.06), .vertical_fov = 0.7F, .threshold = 0.0F};
    double least = std::numeric_limits<double>::max();
    double most = 0.0;
    float dimmest = std::numeric_limits<float>::max();
    float brightest = 0.0F;
    for (int step = 0; step < 16; ++step) {
        GlareScene scene({160, 90}, 0.7F);
        // A renderer divides a small lamp among the pixels that it covers.
        const glm::dvec2 lamp(79.0 + step / 8.0, 44.0 + step / 13.0);
        const glm::dvec2 low = glm::floor(lamp);
        const glm::dvec2 part = lamp - low;
        for (int corner = 0; corner < 4; ++corner) {
            const glm::ivec2 beside(corner % 2, corner / 2);
            const double weight = (beside.x == 1 ? part.x : 1.0 - part.x) * (beside.y == 1 ? part.y : 1.0 - part.y);
            scene.pixels[scene.index(glm::ivec2(low) + beside)] =
                glm::vec4(glm::vec3(static_cast<float>(weight * 1e4)), 1.0F);
        }
        const std::vector<glm::vec4> drawn = draw(scene, settings);
        const double energy = scene.energy(drawn).g;
        least = std::min(least, energy);
        most = std::max(most, energy);
        float peak = 0.0F;
        scene.for_each([&](glm::ivec2 at) {
            if (std::abs(at.x - lamp.x) > 6.0) peak = std::max(peak, drawn[scene.index(at)].g);
        });
        dimmest = std::min(dimmest, peak);
        brightest = std::max(brightest, peak);
    }
    EXPECT_LE(most / least, 1.02);
    // A pixel is half a cell: a lamp on the corner of four is wider than one in the middle of one.
    EXPECT_LE(brightest / dimmest, 1.15F);
}

TEST_F(GlarePassTest, AStreakHasNoBeads) {
    GlareScene scene({320, 180}, 0.7F);
    scene.pixels[scene.index({160, 90})] = {1e4F, 1e4F, 1e4F, 1.0F};
    auto pattern = std::make_shared<GlarePattern>();
    for (int i = 0; i < 400; ++i)
        pattern->points.push_back(
            {(0.05F + 0.0005F * static_cast<float>(i)) * glm::vec2(0.95F, 0.17F), glm::mat3(1.0F / 400.0F)});
    const auto drawn = draw(scene, {.pattern = pattern, .vertical_fov = 0.7F, .threshold = 0.0F});
    float dimmest = std::numeric_limits<float>::max();
    float brightest = 0.0F;
    for (int x = 178; x < 212; ++x) {
        float peak = 0.0F;
        for (int y = 0; y < 180; ++y) peak = std::max(peak, drawn[scene.index({x, y})].g);
        dimmest = std::min(dimmest, peak);
        brightest = std::max(brightest, peak);
    }
    EXPECT_LE(brightest / dimmest, 1.12F);
}

TEST_F(GlarePassTest, LightBelowTheThresholdStays) {
    GlareScene scene({64, 48}, 0.7F);
    for (glm::vec4& pixel : scene.pixels) pixel = {0.9F, 0.25F, -0.1F, 0.5F};
    const auto drawn = draw(scene, {.pattern = two_orders(0.1), .vertical_fov = 0.7F, .threshold = 1.0F});
    EXPECT_EQ(drawn, scene.pixels);
    // Above it, the light above it is what is diffracted.
    scene.pixels[scene.index({30, 20})] = {4.0F, 2.0F, 1.0F, 0.5F};
    GlareScene above({64, 48}, 0.7F);
    above.pixels[above.index({30, 20})] = {3.0F, 1.5F, 0.75F, 0.5F};
    const auto with_rest = draw(scene, {.pattern = two_orders(0.1), .vertical_fov = 0.7F, .threshold = 1.0F});
    const auto alone = draw(above, {.pattern = two_orders(0.1), .vertical_fov = 0.7F, .threshold = 0.0F});
    for (std::size_t i = 0; i < alone.size(); ++i) {
        const glm::vec3 rest = glm::vec3(scene.pixels[i]) - glm::vec3(above.pixels[i]);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(with_rest[i][c], alone[i][c] + rest[c], 1e-5F);
    }
}

TEST_F(GlarePassTest, WhatIsNotFiniteDoesNotSpread) {
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    const GlareSettings settings{.pattern = two_orders(0.1), .vertical_fov = 0.7F, .threshold = 0.0F};
    GlareScene bad({64, 48}, 0.7F);
    GlareScene mended = bad;
    bad.pixels[1000] = {std::numeric_limits<float>::quiet_NaN(), kInfinite, 1e9F, 1.0F};
    bad.pixels[40] = {glm::vec3(-kInfinite), 1.0F};
    mended.pixels[1000] = {0.0F, 0.0F, 65504.0F, 1.0F};
    const auto drawn = draw(bad, settings);
    EXPECT_EQ(drawn, draw(mended, settings));
    for (const glm::vec4& pixel : drawn)
        for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(pixel[c]));
}

TEST_F(GlarePassTest, LightBeyondHalfFloatsStaysFinite) {
    GlareScene sun({64, 48}, 0.7F);
    for (int x = 20; x < 40; ++x)
        for (int y = 20; y < 30; ++y) sun.pixels[sun.index({x, y})] = glm::vec4(glm::vec3(65504.0F), 1.0F);
    GlareSettings twice = moving_by({0.0F, 0.0F}, 0.7F);
    auto pattern = std::make_shared<GlarePattern>(*twice.pattern);
    pattern->straight = glm::mat3(1.0F);
    twice.pattern = pattern;
    EXPECT_EQ(draw(sun, twice)[sun.index({30, 25})], glm::vec4(glm::vec3(65504.0F), 1.0F));
}

}  // namespace

}  // namespace rowland
