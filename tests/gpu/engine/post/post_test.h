#pragma once

#include "engine/post/post_stack.h"
#include "tests/gpu/gl_test.h"

namespace rowland::test {

/// The shaders of the passes, and pictures for them: rows as they lie in textures.
class PostTest : public GlTest {
 protected:
    PostTest() { library_.add_embedded(post::shader_files()); }

    template <typename Pixel>
    static gpu::Texture picture(const std::vector<Pixel>& pixels, glm::ivec2 size,
                                gpu::Format format = gpu::Format::RGBA32F) {
        gpu::Texture texture({.format = format, .width = size.x, .height = size.y});
        texture.upload(std::span<const Pixel>(pixels));
        return texture;
    }
    static gpu::Framebuffer target(glm::ivec2 size, gpu::Format format = gpu::Format::RGBA32F) {
        return gpu::Framebuffer({.width = size.x, .height = size.y, .colours = {format}});
    }
    static std::size_t count(glm::ivec2 size) {
        return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    }

    gpu::ShaderLibrary library_;
};

}  // namespace rowland::test
