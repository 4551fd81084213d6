#include "engine/scene/gltf_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/unit/engine/image/encoded_jpeg.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

/// A file with one material and two textures of one picture.
json with_material(const json& material) {
    json file = test::document(5);
    const std::array<std::uint8_t, 3> grey = {128, 128, 128};
    const auto picture = rowland::test::encoded_jpeg(1, 1, grey);
    file["images"] = {{{"uri", test::data_uri(picture, "image/jpeg")}}};
    file["textures"] = {{{"source", 0}}, {{"source", 0}}};
    file["materials"] = json::array({material});
    return file;
}

MaterialDescription read(const json& material) {
    return load(with_material(material)).materials.at(0);
}

TEST(GltfMaterial, DefaultsAreThoseOfGltf) {
    const MaterialDescription material = read(json::object());
    EXPECT_EQ(material.base_colour, glm::vec4(1.0F));
    EXPECT_EQ(material.metallic, 1.0F);
    EXPECT_EQ(material.roughness, 1.0F);
    EXPECT_EQ(material.emissive, glm::vec3(0.0F));
    EXPECT_EQ(material.alpha_mode, AlphaMode::Opaque);
    EXPECT_EQ(material.alpha_cutoff, 0.5F);
    EXPECT_FALSE(material.double_sided);
    EXPECT_FALSE(material.unlit);
}

TEST(GltfMaterial, EveryTextureIsRead) {
    const MaterialDescription material =
        read({{"pbrMetallicRoughness",
               {{"baseColorTexture", {{"index", 1}}}, {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}}},
              {"normalTexture", {{"index", 1}, {"scale", -2.0}}},
              {"occlusionTexture", {{"index", 0}, {"strength", 0.25}, {"texCoord", 1}}},
              {"emissiveTexture", {{"index", 1}}}});
    ASSERT_TRUE(material.base_colour_texture && material.metallic_roughness_texture && material.normal_texture &&
                material.occlusion_texture && material.emissive_texture);
    EXPECT_EQ(material.base_colour_texture->texture, 1U);
    EXPECT_EQ(material.base_colour_texture->uv_set, 0);
    EXPECT_EQ(material.metallic_roughness_texture->texture, 0U);
    EXPECT_EQ(material.metallic_roughness_texture->uv_set, 1);
    EXPECT_EQ(material.normal_texture->texture, 1U);
    EXPECT_EQ(material.normal_scale, -2.0F);
    EXPECT_EQ(material.occlusion_texture->texture, 0U);
    EXPECT_EQ(material.occlusion_strength, 0.25F);
    EXPECT_EQ(material.emissive_texture->texture, 1U);
    EXPECT_EQ(material.emissive_texture->transform.scale, glm::vec2(1.0F));
}

TEST(GltfMaterial, TextureTransformIsRead) {
    const json transform = {{"offset", {0.25, -1.0}}, {"rotation", 0.5}, {"scale", {2.0, -3.0}}, {"texCoord", 1}};
    const MaterialDescription material = read(
        {{"emissiveTexture", {{"index", 0}, {"texCoord", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}});
    ASSERT_TRUE(material.emissive_texture);
    EXPECT_EQ(material.emissive_texture->uv_set, 1) << "the extension's overrides";
    EXPECT_EQ(material.emissive_texture->transform.offset, glm::vec2(0.25F, -1.0F));
    EXPECT_EQ(material.emissive_texture->transform.rotation, 0.5F);
    EXPECT_EQ(material.emissive_texture->transform.scale, glm::vec2(2.0F, -3.0F));
}

TEST(GltfMaterial, AlphaIsRead) {
    const MaterialDescription mask = read({{"alphaMode", "MASK"}, {"alphaCutoff", 0.75}, {"doubleSided", true}});
    EXPECT_EQ(mask.alpha_mode, AlphaMode::Mask);
    EXPECT_EQ(mask.alpha_cutoff, 0.75F);
    EXPECT_TRUE(mask.double_sided);
    EXPECT_EQ(read({{"alphaMode", "BLEND"}}).alpha_mode, AlphaMode::Blend);
}

TEST(GltfMaterial, KnownExtensionsAreAppliedAndOthersHandedOn) {
    json file = with_material({{"emissiveFactor", {0.5, 0.25, 1.0}},
                               {"extensions",
                                {{"KHR_materials_unlit", json::object()},
                                 {"KHR_materials_emissive_strength", {{"emissiveStrength", 8.0}}},
                                 {"VENDOR_x", {{"a", 1}}}}}});
    file["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_emissive_strength"};
    file["extensionsRequired"] = file["extensionsUsed"];
    const ImportedScene scene = load(file);
    EXPECT_TRUE(scene.warnings.empty());
    const MaterialDescription& material = scene.materials.at(0);
    EXPECT_TRUE(material.unlit);
    EXPECT_EQ(material.emissive, glm::vec3(4.0F, 2.0F, 8.0F));
    ASSERT_EQ(material.extensions.size(), 1U);
    EXPECT_EQ(material.extensions.at("VENDOR_x")["a"], 1);
}

TEST(GltfMaterial, AClearCoatIsReadWithoutItsMaps) {
    json file = with_material(
        {{"extensions",
          {{"KHR_materials_clearcoat",
            {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.25}, {"clearcoatTexture", {{"index", 0}}}}}}}});
    file["extensionsUsed"] = {"KHR_materials_clearcoat"};
    file["extensionsRequired"] = file["extensionsUsed"];
    const ImportedScene scene = load(file);
    EXPECT_EQ(scene.materials.at(0).clear_coat, 0.75F);
    EXPECT_EQ(scene.materials.at(0).clear_coat_roughness, 0.25F);
    EXPECT_TRUE(scene.materials.at(0).extensions.empty());
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("clearcoatTexture")));
    EXPECT_EQ(read({{"extensions", {{"KHR_materials_clearcoat", json::object()}}}}).clear_coat, 0.0F);
    EXPECT_THAT(error_of(with_material({{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1.5}}}}}})),
                HasSubstr("/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor"));
}

TEST(GltfMaterial, ThirdUvSetIsIgnoredWithItsTexture) {
    const ImportedScene scene = load(with_material(
        {{"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}, {"normalTexture", {{"index", 0}, {"texCoord", 7}}}}));
    EXPECT_FALSE(scene.materials.at(0).emissive_texture);
    EXPECT_FALSE(scene.materials.at(0).normal_texture);
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("third or later set of texture coordinates")));
}

TEST(GltfMaterial, BadPropertiesAreRefusedWhereTheyAre) {
    const auto refusal = [](const json& material) { return error_of(with_material(material)); };
    const auto texture = [&](const json& info) { return refusal({{"normalTexture", info}}); };
    EXPECT_THAT(texture({{"index", 2}}), HasSubstr("/materials/0/normalTexture/index"));
    EXPECT_THAT(texture({{"index", -1}}), HasSubstr("/materials/0/normalTexture/index"));
    EXPECT_THAT(texture({{"texCoord", 0}}), HasSubstr("/materials/0/normalTexture/index"));
    EXPECT_THAT(texture({{"index", 0}, {"texCoord", -1}}), HasSubstr("/materials/0/normalTexture/texCoord"));
    EXPECT_THAT(texture({{"index", 0}, {"texCoord", 0.5}}), HasSubstr("/materials/0/normalTexture/texCoord"));
    EXPECT_THAT(texture({{"index", 0}, {"scale", "big"}}), HasSubstr("/materials/0/normalTexture/scale"));
    const auto transform = [&](const json& value) {
        return texture({{"index", 0}, {"extensions", {{"KHR_texture_transform", value}}}});
    };
    const std::string pointer = "/materials/0/normalTexture/extensions/KHR_texture_transform";
    EXPECT_THAT(transform(3), HasSubstr(pointer));
    EXPECT_THAT(transform({{"offset", {1}}}), HasSubstr(pointer + "/offset"));
    EXPECT_THAT(transform({{"scale", {1, 1e300}}}), HasSubstr(pointer + "/scale/1"));
    EXPECT_THAT(transform({{"rotation", nullptr}}), HasSubstr(pointer + "/rotation"));
    EXPECT_THAT(transform({{"texCoord", -3}}), HasSubstr(pointer + "/texCoord"));
    EXPECT_THAT(refusal({{"alphaMode", "CUTOUT"}}), HasSubstr("/materials/0/alphaMode"));
    EXPECT_THAT(refusal({{"alphaCutoff", -0.5}}), HasSubstr("/materials/0/alphaCutoff"));
    EXPECT_THAT(refusal({{"doubleSided", 1}}), HasSubstr("/materials/0/doubleSided"));
    EXPECT_THAT(refusal({{"occlusionTexture", {{"index", 0}, {"strength", 2}}}}), HasSubstr("strength"));
    EXPECT_THAT(refusal({{"emissiveFactor", {-1, 0, 0}}}), HasSubstr("/materials/0/emissiveFactor/0"));
    EXPECT_THAT(refusal({{"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", -1}}}}}}),
                HasSubstr("emissiveStrength"));
    EXPECT_THAT(refusal({{"extensions", {{"KHR_materials_unlit", 1}}}}), HasSubstr("KHR_materials_unlit"));
}

}  // namespace
}  // namespace rowland::scene
