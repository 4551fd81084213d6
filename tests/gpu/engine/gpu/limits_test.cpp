#include "engine/gpu/limits.h"

#include <gmock/gmock.h>

#include "tests/gpu/gl_test.h"
#include "tests/support/message_of.h"

namespace rowland {
namespace {

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
