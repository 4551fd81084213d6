// The inspector in a real window, used by real mouse and keys under Xvfb. What each step did is read from the facts
// that the inspector writes; without the step, what is expected after it fails.
#include <gmock/gmock.h>

#include <thread>

#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "engine/scene/gltf_import.h"
#include "modules/diffraction/asset/material.h"
#include "tests/support/light.h"
#include "tests/support/program.h"
#include "tests/window/inspector_user.h"

namespace rowland {
namespace {

using nlohmann::json;
using test::Facts;
using test::InspectorUser;
using test::operator""ms;
using test::operator""s;
using testing::HasSubstr;

/// The material that the inspector shows.
json material(const Facts& facts) {
    return json::parse(facts.at("material"), nullptr, false);
}

class InspectorWindow : public ::testing::Test {
 protected:
    void SetUp() override {
        ROWLAND_NEEDS_VIRTUAL_DISPLAY();
        write_file_atomic(path("sky.json"), test::small_sky(128));
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    /// A preset's material under the small probe.
    test::Command preset(const std::string& name) const { return {"--preset", name, "--probe", path("sky.json")}; }
    void save_as(InspectorUser& user, const std::string& file) const {
        user.key("ctrl+s");
        std::this_thread::sleep_for(500ms);
        user.enter(file);
    }

    test::TemporaryFolder folder_;
};

TEST_F(InspectorWindow, AMaterialIsEditedPickedLitSavedAndOpenedAgainWithItsLayout) {
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    Facts lit;
    json gold;
    std::string picture;
    {
        InspectorUser user(folder_.path(), preset("dvd"));
        user.key("Tab");
        user.enter("1000");
        EXPECT_EQ(material(user.facts())["grating"]["pitch_nm"], 1000) << "the first Tab goes to the first field";
        user.key("ctrl+z");
        user.click("menu Presets");
        user.click("menu cd");
        user.wait_for("document", "cd.json");
        const json cd = material(user.facts());
        EXPECT_EQ(cd["grating"]["pitch_nm"], 1600);

        user.drag("/grating/pitch_nm", {-86, 0});
        const json dragged = material(user.facts());
        EXPECT_EQ(dragged["grating"]["pitch_nm"], 740);
        EXPECT_EQ(dragged["grating"]["profile"]["width_nm"], 370);

        user.click("lines per mm");
        user.enter("1200");
        EXPECT_EQ(material(user.facts())["grating"]["pitch_nm"], 833.333);

        user.click("/grating/profile");
        user.click("/grating/profile=blazed");
        EXPECT_EQ(material(user.facts())["grating"]["profile"]["type"], "blazed");
        user.key("ctrl+z");
        user.key("ctrl+z");
        EXPECT_EQ(material(user.facts())["grating"]["pitch_nm"], 740);
        user.key("ctrl+z");
        EXPECT_EQ(material(user.facts()), cd);

        user.wait_for("busy", "no");
        user.pick({0.66, 0.5});
        user.wait_for("busy", "no");
        const Facts picked = user.facts();
        EXPECT_THAT(picked.at("picked"), testing::MatchesRegex("[0-9]+ [0-9]+ [0-9]+"));

        user.key("ctrl+o");
        user.type(probe.string());
        user.key("Return");
        user.wait_for("light", "venice_sunset_256.hdr");
        user.wait_for("busy", "no");
        lit = user.facts();
        EXPECT_NE(lit.at("point"), picked.at("point"));
        EXPECT_NE(lit.at("picked"), picked.at("picked"));

        user.click("/metal");
        user.click("/metal=Au");
        gold = material(user.facts());
        EXPECT_EQ(gold["metal"], "Au");

        user.key("ctrl+s");
        user.enter(path("mine.json"));
        user.wait_for("message", "saved");
        EXPECT_EQ(user.facts().at("document"), "mine.json");

        user.drag("left splitter", {40, 0});
        user.key("ctrl+equal");
        user.click("shape");
        user.click("shape=card");
        user.wait_for("shape is", "card");
        picture = user.facts().at("picture");
        EXPECT_NE(picture, lit.at("picture"));
        EXPECT_EQ(user.leave(), 0);
    }
    EXPECT_EQ(diffraction::load_material(path("mine.json")).grating.metal, colour::Metal::Au);

    InspectorUser user(folder_.path(), {path("mine.json")});
    user.wait_for("document", "mine.json");
    user.wait_for("light", "venice");  // the layout remembers it
    user.wait_for("shape is", "card");
    EXPECT_EQ(material(user.facts()), gold);
    EXPECT_EQ(user.facts().at("picture"), picture);
    EXPECT_EQ(user.leave(), 0);
}

TEST_F(InspectorWindow, ItRestsWhileNothingChangesAndOpensDroppedFilesByTheirKind) {
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    write_file_atomic(path("foil.json"), std::string_view(R"({"grating": {
        "lattice": {"a_nm": [1000, 0], "b_nm": [0, 1000]},
        "profile": {"type": "crossed", "along_a": {"type": "sinusoidal", "depth_nm": 110},
                    "along_b": {"type": "sinusoidal", "depth_nm": 110}}},
        "quality": {"representation": "direct"}})"));
    write_file_atomic(path("letter.txt"), std::string_view("A letter.\n"));
    write_file_atomic(path("rows.csv"), std::string_view("wavelength_nm,R+1\n380,0.1\n780,0.2\n"));
    InspectorUser user(folder_.path(), preset("cd"), {.folder = folder_.path()});
    user.wait_for("point", " ");
    user.wait_for("busy", "no");
    user.wait_for("unread", "0");  // news end by themselves
    user.wait_for_rest();
    const int before = user.frames();
    std::this_thread::sleep_for(2s);
    EXPECT_EQ(user.frames(), before);
    user.key("ctrl+z");
    EXPECT_GT(user.frames(), before);
    {
        SCOPED_TRACE("the lamp is dragged by its handle");
        user.click("lamp");
        user.wait_for("lamp is", "35 50");
        user.drag("lamp handle", {-40, 0});
        const Facts dragged = user.facts();
        EXPECT_LT(std::stoi(dragged.at("lamp is")), 20);
        EXPECT_FALSE(dragged.contains("picked"));
        user.click("lamp");
    }
    {
        SCOPED_TRACE("dropped files are opened by their kind");
        user.drop(probe);
        user.wait_for("light", "venice_sunset_256.hdr");
        user.drop(path("foil.json"));
        user.wait_for("document", "foil.json");
        for (const char* name : {"letter.txt", "rows.csv"}) {
            user.drop(path(name));
            user.wait_for("message", name);
        }
        const Facts dropped = user.facts();
        EXPECT_EQ(dropped.at("document"), "foil.json");
        EXPECT_EQ(dropped.at("light"), "venice_sunset_256.hdr");
    }
    {
        SCOPED_TRACE("screenshots are numbered and said");
        for (const char* name : {"screenshot_0000.png", "screenshot_0001.png"}) {
            user.key("F12");
            user.wait_for("message", name);
            EXPECT_TRUE(std::filesystem::exists(path(name)));
        }
    }
    SCOPED_TRACE("a lattice's pattern follows its fields");
    user.wait_for("pattern", " ");
    const auto pattern = [&] {
        user.wait_for("busy", "no");
        return user.facts().at("pattern");
    };
    const std::string first = pattern();
    user.drag("/grating/orders", {-15, 0});
    EXPECT_EQ(material(user.facts())["grating"]["orders"], 1);
    EXPECT_NE(pattern(), first);
    user.key("ctrl+z");
    EXPECT_EQ(pattern(), first);
    user.click("/grating/profile");
    user.click("/grating/profile=aperture");
    user.drag("/grating/profile/width_nm", {20, 0});
    EXPECT_GT(material(user.facts())["grating"]["profile"]["width_nm"], 500);
    EXPECT_NE(pattern(), first);
    EXPECT_EQ(user.leave(), 0);
}

TEST_F(InspectorWindow, AFileIsChosenByClicksAndEditsAreSavedOnTheWayAndOutliveALostContext) {
    const std::string text = R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})";
    std::filesystem::create_directory(path("folder"));
    write_file_atomic(path("folder/first.json"), text);
    write_file_atomic(path("folder/second.json"), text);
    InspectorUser user(folder_.path(), {path("folder/first.json"), "--probe", path("sky.json")},
                       {.environment = {{"ROWLAND_TEST_LOST_WHEN", path("lost")}}, .preload = ROWLAND_LOST_CONTEXT});
    user.click("lines per mm");
    user.enter("1250");
    user.key("ctrl+o");
    user.enter(path("folder/"));
    user.click("file second.json");
    user.facts();  // a dialog finds its position in its first frames
    user.click("button Save");
    user.wait_for("document", "second.json");
    EXPECT_EQ(diffraction::load_material(path("folder/first.json")).grating.pitch_nm, 800);
    EXPECT_EQ(diffraction::load_material(path("folder/second.json")).grating.pitch_nm, 1600);

    user.key("ctrl+o");
    user.facts();
    user.click("recent second.json");
    user.wait_for("document", "second.json");
    user.key("ctrl+shift+s");
    user.enter(path("folder/first.json"));
    user.facts();
    user.click("button Replace");
    user.wait_for("document", "first.json");
    EXPECT_EQ(diffraction::load_material(path("folder/first.json")).grating.pitch_nm, 1600);

    const std::string saved = read_text_file(path("folder/first.json"), 1 << 20);
    user.click("lines per mm");
    user.enter("1250");
    const json typed = material(user.facts());
    write_file_atomic(path("lost"), std::string_view());
    EXPECT_EQ(user.wait_for_end(), 1);
    EXPECT_EQ(diffraction::load_material(path("folder/first.unsaved.json")).grating.pitch_nm, 800);
    EXPECT_EQ(json::parse(read_text_file(path("folder/first.unsaved.json"), 1 << 20)), typed);
    EXPECT_EQ(read_text_file(path("folder/first.json"), 1 << 20), saved);

    InspectorUser next(folder_.path(), {path("folder/first.json"), "--probe", path("sky.json")});
    next.facts();  // a dialog finds its position in its first frames
    next.click("button Open them");
    next.wait_for("document", "first.unsaved.json");
    EXPECT_EQ(material(next.facts()), typed);
}

TEST_F(InspectorWindow, RefusedInputIsSaidAndNothingIsLost) {
    write_file_atomic(path("corrupt.json"), std::string_view("{\"grating\": {\"pitch_nm\": 16"));
    InspectorUser user(folder_.path(), preset("cd"));
    user.wait_for("message", "the light");  // a message stays until the next one
    user.click("/grating/orders");
    user.enter("1 x");
    user.wait_for("refused", "orders");
    EXPECT_THAT(user.facts().at("refused"), HasSubstr("/grating/orders"));
    save_as(user, "/proc/nowhere/m.json");
    user.wait_for("message", "orders");
    user.key("ctrl+z");
    user.wait_for("refused", "no");
    save_as(user, "/proc/nowhere/m.json");
    user.wait_for("message", "/proc/nowhere");
    user.key("ctrl+o");
    user.type(path("corrupt.json"));
    user.key("Return");
    user.wait_for("message", "corrupt.json");
    const Facts end = user.facts();
    EXPECT_EQ(end.at("document"), "cd.json *");
    EXPECT_EQ(material(end)["grating"]["orders"], json({-2, -1, 1, 2}));
}

TEST_F(InspectorWindow, AnArtworkBecomesAFoilCardInAFewClicksAndAFilm) {
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 60 * 84; ++i)
        rgba.insert(rgba.end(), {static_cast<std::uint8_t>(4 * (i % 60)), static_cast<std::uint8_t>(3 * (i / 60)), 120,
                                 static_cast<std::uint8_t>(i % 60 < 30 ? 255 : 0)});
    write_file_atomic(path("art.png"), image::encode_png(60, 84, 4, rgba));
    const std::vector<std::uint8_t> dot(4, 255);
    write_file_atomic(path("dot.png"), image::encode_png(1, 1, 4, dot));
    InspectorUser user(folder_.path(), preset("cd"), {.folder = folder_.path()});
    int clicks = 0;
    const auto click = [&](const std::string& control) {
        ++clicks;
        user.click(control);
    };
    click("menu File");
    click("menu New foil card…");
    click("file art.png");
    user.wait_for("foil card", "full");
    user.wait_for("foil type tiles", " ");
    user.facts();  // a tile finds its columns in its first frames
    click("foil type tiles");
    user.wait_for("foil", "tiles");
    click("save card");
    click("button Save");
    user.wait_for("message", "art.glb");
    EXPECT_LE(clicks, 12);
    const test::Ended valid = test::run(
        {"/usr/bin/env", "node", test::source_path("tests/unit/engine/scene/validate_gltf.cjs"), path("art.glb")});
    if (valid.code != 77 && valid.code != 127) {
        EXPECT_EQ(valid.code, 0) << valid.out << valid.err;
    }
    EXPECT_THAT(read_text_file(path("art.glb"), 1 << 24), HasSubstr("ROWLAND_materials_diffraction"));
    {
        SCOPED_TRACE("the card moves until it is dragged, and a refused picture changes nothing but its message");
        const int before = user.frames();
        std::this_thread::sleep_for(1s);
        EXPECT_GT(user.frames(), before + 1);
        user.drag("picture", {30, 0});
        user.drop(path("dot.png"));
        user.wait_for("foil refused", "dot.png: 1 x 1 texels");
        user.key("ctrl+z");
        user.wait_for("foil refused", "no");
        user.wait_for("busy", "no");
        user.wait_for_rest();
    }
    {
        SCOPED_TRACE("a slider changes the recipe, which is saved and opened again");
        user.drag("/foil/scale", {-20, 0});
        const json recipe = json::parse(user.facts().at("foil"));
        EXPECT_LT(recipe["foil"]["scale"], 1.0);
        user.key("ctrl+s");
        user.click("button Save");
        user.wait_for("message", "art.json: saved");
        user.drop(path("art.json"));
        user.wait_for("foil card", "full");
        EXPECT_EQ(json::parse(user.facts().at("foil")), recipe);
    }
    SCOPED_TRACE("a film");
    user.click("save film");
    for (const auto& [control, value] :
         {std::pair("film width", "48"), {"film height", "64"}, {"film seconds", "0.4"}}) {
        user.click(control);
        user.enter(value);
    }
    user.click("film pngs");
    user.click("film file");
    user.click("button Save");
    user.wait_for("message", "art.webp: the film");
    EXPECT_THAT(read_text_file(path("art.webp"), 1 << 24).substr(0, 16), HasSubstr("WEBP"));
    EXPECT_TRUE(std::filesystem::exists(path("art/0007.png")));
    EXPECT_FALSE(std::filesystem::exists(path("art/0008.png")));
    EXPECT_EQ(user.leave(), 0);
}

TEST_F(InspectorWindow, AFilmIsMadeFromNothingAttachedToASceneAndSaved) {
    std::filesystem::copy_file(test::content_path("scenes/films.glb"), path("films.glb"));
    InspectorUser user(folder_.path(), preset("cd"));
    user.click("menu Presets");
    user.click("menu anodised_titanium");
    user.wait_for("document", "anodised_titanium.json");
    user.wait_for("shape is", "sphere");
    const auto figures = [&] {
        user.wait_for("busy", "no");
        user.wait_for("film is current", "yes");
        const Facts facts = user.facts();
        std::string all;
        for (const char* name : {"film at 550 nm", "film reflects", "film table error", "film formula error"})
            all += facts.at(name) + " ";
        return all;
    };
    std::string before = figures();
    const auto expect_change = [&](const char* field) {
        const std::string after = figures();
        EXPECT_NE(after, before) << field;
        before = after;
    };
    for (const char* field :
         {"/film/ior", "/film/thickness_nm", "/film/k", "/base/ior", "/base/k", "/roughness", "film angle"}) {
        user.drag(field, {40, 0});
        expect_change(field);
    }
    user.click("/film/k revert");
    expect_change("/film/k");
    user.pick({0.5, 0.5});
    EXPECT_THAT(user.facts().at("picked"), testing::MatchesRegex("[0-9]+ [0-9]+ [0-9]+"));
    user.click("/metal");
    user.click("/metal=Au");
    expect_change("/metal");
    const json film = material(user.facts());
    save_as(user, path("film.json"));
    user.wait_for("message", "saved");

    user.drop(path("films.glb"));
    user.wait_for("document", "films.glb");
    user.click("material walnut");
    user.wait_for("chosen material", "walnut");
    user.drop(path("film.json"));
    user.wait_for("message", "the film of walnut");
    user.drag("/iridescenceThicknessMaximum", {40, 0});
    user.key("ctrl+z");
    user.drag("/iridescenceFactor", {-40, 0});
    const json attached = material(user.facts());
    EXPECT_EQ(attached["iridescenceThicknessMaximum"], film["film"]["thickness_nm"]);
    EXPECT_EQ(attached["extras"]["metal"], "Au");
    EXPECT_LT(attached["iridescenceFactor"], 1);
    user.click("/iridescenceThicknessTexture");
    user.click("/iridescenceThicknessTexture=texture");
    user.wait_for("busy", "no");
    user.click("remove");
    EXPECT_TRUE(material(user.facts()).is_null());
    user.key("ctrl+z");
    const json saved = material(user.facts());
    user.key("ctrl+s");
    user.wait_for("message", "saved");
    user.click("material oil on water");
    user.wait_for("chosen material", "oil on water");
    user.key("ctrl+o");
    user.enter(path("films.glb"));
    user.wait_for("message", "6 with a grating or film");
    user.click("material walnut");
    user.wait_for("chosen material", "walnut");
    EXPECT_EQ(material(user.facts()), saved);

    user.click("light boxes");
    user.click("add box");
    const std::string added = user.facts().at("box is");
    for (const char* field : {"box size", "box position", "box rotation", "box fade"}) user.drag(field, {20, 0});
    user.click("box probe");
    user.enter("room/films.probe");
    user.wait_for("box is", "room/films.probe");
    EXPECT_NE(user.facts().at("box is"), added);
    user.key("ctrl+s");
    user.wait_for("message", "saved");
    const scene::ImportedScene with_box = scene::load_gltf(path("films.glb"), {});
    ASSERT_EQ(with_box.probes.size(), 1U);
    EXPECT_EQ(with_box.probes[0].file, "room/films.probe");
    user.click("remove box");
    user.key("ctrl+z");
    user.wait_for("box is", "room/films.probe");
    user.click("compare");
    EXPECT_EQ(user.leave(), 0);
}

}  // namespace
}  // namespace rowland
