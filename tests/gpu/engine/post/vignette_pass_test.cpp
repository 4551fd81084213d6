#include "engine/post/vignette.h"

#include "engine/post/shader_files.h"
#include "tests/gpu/gl_test.h"
#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland {

namespace {

using post::VignetteSettings;
using VignettePassTest = test::GlTest;

TEST_F(VignettePassTest, AgreesWithTheFormula) {
    gpu::ShaderLibrary library;
    library.add_embedded(post::shader_files());
    const post::VignettePass pass(library);
    for (const glm::ivec2 size : {glm::ivec2(64, 36), glm::ivec2(33, 47)}) {
        gpu::Texture source({.format = gpu::Format::RGBA32F, .width = size.x, .height = size.y});
        source.upload(std::vector<glm::vec4>(static_cast<std::size_t>(size.x * size.y), {1.0F, -0.5F, 0.25F, 0.75F}));
        const gpu::Framebuffer target({.width = size.x, .height = size.y, .colours = {gpu::Format::RGBA32F}});
        for (const VignetteSettings& settings :
             {VignetteSettings{.vertical_fov = 1.2F}, VignetteSettings{.strength = 0.8F, .radius = 0.3F},
              VignetteSettings{.vertical_fov = 0.7F, .strength = 1.0F, .softness = 0.1F}, VignetteSettings{}}) {
            pass.draw(source, settings, target);
            const std::vector<glm::vec4> drawn = target.colour().read();
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const glm::vec4& pixel = drawn[static_cast<std::size_t>(y * size.x + x)];
                    const float factor = post::vignette_factor({x, y}, size, settings);
                    // Float rounding on either side, magnified by the steepest smoothstep, 1.5 / 0.1.
                    EXPECT_NEAR(pixel.r, factor, 1e-5F) << x << " " << y;
                    EXPECT_NEAR(pixel.g, -0.5F * factor, 1e-5F);
                    EXPECT_EQ(pixel.a, 0.75F);
                }
            }
        }
    }
}

}  // namespace

}  // namespace rowland
