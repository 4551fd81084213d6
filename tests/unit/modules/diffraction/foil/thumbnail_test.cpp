#include "modules/diffraction/foil/thumbnail.h"

#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "engine/core/error.h"
#include "tests/unit/modules/diffraction/foil/pictures.h"

namespace rowland::diffraction::foil {
namespace {

constexpr int kHeight = 40;

/// Opaque ink on the left half, nothing on the right one.
NamedPictures half_inked() {
    return {{"a.png", {"a.png", drawn_png(60, 80, [](int column, int) {
                           return glm::u8vec4(200, 40, 90, column < 30 ? 255 : 0);
                       })}}};
}

Recipe recipe_of(FoilType type) {
    Recipe recipe;
    recipe.artwork = "a.png";
    recipe.foil.type = std::move(type);
    recipe.card = {.width_mm = 60.0, .height_mm = 80.0};
    return recipe;
}

glm::mat3 turned(float degrees) {
    return glm::mat3(glm::rotate(glm::mat4(1.0F), glm::radians(degrees), {0.0F, 1.0F, 0.0F}));
}

std::vector<std::uint8_t> drawn(const Thumbnail& thumbnail, const glm::mat3& tilt) {
    std::vector<std::uint8_t> rgba(std::size_t{4} * static_cast<std::size_t>(thumbnail.width() * thumbnail.height()));
    thumbnail.draw(tilt, rgba);
    return rgba;
}

/// The colours of one half of a picture.
std::vector<glm::u8vec3> half(const std::vector<std::uint8_t>& rgba, int width, bool right) {
    std::vector<glm::u8vec3> colours;
    for (std::size_t i = 0; i < rgba.size() / 4; ++i)
        if ((static_cast<int>(i) % width >= width / 2) == right)
            colours.emplace_back(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]);
    return colours;
}

TEST(FoilThumbnail, PrintStaysAsItIsWhileFoilChangesWithTheTilt) {
    const Thumbnail thumbnail(recipe_of(Rainbow{}), half_inked(), "card.json", kHeight);
    EXPECT_EQ(thumbnail.width(), 30);
    EXPECT_EQ(thumbnail.height(), kHeight);
    const auto left = drawn(thumbnail, turned(-9.0F));
    const auto right = drawn(thumbnail, turned(9.0F));
    EXPECT_EQ(half(left, 30, false), half(right, 30, false));
    const glm::u8vec3 ink = half(left, 30, false).front();
    EXPECT_GT(ink.r, ink.b);
    EXPECT_GT(ink.b, ink.g);
    EXPECT_NE(half(left, 30, true), half(right, 30, true));
}

/// The largest difference of two channels of a pixel.
int most_colour(const std::vector<glm::u8vec3>& colours) {
    int most = 0;
    for (const glm::u8vec3& rgb : colours)
        most = std::max(most, std::max({rgb.r, rgb.g, rgb.b}) - std::min({rgb.r, rgb.g, rgb.b}));
    return most;
}

TEST(FoilThumbnail, GroovesHaveTheColoursOfTheirDistance) {
    Recipe recipe = recipe_of(CrackedIce{});
    const auto foil = [&] {
        const Thumbnail thumbnail(recipe, half_inked(), "card.json", kHeight);
        return half(drawn(thumbnail, turned(0.0F)), 30, true);
    };
    EXPECT_GT(most_colour(foil()), 60);
    // The path differences of all lamps are below the shortest wavelength.
    recipe.foil.groove_um = 0.5;
    EXPECT_LT(most_colour(foil()), 4);
}

TEST(FoilThumbnail, TypesDiffer) {
    std::set<std::vector<std::uint8_t>> pictures;
    std::size_t types = 0;
    for (const std::string_view name : foil_type_names()) {
        FoilType type = *foil_type(name);
        if (auto* two = std::get_if<TwoPictures>(&type)) two->pictures = {"a.png", "a.png"};
        if (auto* own = std::get_if<Own>(&type)) own->drawing = "a.png";
        pictures.insert(drawn(Thumbnail(recipe_of(type), half_inked(), "card.json", kHeight), turned(0.0F)));
        ++types;
    }
    EXPECT_EQ(pictures.size(), types);
}

TEST(FoilThumbnail, RefusesWhatACardRefuses) {
    Recipe recipe = recipe_of(Rainbow{});
    recipe.lacquer = {.gloss = false, .tint = glm::dvec3(1.0, 0.5, 0.2)};
    EXPECT_THROW(Thumbnail(recipe, half_inked(), "card.json", kHeight), Error);
}

}  // namespace
}  // namespace rowland::diffraction::foil
