#pragma once

#include <gtest/gtest.h>

#include "engine/gpu/context.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/platform/gl_context.h"
#include "tests/support/eight_bit_filtering.h"

namespace rowland::test {

/// A test with an OpenGL context of its own, in which every error of the driver is fatal.
class GlTest : public ::testing::Test {
 protected:
    GlTest() {
        gpu::enable_debug_output(true);
        filter_as_asked();
    }

    /// Builds a program from texts, as files "test.vert.glsl" and "test.frag.glsl".
    static gpu::Program build(const std::string& vertex, const std::string& fragment) {
        return gpu::Program({vertex, {"test.vert.glsl"}}, {fragment, {"test.frag.glsl"}});
    }
    /// A full-screen program from its fragment stage.
    static gpu::Program build_full_screen(const std::string& fragment) {
        return gpu::Program(gpu::ShaderLibrary().assemble(gpu::full_screen_vertex_shader),
                            {fragment, {"test.frag.glsl"}});
    }

    platform::HeadlessContext context_{{.debug = true}};
};

}  // namespace rowland::test
