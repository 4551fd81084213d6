#include "engine/post/bloom.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/post/post_stack.h"
#include "tests/gpu/gl_test.h"
#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland {

namespace {

using post::BloomSettings;

std::vector<glm::vec4> random_picture(glm::ivec2 size) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<glm::vec4> pixels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (glm::vec4& pixel : pixels) {
        for (int c = 0; c < 4; ++c) pixel[c] = uniform(random);
    }
    return pixels;
}

class BloomPassTest : public test::GlTest {
 protected:
    BloomPassTest() { library_.add_embedded(post::shader_files()); }

    /// Rows as they lie in textures.
    static std::vector<glm::vec4> draw(post::BloomPass& pass, const std::vector<glm::vec4>& pixels, glm::ivec2 size,
                                       const BloomSettings& settings, gpu::Format format) {
        gpu::Texture source({.format = gpu::Format::RGBA32F, .width = size.x, .height = size.y});
        source.upload(std::span<const glm::vec4>(pixels));
        const gpu::Framebuffer target({.width = size.x, .height = size.y, .colours = {format}});
        pass.draw(source, settings, target);
        return target.colour().read();
    }

    /// How far the sum of any channel moves, relative to it.
    double change_of_light(const std::vector<glm::vec4>& pixels, glm::ivec2 size, int levels) {
        post::BloomPass pass(library_);
        const auto drawn = draw(pass, pixels, size, {.strength = 1.0F, .levels = levels}, gpu::Format::RGBA16F);
        glm::dvec3 before(0.0);
        glm::dvec3 after(0.0);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            before += glm::dvec3(pixels[i]);
            after += glm::dvec3(drawn[i]);
        }
        const glm::dvec3 change = glm::abs(after / before - 1.0);
        return std::max(change.r, std::max(change.g, change.b));
    }

    gpu::ShaderLibrary library_;
};

TEST_F(BloomPassTest, AgreesWithTheCpu) {
    post::BloomPass pass(library_);
    double worst = 0.0;
    for (const glm::ivec2 size : {glm::ivec2(64, 32), glm::ivec2(37, 23), glm::ivec2(5, 1), glm::ivec2(1, 1)}) {
        for (const int levels : {1, 3, 6}) {
            const BloomSettings settings{.strength = 0.75F, .levels = levels};
            const std::vector<glm::vec4> pixels = random_picture(size);
            std::vector<glm::vec3> expected(pixels.begin(), pixels.end());
            post::apply_bloom(expected, size, settings);
            const auto drawn = draw(pass, pixels, size, settings, gpu::Format::RGBA32F);
            // Light and area are each rounded to halves (half a step: 2^-12 of a value) on the way down, values on the
            // way up; nothing is negative, so relative errors add at most.
            const float tolerance = 3.0F * static_cast<float>(levels) * std::exp2(-11.0F);
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(drawn[i][c], expected[i][c], tolerance * expected[i][c]) << size.x << " " << i;
                    worst = std::max(worst, std::abs(static_cast<double>(drawn[i][c]) / expected[i][c] - 1.0));
                }
                EXPECT_EQ(drawn[i].a, pixels[i].a);
            }
        }
    }
    RecordProperty("worst_relative", fmt::format("{}", worst));
}

// The promise of the header: 1e-3 with all textures RGBA16F.
TEST_F(BloomPassTest, KeepsTheLightOfARandomPictureInHalfFloats) {
    for (const glm::ivec2 size : {glm::ivec2(256, 128), glm::ivec2(201, 133)}) {
        for (const int levels : {1, 4, 8}) {
            const double change = change_of_light(random_picture(size), size, levels);
            EXPECT_LE(change, 1e-3) << size.x << " " << levels;
            RecordProperty(fmt::format("change_{}_{}", size.x, levels), fmt::format("{}", change));
        }
    }
}

TEST_F(BloomPassTest, KeepsTheLightOfAVeryBrightPixelInHalfFloats) {
    const glm::ivec2 size(201, 133);
    for (const glm::ivec2 place : {glm::ivec2(100, 60), glm::ivec2(0, 0), glm::ivec2(200, 132), glm::ivec2(199, 50)}) {
        std::vector<glm::vec4> pixels(static_cast<std::size_t>(size.x * size.y), glm::vec4(0.0F));
        pixels[static_cast<std::size_t>(place.y * size.x + place.x)] = glm::vec4(1e4F);
        const double change = change_of_light(pixels, size, 6);
        EXPECT_LE(change, 1e-3) << place.x << " " << place.y;
        RecordProperty(fmt::format("change_{}_{}", place.x, place.y), fmt::format("{}", change));
    }
}

TEST_F(BloomPassTest, WhatIsNotFiniteDoesNotSpread) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const glm::ivec2 size(9, 9);
    std::vector<glm::vec4> bad(81, glm::vec4(1.0F));
    std::vector<glm::vec4> mended = bad;
    bad[40] = {std::numeric_limits<float>::quiet_NaN(), infinity, 1e9F, 1.0F};
    bad[3] = {glm::vec3(-infinity), 1.0F};
    mended[40] = {0.0F, 0.0F, 65504.0F, 1.0F};
    mended[3] = {0.0F, 0.0F, 0.0F, 1.0F};
    post::BloomPass pass(library_);
    const BloomSettings settings{.strength = 0.5F};
    const auto drawn = draw(pass, bad, size, settings, gpu::Format::RGBA32F);
    EXPECT_EQ(drawn, draw(pass, mended, size, settings, gpu::Format::RGBA32F));
    for (const glm::vec4& pixel : drawn) EXPECT_LE(std::abs(pixel.r), 1.0F);
}

TEST_F(BloomPassTest, TakesTwoPassesPerLevel) {
    post::BloomPass pass(library_);
    const glm::ivec2 size(16, 8);
    for (const int levels : {1, 3, 4}) {
        (void)draw(pass, random_picture(size), size, {.levels = levels}, gpu::Format::RGBA16F);
        EXPECT_EQ(pass.passes(), 2 * levels);
    }
    (void)draw(pass, random_picture(size), size, {.levels = 30}, gpu::Format::RGBA16F);
    EXPECT_EQ(pass.passes(), 8);  // 16 × 8 is one texel after four halvings
}

}  // namespace

}  // namespace rowland
