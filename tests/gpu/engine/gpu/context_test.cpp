#include <gmock/gmock.h>
#include <algorithm>

#include "tests/gpu/gl_test.h"
#include "tests/support/expect.h"

namespace rowland {
namespace {

/// A draw call with a mode that does not exist.
void make_an_error(bool fatal) {
    const platform::HeadlessContext context({.debug = true});
    gpu::enable_debug_output(fatal);
    glDrawArrays(0xffff, 0, 3);
}

TEST(DebugOutputDeathTest, AnErrorOfTheDriverIsFatalWhereAskedFor) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(make_an_error(true), "error: OpenGL.*GL_INVALID_ENUM");
}

TEST(DebugOutput, AnErrorOfTheDriverIsLoggedOtherwise) {
    testing::internal::CaptureStderr();
    make_an_error(false);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("error: OpenGL"), std::string::npos);
}

TEST(DebugOutput, AMessageIsLoggedOnce) {
    testing::internal::CaptureStderr();
    const platform::HeadlessContext context({.debug = true});
    gpu::enable_debug_output(false);
    const auto say = [](const char* message) {
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 1, GL_DEBUG_SEVERITY_MEDIUM, -1,
                             message);
    };
    for (const char* message : {"slow", "slower", "slow", "slower"}) say(message);
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

TEST(DebugOutputDeathTest, NeedsADebugContext) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto enable = [] {
        const platform::HeadlessContext context({.debug = false});
        gpu::enable_debug_output(true);
    };
    EXPECT_DEATH(enable(), "a debug context");
}

TEST(DebugOutput, NotesAreNotFatal) {
    testing::internal::CaptureStderr();
    const platform::HeadlessContext context({.debug = true});
    gpu::enable_debug_output(true);
    const char message[] = "rather slow";
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 1, GL_DEBUG_SEVERITY_MEDIUM, -1,
                         message);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("warning: OpenGL [1]: rather slow"), std::string::npos);
}

TEST(DebugOutputDeathTest, DeprecatedUseIsFatal) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto insert = [] {
        const platform::HeadlessContext context({.debug = true});
        gpu::enable_debug_output(true);
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR, 2,
                             GL_DEBUG_SEVERITY_MEDIUM, -1, "from another age");
    };
    EXPECT_DEATH(insert(), "from another age");
}

using ::testing::HasSubstr;
using LimitsTest = test::GlTest;
using gpu::Limits;
using gpu::require_vertex_storage;
using gpu::TextureKind;

/// The refusal of a texture that OpenGL does not guarantee.
std::string refusal(const gpu::TextureDesc& desc) {
    return test::message_of([&] { require_texture(desc, Limits{}); }, Fault::System);
}

TEST(Limits, ATextureOfTheGuaranteedSizeIsTaken) {
    EXPECT_NO_THROW(require_texture({.width = 16384, .height = 16384}, Limits{}));
    EXPECT_NO_THROW(require_texture({.kind = TextureKind::PlaneArray, .width = 16384, .depth = 2048}, Limits{}));
    EXPECT_NO_THROW(require_texture({.kind = TextureKind::Volume, .width = 2048, .depth = 2048}, Limits{}));
}

TEST(Limits, ALargerOneIsRefusedWithBothSizes) {
    EXPECT_EQ(
        refusal({.width = 16385, .height = 9}),
        "texture: 16385 x 9 x 1 texels; expected at most 16384 to a side, this GPU's limit; scale the image or the "
        "picture down");
    EXPECT_THAT(refusal({.kind = TextureKind::PlaneArray, .depth = 2049}), HasSubstr("2049 layers"));
    EXPECT_THAT(refusal({.kind = TextureKind::Volume, .depth = 2049}), HasSubstr("at most 2048"));
    EXPECT_THAT(refusal({.kind = TextureKind::CubeMap, .width = 16385, .height = 16385}), HasSubstr("at most 16384"));
}

TEST(Limits, StorageOfVerticesIsRefusedByNumberAndSize) {
    const auto require = [](int blocks, std::size_t bytes) {
        return test::message_of(
            [&] {
                require_vertex_storage({.what = "a table", .blocks = blocks, .bytes = bytes, .remedy = "halve it"},
                                       {.vertex_storage_blocks = 2});
            },
            Fault::System);
    };
    EXPECT_EQ(require(3, 16),
              "a table: 3 storage buffers that its vertex stage reads; expected at most 2, this GPU's limit; halve it");
    EXPECT_EQ(require(2, (1 << 24) + 1),
              "a table: a storage buffer of 16777217 bytes; expected at most 16777216, this GPU's limit; halve it");
    EXPECT_NO_THROW(
        require_vertex_storage({.what = "a table", .blocks = 2, .bytes = 1 << 24, .texels = 1 << 16, .remedy = ""},
                               {.vertex_storage_blocks = 2}));
    EXPECT_EQ(test::message_of(
                  [&] {
                      require_vertex_storage({.what = "a mesh", .texels = (1 << 16) + 1, .remedy = "halve it"},
                                             {.vertex_storage_blocks = 1});
                  },
                  Fault::System),
              "a mesh: a buffer of 65537 texels; expected at most 65536, this GPU's limit; halve it");
}

TEST_F(LimitsTest, ADriverAllowsWhatOpenGlGuarantees) {
    const Limits limits = gpu::read_limits();
    const Limits guaranteed;
    EXPECT_GE(limits.storage_block_bytes, guaranteed.storage_block_bytes);
    EXPECT_GE(limits.vertex_storage_blocks, guaranteed.vertex_storage_blocks);
    EXPECT_GE(limits.buffer_texels, guaranteed.buffer_texels);
    EXPECT_GE(limits.texture_side, guaranteed.texture_side);
    EXPECT_GE(limits.cube_side, guaranteed.cube_side);
    EXPECT_GE(limits.volume_side, guaranteed.volume_side);
    EXPECT_GE(limits.texture_layers, guaranteed.texture_layers);
}

TEST_F(LimitsTest, TexturesAndFramebuffersBeyondTheDriversLimitAreRefused) {
    const int width = gpu::read_limits().texture_side + 1;
    EXPECT_THROW(gpu::Texture({.width = width}), Error);
    EXPECT_THROW(gpu::Framebuffer({.width = width}), Error);
    EXPECT_THROW(gpu::Framebuffer({.width = width, .samples = 4}), Error);
}

}  // namespace
}  // namespace rowland
