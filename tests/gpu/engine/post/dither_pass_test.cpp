#include "engine/post/display_pass.h"

#include <algorithm>
#include <cmath>

#include "engine/post/post_stack.h"
#include "tests/gpu/gl_test.h"
#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland {

namespace {

const glm::ivec2 kSize(256, 16);
constexpr int area = 16;

/// A slow gradient: four 8-bit steps over 256 pixels, that is one band per 64.
float gradient(int x) {
    return (80.0F + static_cast<float>(x) / 64.0F) / 255.0F;
}

std::vector<glm::vec4> gradient_picture() {
    std::vector<glm::vec4> pixels;
    for (int y = 0; y < kSize.y; ++y) {
        for (int x = 0; x < kSize.x; ++x) pixels.emplace_back(glm::vec3(gradient(x)), 0.4F);
    }
    return pixels;
}

/// How far the mean over a square of the picture is from the gradient's at most, in 8-bit steps.
double worst_area(const std::vector<std::uint8_t>& bytes) {
    double worst = 0.0;
    for (int left = 0; left + area <= kSize.x; ++left) {
        double difference = 0.0;
        for (int y = 0; y < area; ++y) {
            for (int x = left; x < left + area; ++x) {
                difference += bytes[static_cast<std::size_t>(4 * (y * kSize.x + x))] - 255.0 * gradient(x);
            }
        }
        worst = std::max(worst, std::abs(difference) / (area * area));
    }
    return worst;
}

class DitherPassTest : public test::GlTest {
 protected:
    DitherPassTest() {
        library_.add_embedded(post::shader_files());
        source_ = gpu::Texture({.format = gpu::Format::RGBA32F, .width = kSize.x, .height = kSize.y});
        source_.upload(std::span<const glm::vec4>(gradient_picture()));
    }

    static gpu::Framebuffer target(gpu::Format format) {
        return gpu::Framebuffer({.width = kSize.x, .height = kSize.y, .colours = {format}});
    }

    gpu::ShaderLibrary library_;
    gpu::Texture source_;
};

TEST_F(DitherPassTest, AgreesWithTheCpu) {
    const post::DitherPass pass(library_);
    const gpu::Framebuffer drawn_to = target(gpu::Format::RGBA32F);
    for (const std::uint32_t frame : {0U, 9U, 4000000000U}) {
        const std::vector<glm::vec4> picture = gradient_picture();
        std::vector<glm::vec3> expected(picture.begin(), picture.end());
        post::apply_dither(expected, kSize, frame, {.bits = 6});
        pass.draw(source_, frame, {.bits = 6}, drawn_to);
        const std::vector<glm::vec4> drawn = drawn_to.colour().read();
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            EXPECT_NEAR(drawn[i].g, expected[i].g, 1e-7F) << i;  // one rounding of a product and a sum near 0.3
            EXPECT_EQ(drawn[i].a, 0.4F);
        }
    }
}

TEST_F(DitherPassTest, AnEightBitGradientHasNoBands) {
    const post::DitherPass pass(library_);
    const gpu::Framebuffer bytes = target(gpu::Format::RGBA8);
    for (const std::uint32_t frame : {0U, 1U, 2U}) {
        pass.draw(source_, frame, {}, bytes);
        const double worst = worst_area(bytes.read_rgba8());
        EXPECT_LE(worst, 0.05) << frame;
        RecordProperty("worst_area_steps", std::to_string(worst));
    }
    // Noise so fine that it does nothing shows the bands: the measure can tell.
    pass.draw(source_, 0, {.bits = 12}, bytes);
    EXPECT_GT(worst_area(bytes.read_rgba8()), 0.25);
}

}  // namespace

}  // namespace rowland
