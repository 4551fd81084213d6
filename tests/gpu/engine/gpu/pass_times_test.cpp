
#include <algorithm>

#include "engine/gpu/pass_times.h"
#include "tests/gpu/gl_test.h"

namespace rowland {
namespace {

/// Work in proportion to `turns`.
constexpr const char* kWork = R"(#version 450 core
uniform int turns;
layout(location = 0) out vec4 colour;
void main() {
    float x = gl_FragCoord.x;
    for (int i = 0; i < turns; ++i) x = sin(x) + 1.0;
    colour = vec4(x);
})";

class PassTimesTest : public test::GlTest {
 protected:
    PassTimesTest() { program_ = build_full_screen(kWork); }
    /// Work in proportion to `turns`, always onto the same framebuffer.
    void pass(gpu::PassTimes* times, const char* name, int turns) {
        const gpu::PassTimes::Scope scope(times, name);
        program_.set("turns", context_.is_software() ? turns : 1000 * turns);
        triangle_.draw(program_, target_);
    }
    static const gpu::PassTime& find(const std::vector<gpu::PassTime>& passes, const std::string& name) {
        return *std::find_if(passes.begin(), passes.end(), [&](const auto& pass) { return pass.name == name; });
    }

    gpu::Program program_;
    gpu::Framebuffer target_{gpu::FramebufferDesc{.width = 256, .height = 256}};
    gpu::FullScreenTriangle triangle_;
};

TEST_F(PassTimesTest, TellsApartPassesOntoOneFramebuffer) {
    gpu::PassTimes times;
    double short_ms = 1e9;
    double long_ms = 1e9;
    // The best of a few: another process may take the processor in between.
    for (int i = 0; i < 6; ++i) {
        times.begin_frame();
        pass(&times, "short", 5);
        pass(&times, "long", 100);
        glFinish();
        times.begin_frame();
        const std::vector<gpu::PassTime> passes = times.latest();
        ASSERT_EQ(passes.size(), 2U);
        EXPECT_EQ(passes[0].name, "short");
        short_ms = std::min(short_ms, find(passes, "short").gpu_ms.value());
        long_ms = std::min(long_ms, find(passes, "long").gpu_ms.value());
    }
    // Twenty times the work, less what a pass costs in itself. Without its own gathering, llvmpipe gives both the same.
    EXPECT_GT(long_ms, 4.0 * short_ms);
    EXPECT_GT(short_ms, 0.0);
}

TEST_F(PassTimesTest, RunsOfOneNameAddUp) {
    gpu::PassTimes times;
    double ratio = 0.0;
    for (int i = 0; i < 6; ++i) {
        times.begin_frame();
        pass(&times, "once", 60);
        pass(&times, "twice", 60);
        pass(&times, "twice", 60);
        glFinish();
        times.begin_frame();
        const std::vector<gpu::PassTime> passes = times.latest();
        ASSERT_EQ(passes.size(), 2U);
        ratio = std::max(ratio, find(passes, "twice").gpu_ms.value() / find(passes, "once").gpu_ms.value());
    }
    EXPECT_GT(ratio, 1.5);
}

TEST_F(PassTimesTest, ForgetsAPassThatNoLongerRuns) {
    gpu::PassTimes times;
    times.begin_frame();
    pass(&times, "bloom", 1);
    times.begin_frame();
    pass(&times, "display", 1);
    times.begin_frame();
    ASSERT_EQ(times.latest().size(), 1U);
    EXPECT_EQ(times.latest()[0].name, "display");
}

TEST_F(PassTimesTest, ManyFramesWithoutWaitingStayInOrder) {
    gpu::PassTimes times;
    for (int frame = 0; frame < 40; ++frame) {
        times.begin_frame();
        pass(&times, "display", 20);
        EXPECT_EQ(times.latest().size(), 1U);
    }
    glFinish();
    times.begin_frame();
    EXPECT_GT(times.latest().at(0).gpu_ms.value(), 0.0);
}

TEST_F(PassTimesTest, WithNobodyToTellNothingIsTimed) {
    pass(nullptr, "display", 1);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace rowland
