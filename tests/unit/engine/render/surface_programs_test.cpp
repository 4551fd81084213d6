#include <gmock/gmock.h>

#include "engine/render/surface_programs.h"
#include "engine/render/surface_textures.h"
#include "tests/support/expect.h"

namespace rowland::render {

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

constexpr SurfaceFeatures second_uv(SurfaceFeatures map) {
    return map << feature::kSecondUvShift;
}

TEST(SurfaceFeatures, APlainSurfaceHasNoDefines) {
    EXPECT_THAT(defines_of(0), IsEmpty());
}

TEST(SurfaceFeatures, AMapNamesItsCoordinatesAndAsksForThem) {
    EXPECT_THAT(defines_of(feature::kNormalMap), ElementsAre(Pair("NORMAL_MAP", "uv"), Pair("HAS_UV", "")));
    EXPECT_THAT(defines_of(feature::kEmissiveMap | second_uv(feature::kEmissiveMap)),
                ElementsAre(Pair("EMISSIVE_MAP", "uv1"), Pair("HAS_UV1", "")));
}

TEST(SurfaceFeatures, WithoutLightOnlyColourAlphaAndEmissionRemain) {
    const SurfaceFeatures all = feature::kColours | feature::kSkinned | feature::kBaseColourMap |
                                second_uv(feature::kBaseColourMap) | feature::kNormalMap | feature::kOcclusionMap |
                                feature::kMetallicRoughnessMap | feature::kTextureTransformExtension |
                                feature::kDoubleSided | feature::kAlphaMask | feature::kLights;
    EXPECT_EQ(without_light(all), feature::kColours | feature::kSkinned | feature::kBaseColourMap |
                                      second_uv(feature::kBaseColourMap) | feature::kTextureTransformExtension |
                                      feature::kAlphaMask | feature::kUnlit);
    EXPECT_EQ(without_light(feature::kNormalMap | feature::kTextureTransformExtension), feature::kUnlit);
}

TEST(SurfaceFeatures, AShadowNeedsMapsOnlyOfAMask) {
    const SurfaceFeatures lit = feature::kSkinned | feature::kColours | feature::kBaseColourMap | feature::kNormalMap |
                                feature::kTextureTransformExtension | feature::kShadows | feature::kDoubleSided;
    EXPECT_EQ(of_shadow(lit), feature::kSkinned);
    EXPECT_EQ(of_shadow(lit | feature::kAlphaMask), feature::kSkinned | feature::kColours | feature::kBaseColourMap |
                                                        feature::kTextureTransformExtension | feature::kAlphaMask);
}

TEST(SurfaceFeatures, AProgramsOwnDefinesStayAndAreNotDoubled) {
    gpu::ProgramDesc desc;
    desc.defines = {{"BANDS", "4"}, {"HAS_UV", "1"}};
    add_defines(feature::kBaseColourMap | feature::kSkinned, desc);
    EXPECT_THAT(desc.defines, ElementsAre(Pair("BANDS", "4"), Pair("HAS_UV", "1"), Pair("BASE_COLOUR_MAP", "uv"),
                                          Pair("SKINNED", "")));
}

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
