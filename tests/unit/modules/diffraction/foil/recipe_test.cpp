#include "modules/diffraction/foil/recipe.h"

#include <gmock/gmock.h>

#include "tests/support/expect.h"

namespace rowland::diffraction::foil {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Recipe parsed(const std::string& text) {
    return parse_foil_recipe(parse_json(text, "card.json"), "card.json");
}

std::string refusal_of(const std::string& text) {
    return test::message_of([&] { parsed(text); });
}

TEST(FoilRecipe, AnArtworkAloneIsACard) {
    const Recipe recipe = parsed(R"({"artwork": "a.png"})");
    EXPECT_EQ(recipe.artwork, "a.png");
    EXPECT_TRUE(std::holds_alternative<CrackedIce>(recipe.foil.type));
    EXPECT_FALSE(recipe.ink);
    EXPECT_EQ(recipe.card.width_mm, 63.0);
}

TEST(FoilRecipe, EachTypeReadsItsNumbers) {
    for (const std::string_view name : foil_type_names()) {
        ASSERT_TRUE(foil_type(name)) << name;
        std::string more;
        if (name == "two_pictures") more = R"(, "picture_a": "a.png", "picture_b": "b.png")";
        if (name == "own") more = R"(, "drawing": "a.png")";
        const Recipe recipe = parsed(R"({"artwork": "a.png", "foil": {"type": ")" + std::string(name) +
                                     R"(", "direction_deg": 30, "scale": 2)" + more + "}}");
        EXPECT_EQ(recipe.foil.type.index(), foil_type(name)->index());
        EXPECT_EQ(recipe.foil.direction_deg, 30.0);
    }
    const Recipe recipe = parsed(
        R"({"artwork": "a.png", "mask": "m.png", "ink": "covers", "under": "paper", "texture_px": 512,
            "foil": {"type": "tiles", "size_mm": 2.5, "directions": 3, "spread_deg": 5, "groove_um": 1.2},
            "lacquer": {"tint": [1, 0.8, 0.3]}, "card": {"width_mm": 40, "corner_mm": 0, "back": "b.png"}})");
    const auto& tiles = std::get<Tiles>(recipe.foil.type);
    EXPECT_EQ(tiles.size_mm, 2.5);
    EXPECT_EQ(tiles.directions, 3);
    EXPECT_EQ(recipe.foil.spread_deg, 5.0);
    EXPECT_EQ(recipe.ink, Ink::Covers);
    EXPECT_EQ(recipe.under, Under::Paper);
    EXPECT_EQ(recipe.lacquer.tint, glm::dvec3(1.0, 0.8, 0.3));
    EXPECT_EQ(recipe.card.back, "b.png");
}

TEST(FoilRecipe, WrongNamesAndNumbersAreNamed) {
    EXPECT_THAT(refusal_of(R"({"artwork": "a.png", "foill": {}})"),
                AllOf(HasSubstr("card.json: /foill"), HasSubstr("is \"foil\" meant?")));
    EXPECT_THAT(refusal_of(R"({"artwork": "a.png", "foil": {"type": "cosmo"}})"),
                AllOf(HasSubstr("/foil/type"), HasSubstr("is \"cosmos\" meant?")));
    EXPECT_THAT(refusal_of(R"({"artwork": "a.png", "foil": {"type": "tiles", "band_mm": 2}})"),
                HasSubstr("/foil/band_mm: unknown key"));
    EXPECT_THAT(refusal_of(R"({"artwork": "a.png", "foil": {"type": "tiles", "size_mm": -1}})"),
                AllOf(HasSubstr("/foil/size_mm: -1"), HasSubstr("[0.1, 200]")));
    EXPECT_THAT(refusal_of(R"({"artwork": "a.png", "texture_px": 10000})"), HasSubstr("[512, 4096]"));
    EXPECT_THAT(refusal_of(R"({"artwork": "a.png", "ink": "tints"})"), HasSubstr("one of covers, lets_through"));
    EXPECT_THAT(refusal_of(R"({"artwork": ""})"), HasSubstr("/artwork"));
    EXPECT_THAT(refusal_of(R"({"artwork": "a.png", "card": {"corner_mm": 40}})"),
                AllOf(HasSubstr("/card/corner_mm"), HasSubstr("31.5")));
    EXPECT_THAT(refusal_of(R"({"artwork": "a.png", "foil": {"type": "pillars", "spread_deg": 5}})"),
                HasSubstr("leave spread_deg out"));
}

TEST(FoilRecipe, TiltsThatShowBothPicturesAreRefusedWithBetterOnes) {
    const std::string two = R"({"artwork": "a.png", "foil": {"type": "two_pictures", "picture_a": "a.png",)"
                            R"( "picture_b": "b.png", "tilts_deg": )";
    EXPECT_THAT(refusal_of(two + "[-10, -5]}}"), AllOf(HasSubstr("/foil/tilts_deg"), HasSubstr("try -10 and ")));
    EXPECT_THAT(refusal_of(two + "[-10, 20]}}"), AllOf(HasSubstr("/foil/tilts_deg/1"), HasSubstr("mirrors the lamp")));
    EXPECT_NO_THROW(parsed(two + "[-10, 10]}}"));
}

}  // namespace
}  // namespace rowland::diffraction::foil
