#include "editor/inspector/foil_recipe.h"

#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "modules/diffraction/foil/card.h"
#include "tests/support/folder_test.h"

namespace rowland::inspector {
namespace {

namespace foil = diffraction::foil;
using testing::HasSubstr;

class FoilRecipeTest : public test::FolderTest {
 protected:
    FoilRecipeTest() { write_picture("art.png", 48, 64); }

    void write_picture(const std::string& name, int width, int height) {
        std::vector<std::uint8_t> rgba;
        for (int i = 0; i < width * height; ++i)
            rgba.insert(rgba.end(), {static_cast<std::uint8_t>(200 + i % 50), 220, 240, 255});
        write_file_atomic(path(name), image::encode_png(width, height, 4, rgba));
    }
    static const Field& field(const FoilRecipe& recipe, const std::string& pointer) {
        return *std::ranges::find(recipe.fields(), pointer, &Field::pointer);
    }
    static bool has_field(const FoilRecipe& recipe, const std::string& pointer) {
        return std::ranges::count(recipe.fields(), pointer, &Field::pointer) > 0;
    }
    std::vector<std::byte> card(const FoilRecipe& recipe) const {
        foil::Recipe small = recipe.accepted();
        small.texture_px = 64;
        return foil::make_card(small, recipe.pictures()->of(small, 32), recipe.name());
    }
};

TEST_F(FoilRecipeTest, FieldsOfAllTypesHaveTheParsersRangesAndTheTypesDefaults) {
    for (const std::string_view type : foil::foil_type_names()) {
        FoilRecipe recipe = FoilRecipe::make_new(path("art.png"));
        recipe.set_type(type);
        ASSERT_EQ(recipe.refusal(), "") << type;
        for (const Field& each : recipe.fields()) {
            if (each.kind != FieldKind::Number && each.kind != FieldKind::Count) continue;
            ASSERT_TRUE(each.default_value.is_number()) << type << each.pointer;
            EXPECT_GE(each.default_value.get<double>(), each.minimum) << type << each.pointer;
            EXPECT_LE(each.default_value.get<double>(), each.maximum) << type << each.pointer;
            const double beyond = 2.0 * each.maximum + 1.0;
            recipe.set(each, each.kind == FieldKind::Count ? Json(std::llround(beyond)) : Json(beyond));
            EXPECT_EQ(recipe.field_of(recipe.refusal()), &each) << type << each.pointer << ": " << recipe.refusal();
            recipe.set(each, nullptr);
            recipe.finish_edit();
        }
    }
    FoilRecipe recipe = FoilRecipe::make_new(path("art.png"));
    EXPECT_EQ(field(recipe, "/foil/size_mm").default_value, foil::CrackedIce().size_mm);
    recipe.set_type("cosmos");
    EXPECT_EQ(field(recipe, "/foil/size_mm").default_value, foil::Cosmos().size_mm);
    EXPECT_FALSE(has_field(recipe, "/foil/band_mm"));
    recipe.set_type("pillars");
    EXPECT_FALSE(has_field(recipe, "/foil/spread_deg"));
}

TEST_F(FoilRecipeTest, AnotherTypeKeepsWhatIsCommonAndATypeItsNumbers) {
    FoilRecipe recipe = FoilRecipe::make_new(path("art.png"));
    recipe.set_type("tiles");
    recipe.set(field(recipe, "/foil/size_mm"), 2.5);
    recipe.set(field(recipe, "/foil/scale"), 3);
    recipe.set(field(recipe, "/foil/spread_deg"), 4);
    recipe.set_type("two_pictures");
    EXPECT_EQ(recipe.accepted().foil.scale, 3.0);
    EXPECT_EQ(std::get<foil::TwoPictures>(recipe.accepted().foil.type).pictures.at(0), path("art.png"));
    recipe.set_type("tiles");
    EXPECT_EQ(std::get<foil::Tiles>(recipe.accepted().foil.type).size_mm, 2.5);
    EXPECT_EQ(recipe.refusal(), "");
}

TEST_F(FoilRecipeTest, EditsOfOneFieldAreOneStepOfUndo) {
    FoilRecipe recipe = FoilRecipe::make_new(path("art.png"));
    EXPECT_FALSE(recipe.can_undo());
    const Field& scale = field(recipe, "/foil/scale");
    for (const double value : {1.5, 2.0, 2.5}) recipe.set(scale, value);
    recipe.finish_edit();
    recipe.set(scale, 4.0);
    recipe.undo();
    EXPECT_EQ(recipe.accepted().foil.scale, 2.5);
    recipe.undo();
    EXPECT_EQ(recipe.accepted().foil.scale, 1.0);
    EXPECT_FALSE(recipe.can_undo());
    recipe.redo();
    EXPECT_EQ(recipe.accepted().foil.scale, 2.5);
    recipe.set(scale, scale.default_value);
    EXPECT_EQ(recipe.json()["foil"], Json({{"type", "cracked_ice"}})) << "defaults are not written";
    EXPECT_FALSE(recipe.can_redo());
}

TEST_F(FoilRecipeTest, IsReadAsItWasSavedAlsoFromAnotherFolder) {
    write_picture("mask.png", 48, 64);
    FoilRecipe recipe = FoilRecipe::make_new(path("art.png"));
    recipe.set(field(recipe, "/mask"), path("mask.png").generic_string());
    recipe.set_type("own");
    EXPECT_TRUE(recipe.dirty());
    std::filesystem::create_directory(path("recipes"));
    recipe.save(path("recipes/card.json"));
    EXPECT_FALSE(recipe.dirty());
    EXPECT_THAT(text("recipes/card.json"), HasSubstr("\"../mask.png\""));
    const FoilRecipe again = FoilRecipe::open(path("recipes/card.json"));
    EXPECT_EQ(again.json(), recipe.json());
    EXPECT_EQ(card(again), card(recipe));
}

TEST_F(FoilRecipeTest, ARefusedValueKeepsTheLastRecipeAndABrokenPictureIsNamedAtItsField) {
    FoilRecipe recipe = FoilRecipe::make_new(path("art.png"));
    EXPECT_THROW(recipe.set(field(recipe, "/mask"), path("none.png").string()), Error);
    EXPECT_FALSE(recipe.json().contains("mask"));
    recipe.set(field(recipe, "/foil/scale"), 1000.0);
    EXPECT_EQ(recipe.accepted().foil.scale, 1.0);
    EXPECT_THROW(recipe.save(path("card.json")), Error);
    EXPECT_FALSE(std::filesystem::exists(path("card.json")));
    recipe.undo();
    EXPECT_EQ(recipe.refusal(), "");
    for (const auto& [width, height] : {std::pair(1, 1), {64, 48}}) {
        write_picture("mask.png", width, height);
        recipe.set(field(recipe, "/mask"), path("mask.png").string());
        try {
            card(recipe);
            ADD_FAILURE() << width;
        } catch (const Error& error) {
            EXPECT_EQ(recipe.field_of(error.what()), &field(recipe, "/mask")) << error.what();
        }
    }
    recipe.set(field(recipe, "/mask"), nullptr);
    recipe.set(field(recipe, "/lacquer/gloss"), false);
    recipe.set(field(recipe, "/lacquer/tint"), {1, 0.5, 0.5});
    try {
        card(recipe);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(recipe.field_of(error.what()), &field(recipe, "/lacquer/tint")) << error.what();
    }
}

}  // namespace
}  // namespace rowland::inspector
