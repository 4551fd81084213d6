// The map of marks, and its extension in glTF files.
#include "engine/scene/wear.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/unit/engine/image/image_bytes.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

constexpr double kTaper = 0.763;  // the mean of sqrt(sin x) from 0 to pi

/// The mean of what a map's texels mean: dust, grease, and the lengths of the scratches' vectors.
glm::dvec3 mean_coverage(const image::ByteImage& map) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < map.rgba.size(); i += 4)
        sum += glm::dvec3(map.rgba[i] / 255.0, map.rgba[i + 1] / 255.0,
                          std::hypot(map.rgba[i + 2] - 128.0, map.rgba[i + 3] - 128.0) / 127.0);
    return sum / (double{kWearTexels} * kWearTexels);
}

TEST(WearMap, NoWearIsNoMark) {
    EXPECT_EQ(mean_coverage(wear_map({})), glm::dvec3(0.0));
}

TEST(WearMap, ItsSeedDrawsItAnew) {
    const Wear wear{.scratches = 0.2F, .fingerprints = 1.0F, .dust = 0.2F};
    Wear other = wear;
    other.seed = 2;
    EXPECT_EQ(wear_map(wear).rgba, wear_map(wear).rgba);
    EXPECT_NE(wear_map(wear).rgba, wear_map(other).rgba);
}

/// Dust and grease of the columns and of the rows before the middle, of all.
glm::dvec4 halves(const image::ByteImage& map) {
    glm::dvec2 all(0.0);
    glm::dvec4 part(0.0);
    for (int row = 0; row < kWearTexels; ++row)
        for (int column = 0; column < kWearTexels; ++column) {
            const std::uint8_t* texel = &map.rgba[4 * static_cast<std::size_t>(row * kWearTexels + column)];
            const glm::dvec2 marks(texel[0], texel[1]);
            all += marks;
            if (column < kWearTexels / 2) part += glm::dvec4(marks, 0.0, 0.0);
            if (row < kWearTexels / 2) part += glm::dvec4(0.0, 0.0, marks);
        }
    return part / glm::dvec4(all, all);
}

TEST(WearMap, ASeedGivesTheSameMarksByEveryCompiler) {
    const glm::dvec4 found = halves(wear_map({.fingerprints = 1.0F, .dust = 0.02F, .size_m = 0.05F}));
    const glm::dvec4 held(0.52080, 0.27502, 0.47184, 0.0);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(found[i], held[i], 1e-3) << i;
}

/// Specks are discs whose squared radii have the mean 2.25e-10 ln(1 / 0.012) / 0.988 m².
TEST(WearMap, DustCoversWhatItsSpecksCover) {
    const double fibres = 6'000.0 * 1.75e-3 * 18.5e-6 * kTaper;
    const double specks = 3e6 * 3.14159265 * 2.25e-10 * std::log(1.0 / 0.012) / 0.988;
    for (const float size_m : {0.03F, 0.12F, 0.5F}) {
        const double covered = mean_coverage(wear_map({.dust = 1.0F, .size_m = size_m})).x;
        EXPECT_NEAR(covered, specks + fibres, 0.1 * (specks + fibres)) << size_m;
    }
}

/// 170 000 scratches per square metre, 15 mm long and 12 micrometres wide in the mean.
TEST(WearMap, ScratchesCoverTheirLengthTimesTheirWidth) {
    const double expected = 0.3 * 170'000.0 * 15e-3 * 12e-6 * kTaper;
    for (const float size_m : {0.06F, 0.12F, 0.25F}) {  // more cross in larger texels
        const double covered = mean_coverage(wear_map({.scratches = 0.3F, .size_m = size_m})).z;
        EXPECT_NEAR(covered, expected, 0.15 * expected) << size_m;
    }
}

TEST(WearMap, PrintsAreFingersWide) {
    const image::ByteImage map = wear_map({.fingerprints = 0.5F, .size_m = 0.06F});  // one
    EXPECT_GT(mean_coverage(map).y, 0.003);
    EXPECT_LT(mean_coverage(map).y, 0.03);
    int columns = 0;
    for (int column = 0; column < kWearTexels; ++column) {
        bool marked = false;
        for (int row = 0; row < kWearTexels; ++row)
            marked = marked || map.rgba[4 * static_cast<std::size_t>(row * kWearTexels + column) + 1] != 0;
        columns += marked;
    }
    EXPECT_GT(columns, kWearTexels * 12 / 60);
    EXPECT_LT(columns, kWearTexels * 25 / 60);
}

TEST(WearMap, AMaskKeepsItsWhitePart) {
    const Wear wear{.scratches = 1.0F, .fingerprints = 1.0F, .dust = 1.0F};
    const image::ByteImage whole = wear_map(wear);
    image::ByteImage masked = whole;
    mask_wear({2, 1, {255, 0, 0, 255, 0, 255, 255, 255}}, masked);  // red to the left
    const auto texel = [](const image::ByteImage& map, int column) {
        const auto first = map.rgba.begin() + std::ptrdiff_t{4} * (500 * kWearTexels + column);
        return std::vector<std::uint8_t>(first, first + 4);
    };
    for (int column = 0; column < 256; ++column) EXPECT_EQ(texel(masked, column), texel(whole, column)) << column;
    for (int column = 768; column < 1024; ++column)
        EXPECT_THAT(texel(masked, column), testing::ElementsAre(0, 0, 128, 128)) << column;
}

/// A file with two materials of one wear.
json with_wear(const json& wear) {
    json file = test::document(5);
    const std::array<std::uint8_t, 3> grey = {0, 0, 0};
    file["images"] = {{{"uri", test::data_uri(rowland::test::encoded_jpeg(1, 1, grey), "image/jpeg")}}};
    file["textures"] = {{{"source", 0}}};
    const json material = {{"extensions", {{"ROWLAND_materials_wear", wear}}}};
    file["materials"] = {material, material};
    file["extensionsUsed"] = {"ROWLAND_materials_wear"};
    return file;
}

TEST(GltfWear, EqualWearIsOneTexture) {
    const ImportedScene scene = load(with_wear({{"scratches", 0.25},
                                                {"fingerprints", 0.5},
                                                {"dust", 0.125},
                                                {"size_m", 0.3},
                                                {"seed", 2147483647},
                                                {"texCoord", 1}}));
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.textures.size(), 2U);
    EXPECT_TRUE(scene.materials[0].extensions.empty());
    EXPECT_EQ(scene.materials[0].wear, (Wear{0.25F, 0.5F, 0.125F, 0.3F, 2147483647U}));
    for (const MaterialDescription& material : scene.materials) {
        ASSERT_TRUE(material.wear_texture);
        EXPECT_EQ(material.wear_texture->texture, 1U);
        EXPECT_EQ(material.wear_texture->uv_set, 1);
    }
    EXPECT_EQ(scene.images[scene.textures[1].image]->rgba, wear_map(*scene.materials[0].wear).rgba);
}

TEST(GltfWear, ABlackMaskLeavesNothing) {
    json file = with_wear({{"dust", 1.0}});
    file["materials"][1]["extensions"]["ROWLAND_materials_wear"]["maskTexture"] = {{"index", 0}};
    const ImportedScene scene = load(file);
    ASSERT_EQ(scene.textures.size(), 3U);
    EXPECT_GT(mean_coverage(*scene.images[scene.textures[1].image]).x, 0.01);
    EXPECT_EQ(mean_coverage(*scene.images[scene.textures[2].image]), glm::dvec3(0.0));
}

TEST(GltfWear, WhatIsNoWearIsRefused) {
    for (const auto& [wear, place] : {std::pair<json, const char*>{{{"dust", 1.5}}, "/dust"},
                                      {{{"size_m", 0.0}}, "/size_m"},
                                      {{{"size_m", 3.0}}, "/size_m"},
                                      {{{"seed", -1}}, "/seed"},
                                      {{{"texCoord", 2}}, "/texCoord"},
                                      {{{"maskTexture", {{"index", 1}}}}, "/maskTexture/index"}})
        EXPECT_THAT(error_of(with_wear(wear)),
                    HasSubstr(std::string("/materials/0/extensions/ROWLAND_materials_wear") + place));
    json file = with_wear({});
    for (int i = 0; i < 17; ++i)
        file["materials"][static_cast<std::size_t>(i)] = {{"extensions", {{"ROWLAND_materials_wear", {{"seed", i}}}}}};
    EXPECT_THAT(error_of(file), HasSubstr("more than 16 different"));
}

}  // namespace
}  // namespace rowland::scene
