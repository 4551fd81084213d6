// Passes round what they draw into half floats, as drivers may truncate.
#include <random>

#include "engine/post/bloom.h"
#include "engine/post/shader_files.h"
#include "engine/post/vignette.h"
#include "tests/gpu/gl_test.h"
#include "tests/gpu/wide_halves.h"

namespace rowland {
namespace {

class HalfFloatPassTest : public test::GlTest {
 protected:
    static constexpr int kSide = 16;

    HalfFloatPassTest() {
        library_.add_embedded(post::shader_files());
        std::mt19937 random(5);
        std::uniform_real_distribution<float> uniform(0.1F, 1.0F);
        std::vector<glm::vec4> texels(std::size_t{kSide} * kSide);
        for (glm::vec4& texel : texels) texel = {uniform(random), uniform(random), uniform(random), 1.0F};
        source_ = gpu::Texture({.format = gpu::Format::RGBA32F, .width = kSide, .height = kSide});
        source_.upload(std::span<const glm::vec4>(texels));
    }
    /// What is left for the driver to round.
    template <typename Draw>
    static void expect_rounded(const Draw& draw) {
        const test::WideHalves wide;
        const gpu::Framebuffer halves({.width = kSide, .height = kSide, .colours = {gpu::Format::RGBA16F}});
        draw(halves);
        EXPECT_EQ(test::not_halves(halves.read_rgba_float()), 0);
        const gpu::Framebuffer floats({.width = kSide, .height = kSide, .colours = {gpu::Format::RGBA32F}});
        draw(floats);
        EXPECT_GT(test::not_halves(floats.read_rgba_float()), kSide * kSide);
    }

    gpu::ShaderLibrary library_;
    gpu::Texture source_;
};

TEST_F(HalfFloatPassTest, BloomRounds) {
    post::BloomPass pass(library_);
    expect_rounded([&](const gpu::Framebuffer& target) { pass.draw(source_, {.strength = 0.3F}, target); });
}

TEST_F(HalfFloatPassTest, VignetteRounds) {
    const post::VignettePass pass(library_);
    expect_rounded([&](const gpu::Framebuffer& target) { pass.draw(source_, {.vertical_fov = 1.0F}, target); });
}

}  // namespace
}  // namespace rowland
