// What programs get of all modules together.
#include <gmock/gmock.h>

#include "engine/colour/colour_space.h"
#include "modules/asset_types.h"
#include "modules/material_types.h"
#include "tests/gpu/gl_test.h"

namespace rowland::modules {
namespace {

using Modules = test::GlTest;

/// Else a scene would be drawn that `rowland-cook check` refuses, or the other way round.
TEST_F(Modules, TheCookerKnowsTheGltfExtensionsThatTheRendererReads) {
    render::Renderer renderer(glm::inverse(colour::rec709_to_xyz()));
    register_material_types(renderer);
    EXPECT_FALSE(renderer.gltf_extensions().empty());
    EXPECT_THAT(asset_types()->gltf_extension_names(), testing::UnorderedElementsAreArray(renderer.gltf_extensions()));
}

}  // namespace
}  // namespace rowland::modules
