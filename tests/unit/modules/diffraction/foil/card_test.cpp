#include "modules/diffraction/foil/card.h"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/scene/gltf_import.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "tests/support/expect.h"
#include "tests/unit/modules/diffraction/foil/pictures.h"

namespace rowland::diffraction::foil {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::vector<std::string> kHandled = {kGltfExtension};

NamedPicture picture(const std::string& name, int width, int height,
                     const std::function<glm::u8vec4(int, int)>& colour) {
    return {name, drawn_png(width, height, colour)};
}

/// A card of 64 × 64 mm, 512 texels wide.
Recipe square_recipe(FoilType type = CrackedIce{}) {
    Recipe recipe;
    recipe.artwork = "a.png";
    recipe.foil.type = std::move(type);
    recipe.card = {.width_mm = 64.0, .height_mm = 64.0};
    recipe.texture_px = 512;
    return recipe;
}

NamedPicture opaque_artwork() {
    return picture("a.png", 64, 64, [](int column, int row) { return glm::u8vec4(4 * column, 4 * row, 90, 255); });
}

scene::ImportedScene imported(const Recipe& recipe, const NamedPictures& pictures) {
    return scene::load_glb(make_card(recipe, pictures, "card.json"), "card.glb", kHandled);
}

const scene::MaterialDescription& front_of(const scene::ImportedScene& card) {
    EXPECT_EQ(card.materials.at(0).name, "Front");
    return card.materials.at(0);
}

const image::ByteImage& texture_of(const scene::ImportedScene& card, std::size_t texture) {
    return *card.images.at(card.textures.at(texture).image);
}

const image::ByteImage& grooves_of(const scene::ImportedScene& card) {
    return texture_of(card, front_of(card).extensions.at(kGltfExtension).at("grooveTexture").at("index"));
}

/// Index of the red value of a texel.
std::size_t at(const image::ByteImage& image, int column, int row) {
    return 4 * static_cast<std::size_t>(row * image.width + column);
}

TEST(FoilCard, IsImportedWithFrontBackAndEdge) {
    const scene::ImportedScene card = imported(square_recipe(), {{"a.png", opaque_artwork()}});
    ASSERT_EQ(card.meshes.size(), 3U);
    EXPECT_THAT(card.warnings, testing::IsEmpty());
    const scene::Mesh& front = card.meshes[0];
    for (std::size_t i = 0; i < front.positions.size(); ++i) {
        EXPECT_EQ(front.normals[i], glm::vec3(0.0F, 0.0F, 1.0F));
        EXPECT_EQ(front.tangents[i], glm::vec4(1.0F, 0.0F, 0.0F, 1.0F));
        EXPECT_NEAR(front.uvs[i].x, 0.5F + front.positions[i].x / 0.064F, 1e-5F);
        EXPECT_NEAR(front.uvs[i].y, 0.5F - front.positions[i].y / 0.064F, 1e-5F);
        EXPECT_NEAR(front.positions[i].z, 0.00016F, 1e-7F);
    }
    EXPECT_NO_THROW(parse_gltf_extension(front_of(card).extensions.at(kGltfExtension), "card.glb", ReadNamed{}, ""));
}

/// Area and outward orientation of all triangles.
TEST(FoilCard, MeshIsClosedAndHasTheCardsVolume) {
    for (const double corner_mm : {0.0, 3.0, 32.0}) {
        Recipe recipe = square_recipe();
        recipe.card.corner_mm = corner_mm;
        const scene::ImportedScene card = imported(recipe, {{"a.png", opaque_artwork()}});
        double volume = 0.0;
        for (const scene::Mesh& mesh : card.meshes)
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
                const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
                const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
                volume += glm::dot(a, glm::cross(b, c)) / 6.0;
                EXPECT_GT(glm::dot(glm::cross(b - a, c - a), glm::dvec3(mesh.normals[mesh.indices[i]])), 0.0);
            }
        const double corners = (4.0 - 3.14159265) * corner_mm * corner_mm;
        // An arc of twelve steps lies 0.3 % of its area inside the circle.
        EXPECT_NEAR(volume * 1e9, (64.0 * 64.0 - corners) * 0.32, 0.004 * 3.2 * corner_mm * corner_mm * 0.32 + 1e-3);
    }
}

TEST(FoilCard, EqualRecipesGiveEqualBytes) {
    for (const std::string_view name : foil_type_names()) {
        Recipe recipe = square_recipe(*foil_type(name));
        if (auto* two = std::get_if<TwoPictures>(&recipe.foil.type)) two->pictures = {"a.png", "a.png"};
        if (auto* own = std::get_if<Own>(&recipe.foil.type)) own->drawing = "a.png";
        const NamedPictures pictures = {{"a.png", opaque_artwork()}};
        const auto many = make_card(recipe, pictures, "card.json");
        const ThreadLimit limit(1);
        EXPECT_EQ(make_card(recipe, pictures, "card.json"), many) << name;
    }
}

TEST(FoilCard, TheMaskSaysWhereThereIsFoil) {
    Recipe recipe = square_recipe();
    recipe.mask = "m.png";
    // White on the left; twice as many texels as the artwork.
    const NamedPicture mask = picture(
        "m.png", 128, 128, [](int column, int) { return column < 64 ? glm::u8vec4(255) : glm::u8vec4(0, 0, 0, 255); });
    const scene::ImportedScene card = imported(recipe, {{"a.png", opaque_artwork()}, {"m.png", mask}});
    const image::ByteImage& grooves = grooves_of(card);
    ASSERT_FALSE(grooves.rgba16.empty());
    EXPECT_EQ(grooves.rgba16[at(grooves, 200, 100) + 1], 32768);
    EXPECT_EQ(grooves.rgba16[at(grooves, 300, 100) + 1], 0);
    // The picture covers paper and foil alike, so that its own file serves.
    EXPECT_EQ(texture_of(card, front_of(card).base_colour_texture->texture).width, 64);
}

TEST(FoilCard, InkThatCoversHidesTheFoilAndTheMetal) {
    const NamedPicture artwork = picture(
        "a.png", 64, 64, [](int, int row) { return row < 32 ? glm::u8vec4(200, 30, 30, 255) : glm::u8vec4(0); });
    const scene::ImportedScene card = imported(square_recipe(), {{"a.png", artwork}});
    const image::ByteImage& grooves = grooves_of(card);
    EXPECT_EQ(grooves.rgba16[at(grooves, 100, 100) + 1], 0);
    EXPECT_EQ(grooves.rgba16[at(grooves, 100, 400) + 1], 32768);
    const scene::MaterialDescription& front = front_of(card);
    const image::ByteImage& surface = texture_of(card, front.metallic_roughness_texture->texture);
    EXPECT_EQ(surface.rgba[at(surface, 100, 100) + 2], 0) << "ink is no metal";
    EXPECT_EQ(surface.rgba[at(surface, 100, 400) + 2], 255);
    const image::ByteImage& colour = texture_of(card, front.base_colour_texture->texture);
    EXPECT_EQ(colour.rgba[at(colour, 100, 100)], 200);
    EXPECT_EQ(colour.rgba[at(colour, 100, 400)], 245);
    EXPECT_EQ(front.extensions.at(kGltfExtension).at("grating").at("profile").at("type"), "sinusoidal");
}

TEST(FoilCard, OneDirectionEverywhereNeedsNoTexture) {
    const scene::ImportedScene card = imported(square_recipe(Rainbow{}), {{"a.png", opaque_artwork()}});
    EXPECT_FALSE(front_of(card).extensions.at(kGltfExtension).contains("grooveTexture"));
}

TEST(FoilCard, ArtworkOfOtherProportionsFillsTheCard) {
    Recipe recipe = square_recipe();
    // A band of green to the left and to the right of what fits.
    const NamedPicture wide = picture("a.png", 192, 64, [](int column, int) {
        return column < 64 || column >= 128 ? glm::u8vec4(0, 255, 0, 255) : glm::u8vec4(200, 0, 0, 255);
    });
    const scene::ImportedScene card = imported(recipe, {{"a.png", wide}});
    const image::ByteImage& colour = texture_of(card, front_of(card).base_colour_texture->texture);
    EXPECT_EQ(colour.width, 512);
    EXPECT_EQ(colour.rgba[at(colour, 256, 256)], 200);
    EXPECT_EQ(colour.rgba[at(colour, 20, 256)], 200);
}

TEST(FoilCard, PicturesThatDoNotServeAreRefused) {
    const auto refusal_of = [](const Recipe& recipe, const NamedPictures& pictures) {
        return test::message_of([&] { make_card(recipe, pictures, "card.json"); });
    };
    const auto grey = [](int, int) { return glm::u8vec4(128, 128, 128, 255); };
    EXPECT_THAT(refusal_of(square_recipe(), {{"a.png", picture("a.png", 1, 1, grey)}}),
                HasSubstr("a.png: 1 x 1 texels; expected at least 16 x 16"));
    EXPECT_THAT(refusal_of(square_recipe(), {{"a.png", picture("a.png", 9000, 16, grey)}}),
                HasSubstr("9000 x 16 texels; expected at most 8192 x 8192"));
    NamedPicture broken = opaque_artwork();
    broken.bytes.resize(broken.bytes.size() / 2);
    EXPECT_THAT(refusal_of(square_recipe(), {{"a.png", broken}}), HasSubstr("a.png: "));
    Recipe masked = square_recipe();
    masked.mask = "m.png";
    EXPECT_THAT(refusal_of(masked, {{"a.png", opaque_artwork()}, {"m.png", picture("m.png", 64, 32, grey)}}),
                AllOf(HasSubstr("m.png: a mask of 64 x 32"), HasSubstr("which has 64 x 64")));
    const auto black = [](int, int) { return glm::u8vec4(0, 0, 0, 255); };
    EXPECT_THAT(refusal_of(masked, {{"a.png", opaque_artwork()}, {"m.png", picture("m.png", 64, 64, black)}}),
                HasSubstr("a mask that is black everywhere"));
    Recipe covered = square_recipe();
    covered.ink = Ink::Covers;
    EXPECT_THAT(refusal_of(covered, {{"a.png", opaque_artwork()}}), HasSubstr("ink over all of the foil"));
    Recipe tinted = square_recipe();
    tinted.lacquer = {.gloss = false, .tint = glm::dvec3(1.0, 0.5, 0.5)};
    EXPECT_THAT(refusal_of(tinted, {{"a.png", opaque_artwork()}}), HasSubstr("card.json: /lacquer/tint"));
}

TEST(FoilCard, StepsAreReported) {
    std::atomic<std::size_t> steps = 0;
    make_card(square_recipe(), {{"a.png", opaque_artwork()}}, "card.json", [&] { ++steps; });
    EXPECT_EQ(steps, kCardSteps);
}

}  // namespace
}  // namespace rowland::diffraction::foil
