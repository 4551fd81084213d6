#include "engine/post/exposure_pass.h"

#include <cmath>

#include "engine/post/exposure.h"
#include "engine/post/shader_files.h"
#include "tests/gpu/gl_test.h"

namespace rowland {

namespace {

using ExposurePassTest = test::GlTest;

TEST_F(ExposurePassTest, AgreesWithTheCpu) {
    std::vector<glm::vec3> pixels;
    for (float value = 1e-8F; value < 1e5F; value *= 1.7F) pixels.emplace_back(value, -value, 0.5F * value);
    gpu::Texture source({.format = gpu::Format::RGBA32F, .width = static_cast<int>(pixels.size())});
    source.upload(std::span<const glm::vec3>(pixels));
    const gpu::Framebuffer target(
        {.width = static_cast<int>(pixels.size()), .height = 1, .colours = {gpu::Format::RGBA32F}});
    gpu::ShaderLibrary library;
    library.add_embedded(post::shader_files());
    const post::ExposurePass pass(library);

    for (const float stops : {-3.7F, 0.0F, 1.0F, 2.25F}) {
        pass.draw(source, stops, target);
        std::vector<glm::vec3> expected = pixels;
        post::apply_exposure(expected, stops);
        const std::vector<glm::vec4> drawn = target.read_rgba_float();
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                // One float product on either side.
                EXPECT_NEAR(drawn[i][c], expected[i][c], 1e-6F * std::abs(expected[i][c])) << stops << " " << i;
            }
            EXPECT_EQ(drawn[i].a, 1.0F);
        }
    }
}

}  // namespace

}  // namespace rowland
