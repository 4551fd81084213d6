// The depth of field on pictures whose blur is known.
#include "engine/post/depth_of_field.h"

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "tests/gpu/engine/post/post_test.h"

namespace rowland {
namespace {

using post::DepthOfFieldSettings;
using post::LensView;

class DepthOfFieldTest : public test::PostTest {
 protected:
    static constexpr glm::ivec2 kSize{160, 120};
    static constexpr LensView kView{.vertical_fov = 0.6F, .near_plane = 0.05F, .far_plane = 50.0F, .target_m = 1.0F};

    static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kSize.x + x); }
    /// What a depth buffer holds.
    static float depth_of(float distance_m) {
        const float n = kView.near_plane;
        const float f = kView.far_plane;
        return f * (distance_m - n) / (distance_m * (f - n));
    }
    std::vector<glm::vec4> draw(const std::vector<glm::vec4>& pixels, const std::vector<float>& distances,
                                const DepthOfFieldSettings& settings) {
        std::vector<float> values;
        for (const float distance : distances) values.push_back(depth_of(distance));
        const gpu::Framebuffer drawn = target(kSize);
        gpu::Texture depth({.format = gpu::Format::R32F, .width = kSize.x, .height = kSize.y});
        depth.upload(std::span<const float>(values));
        pass_.draw(picture(pixels, kSize), depth, settings, kView, drawn);
        return drawn.colour().read();
    }
    static double sum(const std::vector<glm::vec4>& pixels) {
        double total = 0.0;
        for (const glm::vec4& pixel : pixels) total += pixel.r;
        return total;
    }
    static std::vector<glm::vec4> even(float value) {
        return std::vector<glm::vec4>(count(kSize), {value, value, value, 0.5F});
    }

    post::DepthOfFieldPass pass_{library_};
};

TEST_F(DepthOfFieldTest, BlursByTheThinLensFormula) {
    // As the image of the point lies before or behind the sensor, by similar triangles.
    const DepthOfFieldSettings settings{.f_number = 2.0F};
    const float focal_length = 0.012F / std::tan(0.3F);
    const float aperture = focal_length / 2.0F;
    const float image_of_focus = 1.0F / (1.0F / focal_length - 1.0F);
    for (const float distance : {0.5F, 2.0F, 20.0F}) {
        const float image = 1.0F / (1.0F / focal_length - 1.0F / distance);
        const float across = aperture * (image_of_focus - image) / image;
        EXPECT_NEAR(post::blur_radius(settings, kView, distance), 0.5F * across / 0.024F, 1e-5F) << distance;
    }
    EXPECT_EQ(post::blur_radius(settings, kView, 1.0F), 0.0F);
}

TEST_F(DepthOfFieldTest, WhatIsInFocusStaysAsItIs) {
    std::vector<glm::vec4> pixels = even(0.2F);
    pixels[index(40, 50)] = {7.0F, 3.0F, 1.0F, 0.25F};
    EXPECT_EQ(draw(pixels, std::vector<float>(pixels.size(), 1.0F), {.f_number = 1.4F}), pixels);
}

TEST_F(DepthOfFieldTest, APointBecomesADiscOfItsEnergy) {
    std::vector<glm::vec4> pixels = even(0.0F);
    const glm::ivec2 at(80, 60);
    pixels[index(at.x, at.y)] = {1000.0F, 1000.0F, 1000.0F, 0.5F};
    const DepthOfFieldSettings settings{.f_number = 0.5F, .most_blur = 0.1F};
    for (const float distance : {0.6F, 4.0F}) {
        const auto drawn = draw(pixels, std::vector<float>(pixels.size(), distance), settings);
        const double radius = std::abs(post::blur_radius(settings, kView, distance)) * kSize.y;
        ASSERT_GT(radius, 3.0);
        ASSERT_LT(radius, 12.0);
        // Samples fill a disc in steps of an eighth of its radius.
        EXPECT_NEAR(sum(drawn), 1000.0, 100.0) << radius;
        double beyond = 0.0;
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x)
                if (std::hypot(x - at.x, y - at.y) > 1.35 * radius + 1.0) beyond += drawn[index(x, y)].r;
        EXPECT_LT(beyond, 10.0) << radius;
        const double middle = 1000.0 / (std::numbers::pi * radius * radius);
        EXPECT_NEAR(drawn[index(at.x + static_cast<int>(0.4 * radius), at.y)].r, middle, 0.5 * middle) << radius;
        EXPECT_EQ(drawn[index(at.x, at.y)].a, 0.5F);
    }
}

/// The left half is a bright wall far away, the right half a dark thing in focus before it.
TEST_F(DepthOfFieldTest, ASharpEdgeBeforeABlurredWallStaysSharp) {
    std::vector<glm::vec4> pixels = even(0.1F);
    std::vector<float> distances(pixels.size(), 1.0F);
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x / 2; ++x) {
            pixels[index(x, y)] = glm::vec4(glm::vec3(5.0F), 1.0F);
            distances[index(x, y)] = 10.0F;
        }
    const auto drawn = draw(pixels, distances, {.f_number = 0.5F, .most_blur = 0.1F});
    EXPECT_NEAR(drawn[index(kSize.x / 2 + 3, 60)].r, 0.1F, 0.02F);
    EXPECT_NEAR(drawn[index(kSize.x / 2 - 4, 60)].r, 5.0F, 0.5F);
    // The same thing out of focus before the wall in focus is spread over it.
    for (float& distance : distances) distance = distance == 10.0F ? 1.0F : 0.4F;
    const auto spread = draw(pixels, distances, {.f_number = 0.5F, .most_blur = 0.1F});
    const float covered = spread[index(kSize.x / 2 - 5, 60)].r;
    EXPECT_GT(covered, 1.0F);
    EXPECT_LT(covered, 4.5F);
}

}  // namespace
}  // namespace rowland
