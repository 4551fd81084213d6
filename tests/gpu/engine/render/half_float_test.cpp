// What is drawn into half floats is rounded to them, as drivers may truncate.
#include "tests/gpu/render_test.h"
#include "tests/gpu/wide_halves.h"

namespace rowland::render {
namespace {

using HalfFloatTest = test::RenderTest;

TEST_F(HalfFloatTest, SurfacesAndTheSkyAreRounded) {
    renderer_.set_probe(even_light(0.7F));
    add(square(0.5F), {.base_colour = {0.3F, 0.2F, 0.9F}, .roughness = 0.4F});
    const auto rest = [&](gpu::Format format) {
        const test::WideHalves wide;
        const gpu::Framebuffer target({.width = kSize, .height = kSize, .colours = {format}, .depth = true});
        renderer_.render(world_, camera_, target);
        return test::not_halves(target.read_rgba_float());
    };
    EXPECT_EQ(rest(gpu::Format::RGBA16F), 0);
    EXPECT_GT(rest(gpu::Format::RGBA32F), 100);
}

}  // namespace
}  // namespace rowland::render
