// Materials, textures and images of glTF files.
#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/unit/engine/image/image_bytes.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

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

std::vector<std::uint8_t> gradient(int width, int height) {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < width * height; ++i)
        for (const int c : {i * 9, 255 - i * 9, 40}) rgb.push_back(static_cast<std::uint8_t>(c));
    return rgb;
}

std::vector<std::byte> png(int width, int height) {
    const rowland::test::TemporaryFolder folder;
    image::write_png(folder.path() / "a.png", width, height, gradient(width, height));
    return read_file(folder.path() / "a.png", 1 << 20);
}

/// A file with the image and a texture of it.
json textured(const json& image) {
    json file = test::document(5);
    file["images"] = json::array({image});
    file["textures"] = {{{"source", 0}}};
    return file;
}

TEST(GltfImage, EmbeddedPicturesAreDecodedWhereverTheyAre) {
    for (const auto& bytes : {png(5, 3), rowland::test::encoded_jpeg(5, 3, gradient(5, 3))}) {
        const image::ByteImage expected = image::decode_byte_image(bytes, "a");
        json in_view = textured({});
        in_view["images"][0] = {{"bufferView", test::add_view(in_view, bytes)}, {"mimeType", "image/png"}};
        const json in_uri = textured({{"uri", test::data_uri(bytes, "image/png")}});
        for (const json& file : {in_view, in_uri}) {
            const ImportedScene scene = load(file);
            ASSERT_EQ(scene.images.size(), 1U);
            EXPECT_EQ(scene.images[0]->width, 5);
            EXPECT_EQ(scene.images[0]->height, 3);
            EXPECT_EQ(scene.images[0]->rgba, expected.rgba);
            EXPECT_TRUE(scene.warnings.empty());
        }
    }
}

TEST(GltfImage, FileBesideTheGltfIsReadAndReported) {
    const rowland::test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "skin of paint.png", png(4, 4));
    const auto load_with = [&](const std::string& uri, std::vector<std::filesystem::path>* files) {
        write_file_atomic(folder.path() / "f.gltf", textured({{"uri", uri}}).dump());
        return load_gltf(folder.path() / "f.gltf", {}, files);
    };
    std::vector<std::filesystem::path> files;
    EXPECT_EQ(load_with("skin%20of%20paint.png", &files).images.at(0)->width, 4);
    EXPECT_THAT(files, testing::Contains(folder.path() / "skin of paint.png"));
    EXPECT_THROW(load_with("../f.png", nullptr), Error);
    EXPECT_THROW(load_with("missing.png", nullptr), Error);
    EXPECT_THROW(load_with("f.gltf", nullptr), Error);
}

TEST(GltfImage, OneImageOfManyTexturesIsDecodedOnce) {
    json file = textured({{"uri", test::data_uri(png(2, 2))}});
    file["textures"].push_back({{"source", 0}});
    const ImportedScene scene = load(file);
    EXPECT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.textures.size(), 2U);
    EXPECT_EQ(scene.textures[1].image, 0U);
}

TEST(GltfImage, SamplersAreRead) {
    json file = textured({{"uri", test::data_uri(png(2, 2))}});
    file["textures"] = {{{"source", 0}}, {{"source", 0}, {"sampler", 0}}, {{"source", 0}, {"sampler", 1}}};
    file["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9728}},
                        {{"wrapS", 10497}, {"magFilter", 9729}, {"minFilter", 9987}}};
    const ImportedScene scene = load(file);
    EXPECT_EQ(scene.textures.at(0).wrap_s, TextureWrap::Repeat);
    EXPECT_FALSE(scene.textures[0].nearest);
    EXPECT_TRUE(scene.textures[0].mipmaps);
    EXPECT_EQ(scene.textures.at(1).wrap_s, TextureWrap::Clamp);
    EXPECT_EQ(scene.textures[1].wrap_t, TextureWrap::Mirror);
    EXPECT_TRUE(scene.textures[1].nearest);
    EXPECT_FALSE(scene.textures[1].mipmaps);
    EXPECT_EQ(scene.textures.at(2).wrap_t, TextureWrap::Repeat);
    EXPECT_FALSE(scene.textures[2].nearest);
    EXPECT_TRUE(scene.textures[2].mipmaps);
}

TEST(GltfImage, BadReferencesAreRefused) {
    const auto with = [](const std::string& pointer, const json& value) {
        json file = textured({{"uri", test::data_uri(png(2, 2))}});
        file["textures"][0]["sampler"] = 0;
        file["samplers"] = json::array({json::object()});
        file[json::json_pointer(pointer)] = value;
        return error_of(file);
    };
    EXPECT_EQ(with("/images/0/name", "paint"), "no error");
    EXPECT_THAT(with("/textures/0/source", 1), HasSubstr("/textures/0/source"));
    EXPECT_THAT(with("/textures/0/sampler", 1), HasSubstr("/textures/0/sampler"));
    EXPECT_THAT(with("/textures/0/sampler", -1), HasSubstr("/textures/0/sampler"));
    EXPECT_THAT(with("/samplers/0/wrapS", 1), HasSubstr("/samplers/0/wrapS"));
    EXPECT_THAT(with("/samplers/0/magFilter", 9987), HasSubstr("/samplers/0/magFilter"));
    EXPECT_THAT(with("/samplers/0/minFilter", 9800), HasSubstr("/samplers/0/minFilter"));
    EXPECT_THAT(with("/images/0/bufferView", 99), HasSubstr("/images/0/bufferView"));
    EXPECT_THAT(with("/images/0/uri", 7), HasSubstr("/images/0/uri"));
    EXPECT_THAT(with("/images/0/uri", ""), HasSubstr("/images/0"));
    EXPECT_THAT(with("/images/0/uri", "a.png"), HasSubstr("an external file \"a.png\""));
    EXPECT_THAT(with("/images/0/uri", "data:image/png;base64,AAAA"), HasSubstr("f.gltf: /images/0: an unknown image"));
    EXPECT_THAT(with("/images", json::array()), HasSubstr("/textures/0/source"));
}

TEST(GltfImage, ViewBeyondItsBufferIsRefused) {
    json file = textured({});
    const std::size_t view = test::add_view(file, png(2, 2));
    file["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
    file["bufferViews"][view]["byteOffset"] = 8;
    EXPECT_THAT(error_of(file), HasSubstr("/bufferViews/1"));
    file["bufferViews"][view]["byteOffset"] = 0;
    file["bufferViews"][view]["byteLength"] = 40;
    EXPECT_THAT(error_of(file), HasSubstr("f.gltf: /images/0"));
}

TEST(GltfImage, PicturesTogetherAreLimited) {
    // One row of 32768 texels in many images: a small file that would be gigabytes.
    json file = textured({});
    file["images"][0] = {{"bufferView", test::add_view(file, png(32768, 64))}, {"mimeType", "image/png"}};
    for (int i = 1; i < 200; ++i) {
        file["images"].push_back(file["images"][0]);
        file["textures"].push_back({{"source", i}});
    }
    EXPECT_THAT(error_of(file), HasSubstr("bytes in the whole scene"));
}

TEST(GltfImage, PictureThatOnlyAnUnknownExtensionOffersIsWarnedOf) {
    json file = textured({{"uri", "data:image/ktx2;base64,q0tUWCAyMLs="}});
    file["extensionsUsed"] = {"KHR_texture_basisu"};
    file["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    file["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const ImportedScene scene = load(file);
    EXPECT_TRUE(test::is_sane(scene));
    EXPECT_FALSE(scene.materials.at(0).normal_texture);
    EXPECT_THAT(scene.warnings, testing::ElementsAre("the extension KHR_texture_basisu is ignored",
                                                     "textures that have no PNG or JPEG image are ignored"));
    // Beside a picture that we read it is no loss.
    file["images"].push_back({{"uri", test::data_uri(png(2, 2))}});
    file["textures"][0]["source"] = 1;
    const ImportedScene fallback = load(file);
    EXPECT_EQ(fallback.images.at(fallback.textures.at(0).image)->width, 2);
    EXPECT_TRUE(fallback.materials.at(0).normal_texture);
    file["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_THAT(error_of(file), HasSubstr("KHR_texture_basisu"));
}

}  // namespace
}  // namespace rowland::scene
