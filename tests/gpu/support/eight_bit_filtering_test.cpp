// The filtering that the GPU tests can run with.
#include "tests/support/eight_bit_filtering.h"
#include "engine/core/error.h"

#include <algorithm>
#include <cmath>

#include "tests/gpu/gl_test.h"

namespace rowland::test {
namespace {

class EightBitFilteringTest : public GlTest {
 protected:
    static constexpr int kPixels = 1000;

    /// From one texel's centre to the next, of black and of white.
    static std::vector<glm::vec4> draw(gpu::TextureKind kind, const std::string& look_up, Fraction fraction) {
        gpu::Texture texture({.kind = kind, .format = gpu::Format::R32F, .width = 2, .height = 2, .depth = 1});
        const std::vector<float> texels{0.0F, 1.0F, 0.0F, 1.0F};
        texture.upload(std::span<const float>(texels));
        texture.bind(0);
        const std::string sampler = kind == gpu::TextureKind::Plane        ? "sampler2D"
                                    : kind == gpu::TextureKind::PlaneArray ? "sampler2DArray"
                                                                           : "sampler3D";
        const gpu::Program program = build_full_screen(with_eight_bit_filtering(
            "#version 450 core\nlayout(binding = 0) uniform " + sampler +
                " table;\nlayout(location = 0) in vec2 uv;\nlayout(location = 0) out vec4 colour;\n"
                "void main() { float s = 0.25 + 0.5 * uv.x; colour = " +
                look_up + "; }\n",
            true, fraction));
        const gpu::Framebuffer target({.width = kPixels, .height = 1, .colours = {gpu::Format::RGBA32F}});
        gpu::FullScreenTriangle().draw(program, target);
        return target.read_rgba_float();
    }
    static void expect_eight_bits(gpu::TextureKind kind, const std::string& look_up, Fraction fraction) {
        double least = 1.0;
        double most = -1.0;
        double rest = 0.0;
        const std::vector<glm::vec4> pixels = draw(kind, look_up, fraction);
        for (int i = 0; i < kPixels; ++i) {
            const double value = static_cast<double>(pixels[static_cast<std::size_t>(i)].r);
            const double error = 256.0 * (value - (i + 0.5) / kPixels);
            least = std::min(least, error);
            most = std::max(most, error);
            rest = std::max(rest, std::abs(256.0 * value - std::round(256.0 * value)));
        }
        // In steps. Next to one half a fraction stays on its side by 5e-3 of one.
        EXPECT_LT(rest, 6e-3) << look_up;
        EXPECT_NEAR(least, fraction == Fraction::Rounded ? -0.5 : -1.0, 0.01) << look_up;
        EXPECT_NEAR(most, fraction == Fraction::Rounded ? 0.5 : 0.0, 0.01) << look_up;
    }
};

TEST_F(EightBitFilteringTest, FractionsHaveEightBitsRoundedOrCutOff) {
    for (const Fraction fraction : {Fraction::Rounded, Fraction::Truncated}) {
        expect_eight_bits(gpu::TextureKind::Plane, "texture(table, vec2(s, 0.5))", fraction);
        expect_eight_bits(gpu::TextureKind::Plane, "textureLod(table, vec2(s, 0.25), 0.0)", fraction);
        expect_eight_bits(gpu::TextureKind::PlaneArray, "textureLod(table, vec3(s, 0.5, 0.0), 0.0)", fraction);
        expect_eight_bits(gpu::TextureKind::Volume, "texture(table, vec3(s, 0.5, 0.5))", fraction);
    }
}

TEST_F(EightBitFilteringTest, LinesKeepTheirNumbers) {
    const std::string text =
        "#version 450 core\nlayout(location = 0) out vec4 texture_colour;\nfloat a = nonsense;\nvoid main() {}\n";
    try {
        build_full_screen(with_eight_bit_filtering(text, true, Fraction::Rounded));
        FAIL() << "nonsense compiled";
    } catch (const Error& error) {
        EXPECT_EQ(error.info().location, "line 3") << error.what();
    }
}

TEST_F(EightBitFilteringTest, ShadersWithoutLookUpsAreUnchanged) {
    const std::string text = "#version 450 core\nvoid main() {}\n";
    EXPECT_EQ(with_eight_bit_filtering(text, true, Fraction::Truncated), text);
}

}  // namespace
}  // namespace rowland::test
