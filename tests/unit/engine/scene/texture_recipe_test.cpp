#include "engine/scene/texture_recipe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "engine/core/json_reader.h"
#include "engine/core/parallel.h"
#include "tests/support/message_of.h"

namespace rowland::scene {
namespace {

TextureRecipe texture_of(const std::string& text) {
    const nlohmann::json document = parse_json(text, "t.json");
    JsonReader reader(document, "t.json");
    TextureRecipe recipe = parse_texture(reader);
    reader.finish();
    return recipe;
}

/// Channel `c` of the texel at a column and a row from the top.
int texel(const TextureRecipe& recipe, const PaintedTexture& painted, int column, int row, int c) {
    return painted.texels[static_cast<std::size_t>((row * recipe.width + column) * painted.channels + c)];
}

TEST(TextureRecipe, LayersCoverThoseBefore) {
    const TextureRecipe recipe = texture_of(R"({"size": [64, 64], "layers": [
        {"pattern": "all", "r": 1, "g": 0.2},
        {"pattern": "rosette", "centre": [0.5, 0.5], "radius": 0.25, "g": 0.6}]})");
    const PaintedTexture painted = paint(recipe);
    EXPECT_EQ(painted.channels, 3);
    EXPECT_EQ(texel(recipe, painted, 0, 0, 0), 255);
    EXPECT_EQ(texel(recipe, painted, 0, 0, 1), 51);
    EXPECT_EQ(texel(recipe, painted, 32, 32, 0), 255);
    EXPECT_EQ(texel(recipe, painted, 32, 32, 1), 153);
    EXPECT_EQ(texel(recipe, painted, 32, 32, 2), 0);
}

TEST(TextureRecipe, RosetteCoversItsArea) {
    const TextureRecipe recipe = texture_of(R"({"size": [512, 256], "layers": [
        {"pattern": "rosette", "centre": [1, 0.5], "radius": 0.4, "petals": 6, "petal_depth": 0.5, "r": 1}]})");
    const PaintedTexture painted = paint(recipe);
    double covered = 0.0;
    for (std::size_t i = 0; i < painted.texels.size(); i += 3) covered += painted.texels[i] / 255.0;
    // ∫ r(φ)² dφ / 2 with r = R (1 − d/2 + d/2 cos 6φ) is π R² ((1 − d/2)² + d²/8); the edge's texels are all or
    // nothing, which for a boundary of some 1000 texels errs by about their root.
    const double expected = std::numbers::pi * 0.16 * (0.75 * 0.75 + 0.25 / 8.0) * 256.0 * 256.0;
    EXPECT_NEAR(covered / expected, 1.0, 5e-3);
}

TEST(TextureRecipe, AngleRunsCounterClockwiseFromTheRight) {
    const TextureRecipe recipe = texture_of(R"({"size": [101, 101], "layers": [
        {"pattern": "rosette", "centre": [0.5, 0.5], "radius": 0.5,
         "r": {"by": "angle", "from": 0, "to": 1}, "g": {"by": "angle", "from": 0, "to": 1, "repeat": 2}}]})");
    const PaintedTexture painted = paint(recipe);
    EXPECT_EQ(texel(recipe, painted, 90, 50, 0), 0);
    EXPECT_EQ(texel(recipe, painted, 50, 10, 0), 64);   // a quarter, above
    EXPECT_EQ(texel(recipe, painted, 10, 50, 0), 128);  // half
    EXPECT_EQ(texel(recipe, painted, 50, 90, 0), 191);
    EXPECT_EQ(texel(recipe, painted, 50, 10, 1), 128);
    EXPECT_EQ(texel(recipe, painted, 10, 50, 1), 0);
    EXPECT_EQ(texel(recipe, painted, 50, 90, 1), 128);
}

TEST(TextureRecipe, RampsHoldBeforeAndBehindTheirRange) {
    const TextureRecipe recipe = texture_of(R"({"size": [100, 10], "layers": [{"pattern": "all",
        "r": {"by": "x", "from": 1, "to": 0, "over": [0.25, 0.75]}, "g": {"by": "y", "from": 0, "to": 1}}]})");
    const PaintedTexture painted = paint(recipe);
    EXPECT_EQ(texel(recipe, painted, 10, 0, 0), 255);
    EXPECT_EQ(texel(recipe, painted, 90, 0, 0), 0);
    // The middles of columns 49 and 50 are a hundredth of the ramp apart around its middle.
    EXPECT_EQ(texel(recipe, painted, 49, 0, 0) + texel(recipe, painted, 50, 0, 0), 255);
    EXPECT_EQ(texel(recipe, painted, 0, 9, 1), 13);  // 0.05: rows are from the top, y from the bottom
    EXPECT_EQ(texel(recipe, painted, 0, 0, 1), 242);
}

TEST(TextureRecipe, CellsHaveAValueOfTheirOwnEach) {
    const TextureRecipe recipe = texture_of(R"({"size": [300, 300], "layers": [
        {"pattern": "hexagons", "size": 0.1, "gap": 0.2, "r": {"by": "cell", "from": 0.1, "to": 1}}]})");
    const PaintedTexture painted = paint(recipe);
    std::set<int> values;
    std::size_t free = 0;
    for (std::size_t i = 0; i < painted.texels.size(); i += 3) {
        values.insert(painted.texels[i]);
        free += painted.texels[i] == 0;
    }
    // 100 hexagons of 30 texels, and those at the edges; 230 steps of grey.
    EXPECT_GT(values.size(), 80U);
    // A gap of a fifth of the width leaves 1 − 0.8² of the area; edges count 30 texels of some 300 around each of them.
    EXPECT_NEAR(static_cast<double>(free) / 90000.0, 0.36, 0.02);
}

TEST(TextureRecipe, TilesAreWhereTheirSizeSays) {
    const TextureRecipe recipe = texture_of(R"({"size": [40, 20], "layers": [
        {"pattern": "tiles", "size": [1, 0.5], "gap": 0.2, "r": 1}]})");
    const PaintedTexture painted = paint(recipe);
    // Tiles of 20 × 10 texels with a gap of 2 between them, so 1 at each side.
    for (int column = 0; column < 40; ++column)
        for (int row = 0; row < 20; ++row) {
            const bool inside = column % 20 >= 1 && column % 20 < 19 && row % 10 >= 1 && row % 10 < 9;
            EXPECT_EQ(texel(recipe, painted, column, row, 0), inside ? 255 : 0) << column << " " << row;
        }
}

TEST(TextureRecipe, PaintedAlphaMakesAFourthChannel) {
    const TextureRecipe recipe =
        texture_of(R"({"size": [4, 1], "layers": [{"pattern": "tiles", "size": [2, 1], "a": 0.4}]})");
    const PaintedTexture painted = paint(recipe);
    EXPECT_EQ(painted.channels, 4);
    EXPECT_EQ(painted.texels.size(), 16U);
    EXPECT_EQ(texel(recipe, painted, 3, 0, 3), 102);
}

TEST(TextureRecipe, AnyNumberOfThreadsGivesTheSameBytes) {
    const TextureRecipe recipe = texture_of(R"({"size": [128, 96], "layers": [
        {"pattern": "hexagons", "size": 0.07, "r": {"by": "cell", "from": 0, "to": 1}},
        {"pattern": "rosette", "centre": [0.6, 0.5], "radius": 0.4, "petals": 7, "rings": 5,
         "g": {"by": "radius", "from": 0, "to": 1}}]})");
    const std::vector<std::uint8_t> all = paint(recipe).texels;
    const ThreadLimit limit(1);
    EXPECT_EQ(paint(recipe).texels, all);
}

TEST(TextureRecipe, RefusalsNameTheirPlace) {
    using rowland::test::message_of;
    using testing::HasSubstr;
    EXPECT_THAT(message_of([] { texture_of(R"({"size": [4, 4.5], "layers": []})"); }), HasSubstr("t.json: /size/1"));
    EXPECT_THAT(message_of([] { texture_of(R"({"size": [4, 4], "layers": [{"pattern": "hexagon"}]})"); }),
                testing::AllOf(HasSubstr("/layers/0/pattern"), HasSubstr("\"hexagons\"")));
    EXPECT_THAT(message_of([] { texture_of(R"({"size": [4, 4], "layers": [{"pattern": "all", "r": 2}]})"); }),
                HasSubstr("/layers/0/r"));
    EXPECT_THAT(message_of([] {
                    texture_of(R"({"size": [4, 4], "layers": [{"pattern": "all",
                              "r": {"by": "x", "from": 0, "to": 1, "over": [0.5, 0.5]}}]})");
                }),
                HasSubstr("/layers/0/r/over/1"));
}

}  // namespace
}  // namespace rowland::scene
