#include "engine/scene/gltf_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/png.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/engine/image/encoded_jpeg.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

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
    json file = textured({{"uri", test::data_uri(png(32768, 64))}});
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
