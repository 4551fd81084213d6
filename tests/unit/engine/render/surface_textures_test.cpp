#include "engine/render/surface_textures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/message_of.h"

namespace rowland::render {
namespace {

TEST(SurfaceTextures, AnIndexBeyondTheFilesTexturesIsRefusedWithItsLocation) {
    scene::ImportedScene scene;
    scene.textures.resize(2);
    EXPECT_NO_THROW(require_texture(scene, 1, "scene.gltf", "/grooveTexture"));
    const std::string message = test::message_of([&] { require_texture(scene, 2, "scene.gltf", "/grooveTexture"); });
    EXPECT_THAT(message, ::testing::AllOf(::testing::HasSubstr("scene.gltf: /grooveTexture/index: 2"),
                                          ::testing::HasSubstr("2 textures")));
}

}  // namespace
}  // namespace rowland::render
