#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/gpu/engine/post/post_test.h"
#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland {
namespace {

using post::PostFrame;
using post::PostSettings;

const PostSettings every_effect{.bloom = post::BloomSettings{.strength = 0.3F, .levels = 3},
                                .auto_exposure = post::AutoExposureSettings{},
                                .exposure_stops = 0.5F,
                                .vignette = post::VignetteSettings{.vertical_fov = 0.9F, .strength = 0.4F},
                                .dither = post::DitherSettings{}};

/// All light moves.
post::GlareSettings glare_by(glm::vec2 offset) {
    auto pattern = std::make_shared<post::GlarePattern>();
    pattern->straight = glm::mat3(0.0F);
    pattern->points = {{offset, glm::mat3(1.0F)}};
    return {.pattern = pattern};
}

class PostStackTest : public test::PostTest {
 protected:
    static gpu::Texture random_picture(glm::ivec2 size, gpu::Format format = gpu::Format::RGBA16F) {
        std::mt19937 random(23);
        std::uniform_real_distribution<float> uniform(0.01F, 2.0F);
        std::vector<glm::vec4> pixels(static_cast<std::size_t>(size.x * size.y), glm::vec4(1.0F));
        for (glm::vec4& pixel : pixels)
            for (int c = 0; c < 3; ++c) pixel[c] = uniform(random);
        return picture(pixels, size, format);
    }
    static gpu::Texture plain_picture(float value) {
        return picture(std::vector<glm::vec4>(256, {glm::vec3(value), 1.0F}), {16, 16}, gpu::Format::RGBA16F);
    }
    PostFrame frame(float seconds = 0.0F) const { return {.seconds = seconds, .luminance_weights = weights_}; }

    post::DisplayTransform transform_{post::OcioConfig::shipped(), {"", "ACES 1.0 - SDR Video"}};
    post::DisplayPass display_{library_, transform_};
    glm::vec3 weights_ = post::luminance_weights(post::OcioConfig::shipped());
};

TEST_F(PostStackTest, WithAllEffectsOffItIsTheDisplayPassAlone) {
    const glm::ivec2 size(40, 30);
    const gpu::Texture hdr = random_picture(size);
    const gpu::Framebuffer drawn = target(size, gpu::Format::RGBA8);
    post::PostStack stack(library_);
    stack.draw(hdr, display_, {.exposure_stops = 1.25F}, {}, drawn);
    EXPECT_EQ(stack.passes(), 1);
    EXPECT_EQ(stack.exposure_stops(), 1.25F);

    const gpu::Framebuffer expected = target(size, gpu::Format::RGBA8);
    display_.draw(hdr, 1.25F, expected);
    EXPECT_EQ(drawn.read_rgba8(), expected.read_rgba8());
}

TEST_F(PostStackTest, EffectsThatChangeNothingRunNoPass) {
    const gpu::Framebuffer drawn = target({16, 16}, gpu::Format::RGBA8);
    post::PostStack stack(library_);
    stack.draw(plain_picture(0.5F), display_,
               {.glare = post::GlareSettings{.pattern = std::make_shared<post::GlarePattern>()},
                .bloom = post::BloomSettings{.strength = 0.0F},
                .vignette = post::VignetteSettings{}},
               {}, drawn);
    EXPECT_EQ(stack.passes(), 1);
}

TEST_F(PostStackTest, EveryEffectAddsItsPasses) {
    const glm::ivec2 size(40, 30);
    const gpu::Texture hdr = random_picture(size);
    const gpu::Framebuffer drawn = target(size, gpu::Format::RGBA8);
    post::PostStack stack(library_);
    const auto passes = [&](const PostSettings& settings) {
        stack.draw(hdr, display_, settings, frame(), drawn);
        return stack.passes();
    };
    EXPECT_EQ(passes({.glare = glare_by({0.1F, 0.0F})}), 1 + 5);
    EXPECT_EQ(passes({.bloom = every_effect.bloom}), 1 + 2 * 3);
    EXPECT_EQ(passes({.auto_exposure = every_effect.auto_exposure}), 1 + 2);  // 40 × 30 → 5 × 4 → 1
    EXPECT_EQ(passes({.vignette = every_effect.vignette}), 1 + 1);
    EXPECT_EQ(passes({.dither = every_effect.dither}), 1 + 1);
    EXPECT_EQ(passes({.grain = post::GrainSettings{}}), 1 + 1);
    EXPECT_EQ(passes({.grain = post::GrainSettings{}, .dither = every_effect.dither}), 1 + 1);
    EXPECT_EQ(passes(every_effect), 1 + 6 + 2 + 1 + 1);
    EXPECT_EQ(passes({}), 1);
}

TEST_F(PostStackTest, AgreesWithTheEffectsOnTheCpuInTheirOrder) {
    post::PostStack stack(library_);
    float worst = 0.0F;
    for (const glm::ivec2 size : {glm::ivec2(40, 30), glm::ivec2(27, 53)}) {  // one stack, two sizes
        const gpu::Texture hdr = random_picture(size, gpu::Format::RGBA32F);
        const gpu::Framebuffer drawn_to = target(size, gpu::Format::RGBA32F);
        stack.draw(hdr, display_, every_effect, frame(), drawn_to);
        const std::vector<glm::vec4> drawn = drawn_to.colour().read();

        const std::vector<glm::vec4> pixels = hdr.read();
        std::vector<glm::vec3> expected(pixels.begin(), pixels.end());
        post::apply_bloom(expected, size, *every_effect.bloom);
        const double mean = *post::mean_log2_luminance(expected, weights_, every_effect.auto_exposure->darkest);
        const float stops = 0.5F + post::target_stops(mean, *every_effect.auto_exposure);
        post::apply_exposure(expected, stops);
        post::apply_vignette(expected, size, *every_effect.vignette);
        transform_.apply_cpu(expected);
        for (glm::vec3& value : expected) value = glm::clamp(value, 0.0F, 1.0F);
        post::apply_dither(expected, size, 0, *every_effect.dither);

        EXPECT_NEAR(stack.exposure_stops(), stops, 1e-3F);
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                // Bloom's half floats: 0.3 · 9 · 2^-11 = 1.3e-3 of the light at most; on this transform's curve a
                // display value changes by at most 0.3 when light changes by a factor of e. Then the transform's own
                // 1e-4.
                worst = std::max(worst, std::abs(drawn[i][c] - expected[i][c]));
                EXPECT_NEAR(drawn[i][c], expected[i][c], 5e-4F) << size.x << " " << i;
            }
        }
        stack.forget_exposure();
    }
}

TEST_F(PostStackTest, AutomaticExposureShowsAnEvenPictureAsMidGrey) {
    const gpu::Framebuffer drawn = target({16, 16}, gpu::Format::RGBA32F);
    post::PostStack stack(library_);
    const PostSettings settings{.auto_exposure = post::AutoExposureSettings{}};
    for (const float value : {0.02F, 0.5F, 7.0F}) {
        stack.forget_exposure();
        stack.draw(plain_picture(value), display_, settings, frame(), drawn);
        // What the ACES output transform shows for 0.18; the half float and the transform each add some 1e-4.
        EXPECT_NEAR(drawn.read_rgba_float()[0].g, 0.35595F, 3e-4F) << value;
    }
}

TEST_F(PostStackTest, AutomaticExposureThatWaitsAdaptsToThePictureItself) {
    const gpu::Framebuffer drawn = target({16, 16}, gpu::Format::RGBA8);
    const PostSettings settings{.auto_exposure = post::AutoExposureSettings{.speed_down = 2.0F},
                                .wait_for_exposure = true};
    post::PostStack stack(library_);
    stack.draw(plain_picture(0.125F), display_, settings, frame(1.0F), drawn);
    const float dark = stack.exposure_stops();
    EXPECT_NEAR(dark, std::log2(0.18F / 0.125F), 1e-3F);
    // Three stops brighter: what is missing shrinks by exp(-2 · 0.25) in every frame.
    stack.draw(plain_picture(1.0F), display_, settings, frame(0.25F), drawn);
    EXPECT_NEAR(stack.exposure_stops(), dark - 3.0F * (1.0F - std::exp(-0.5F)), 1e-3F);
    stack.draw(plain_picture(1.0F), display_, settings, frame(0.25F), drawn);
    EXPECT_NEAR(stack.exposure_stops(), dark - 3.0F * (1.0F - std::exp(-1.0F)), 1e-3F);
    // Nothing to measure: it stays.
    const float before = stack.exposure_stops();
    stack.draw(plain_picture(std::numeric_limits<float>::quiet_NaN()), display_, settings, frame(0.25F), drawn);
    EXPECT_EQ(stack.exposure_stops(), before);
    stack.forget_exposure();
    stack.draw(plain_picture(1.0F), display_, settings, frame(0.25F), drawn);
    EXPECT_NEAR(stack.exposure_stops(), dark - 3.0F, 1e-3F);
    // Turned off and on again it starts afresh.
    stack.draw(plain_picture(0.125F), display_, {}, frame(0.25F), drawn);
    EXPECT_EQ(stack.exposure_stops(), 0.0F);
    stack.draw(plain_picture(0.125F), display_, settings, frame(0.25F), drawn);
    EXPECT_NEAR(stack.exposure_stops(), dark, 1e-3F);
}

TEST_F(PostStackTest, AutomaticExposureAdaptsOneFrameLateAndInItsOwnTime) {
    const gpu::Framebuffer drawn = target({16, 16}, gpu::Format::RGBA8);
    const PostSettings settings{.auto_exposure = post::AutoExposureSettings{.speed_down = 2.0F}};
    const gpu::Texture dark = plain_picture(0.125F);
    const gpu::Texture bright = plain_picture(1.0F);
    /// The stops after half a second in so many frames, from when the bright picture's luminance is known.
    const auto adapted_in = [&](int frames) {
        post::PostStack stack(library_);
        const auto draw = [&](const gpu::Texture& picture, float seconds) {
            stack.draw(picture, display_, settings, frame(seconds), drawn);
            glFinish();
            return stack.exposure_stops();
        };
        const float first = draw(dark, 1.0F);
        EXPECT_NEAR(first, std::log2(0.18F / 0.125F), 1e-3F);
        // The GPU has not measured this one yet.
        EXPECT_EQ(draw(bright, 0.25F), first);
        for (int i = 0; i + 1 < frames; ++i) draw(bright, 0.5F / static_cast<float>(frames));
        return draw(bright, 0.5F / static_cast<float>(frames)) - first;
    };
    for (const int frames : {1, 2, 7}) EXPECT_NEAR(adapted_in(frames), -3.0F * (1.0F - std::exp(-1.0F)), 1e-3F);
}

TEST_F(PostStackTest, AVignetteDoesNotChangeTheAutomaticExposure) {
    const gpu::Framebuffer drawn = target({16, 16}, gpu::Format::RGBA8);
    post::PostStack stack(library_);
    const PostSettings settings{.auto_exposure = post::AutoExposureSettings{},
                                .vignette = post::VignetteSettings{.vertical_fov = 2.0F}};
    stack.draw(plain_picture(0.18F), display_, settings, frame(), drawn);
    EXPECT_NEAR(stack.exposure_stops(), 0.0F, 1e-3F);
}

TEST_F(PostStackTest, TheThresholdOfGlareIsOfTheExposedPicture) {
    const glm::ivec2 size(64, 36);
    std::vector<glm::vec4> pixels(std::size_t{64} * 36, glm::vec4(0.0F));
    pixels[18 * 64 + 32] = glm::vec4(1.5F);
    const gpu::Texture hdr = picture(pixels, size, gpu::Format::RGBA16F);
    const gpu::Framebuffer drawn = target(size);
    post::PostStack stack(library_);
    const auto display_value_of_the_lamp = [&](float stops, bool glare) {
        PostSettings settings{.exposure_stops = stops};
        if (glare) settings.glare = glare_by({0.2F, 0.0F});
        stack.draw(hdr, display_, settings, {}, drawn);
        return drawn.colour().read()[18 * 64 + 32].g;
    };
    EXPECT_EQ(display_value_of_the_lamp(-1.0F, true), display_value_of_the_lamp(-1.0F, false));
    EXPECT_LT(display_value_of_the_lamp(0.0F, true), display_value_of_the_lamp(0.0F, false));
}

TEST_F(PostStackTest, AutomaticExposureWithoutWeightsIsALogicError) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const gpu::Framebuffer drawn = target({16, 16}, gpu::Format::RGBA8);
    const PostSettings settings{.auto_exposure = post::AutoExposureSettings{}};
    EXPECT_DEATH(
        {
            post::PostStack stack(library_);
            stack.draw(plain_picture(1.0F), display_, settings, {}, drawn);
        },
        "luminance_weights");
}

}  // namespace
}  // namespace rowland
