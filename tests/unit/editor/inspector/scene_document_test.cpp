#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>

#include "editor/inspector/document.h"
#include "editor/inspector/groove_texture.h"
#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

// Two materials that an exporter wrote in its own way, the second with a grating, and a mesh without a material.
const std::string kScene = R"({
    "asset" : { "version":"2.0" }, "extras": {"mine": [1.50, 2e0]},
  "extensionsUsed": ["ROWLAND_materials_diffraction"],
  "materials": [ {"name":"plain",  "extras":{"keep":1.0}},
    {"name": "disc", "extensions": {"ROWLAND_materials_diffraction":
        {"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}, "extras": {"by": "hand"}}}} ],
  "meshes": [{"name": "bare", "primitives": [{"attributes": {}}]}]
})";

const Json kDvd = Json::parse(R"({"grating": {"pitch_nm": 740, "profile": {"type": "slit", "width_nm": 370}}})");

class SceneDocument : public test::FolderTest {
 protected:
    SceneDocument() { write_file_atomic(path("scene.gltf"), kScene); }
    std::string text() const { return read_text_file(path("scene.gltf"), 1 << 20); }
    Json saved() const { return Json::parse(text()); }
    Document opened() const { return Document::open_scene(scene::EditableGltf::open(path("scene.gltf")), kBare); }

    static constexpr std::array kBare = {scene::PrimitiveId{.mesh = 0, .primitive = 0}};
};

TEST_F(SceneDocument, TheFirstGratingIsChosenAndSavingItUnchangedKeepsAll) {
    Document document = opened();
    EXPECT_TRUE(document.is_scene());
    EXPECT_EQ(document.material_count(), 3U);
    EXPECT_EQ(document.chosen(), 1U);
    EXPECT_EQ(document.material().grating.pitch_nm, 1600.0);
    EXPECT_FALSE(document.dirty());
    document.save();
    EXPECT_EQ(saved(), Json::parse(kScene));
}

TEST_F(SceneDocument, WhatIsAttachedAndRemovedIsTakenBackInTurnAtItsMaterial) {
    Document document = opened();
    document.set_extension(nullptr, "nothing");
    EXPECT_FALSE(document.has_grating());
    document.choose(0);
    document.set_extension(kDvd, "dvd");
    document.set_value(field_at("/grooveRotation"), 0.5);
    document.set_value(field_at("/grooveRotation"), 1.0);
    document.finish_edit();
    document.choose(1);
    document.undo();
    EXPECT_EQ(document.chosen(), 0U);
    EXPECT_EQ(document.json(), kDvd);
    document.undo();
    EXPECT_FALSE(document.has_grating());
    document.undo();
    EXPECT_EQ(document.chosen(), 1U);
    EXPECT_TRUE(document.has_grating());
    EXPECT_FALSE(document.dirty());
    for (int i = 0; i < 3; ++i) document.redo();
    EXPECT_FALSE(document.can_redo());
    EXPECT_EQ(document.json(0)["grooveRotation"], 1.0);
    EXPECT_TRUE(document.json(1).is_null());
    document.choose(0);
    for (int i = 0; i < 3; ++i) document.undo();
    document.save();
    EXPECT_EQ(saved(), Json::parse(kScene));
}

TEST_F(SceneDocument, SavingChangesTheEditedMaterialAlone) {
    Document document = opened();
    const Json before = saved();
    document.choose(0);
    document.set_extension(kDvd, "dvd");
    document.set_value(field_at("/grooveRotation"), 0.25);
    EXPECT_TRUE(document.edited(0));
    EXPECT_FALSE(document.edited(1));
    document.save();
    EXPECT_FALSE(document.dirty());
    Json after = saved();
    EXPECT_EQ(after["materials"][0]["extensions"]["ROWLAND_materials_diffraction"]["grooveRotation"], 0.25);
    after["materials"][0].erase("extensions");
    EXPECT_EQ(after, before);
    const Document again = opened();
    EXPECT_EQ(again.json(0), document.json(0));
}

TEST_F(SceneDocument, APrimitiveWithoutAMaterialGetsOneOnlyWhenItIsSavedWithAGrating) {
    Document document = opened();
    document.choose(2);
    document.set_extension(kDvd, "dvd");
    document.undo();
    document.save();
    EXPECT_EQ(saved(), Json::parse(kScene));
    document.redo();
    document.save();
    const Json after = saved();
    const auto material = after["meshes"][0]["primitives"][0]["material"].get<std::size_t>();
    EXPECT_EQ(after["materials"][material]["extensions"]["ROWLAND_materials_diffraction"], kDvd);
    document.set_value(field_at("/grooveRotation"), 0.5);
    document.save();
    EXPECT_EQ(saved()["materials"].size(), 3U);
}

/// As another program writes it, with members that we do not know.
const std::string kFilmScene = R"({"asset": {"version": "2.0"}, "textures": [{}], "extensionsUsed":
    ["KHR_materials_ior", "KHR_materials_iridescence", "OTHER", "X"], "materials": [{"name": "bubble", "extensions": {
    "KHR_materials_ior": {"ior": 1.0}, "OTHER": {"a": 1.0}, "KHR_materials_iridescence": {"extras": {"by": "hand"},
    "iridescenceFactor": 0.5, "iridescenceThicknessTexture": {"index": 0, "extras": [1]}, "extensions": {"X": {}}}}}]})";

TEST_F(SceneDocument, AFilmOfAnotherProgramIsEditedReplacedAndRemovedAndAllElseStays) {
    write_file_atomic(path("scene.gltf"), kFilmScene);
    Document document = Document::open_scene(scene::EditableGltf::open(path("scene.gltf")));
    EXPECT_TRUE(document.has_film());
    document.save();
    EXPECT_EQ(saved(), Json::parse(kFilmScene));
    document.set_value(field_at("/iridescenceThicknessMaximum"), 700);
    document.set_choice(field_at("/extras/metal"), "Ag");
    document.save();
    Json expected = Json::parse(kFilmScene);
    Json& film = expected["materials"][0]["extensions"]["KHR_materials_iridescence"];
    film["iridescenceThicknessMaximum"] = 700;
    film["extras"]["metal"] = "Ag";
    EXPECT_EQ(nlohmann::json(saved()), nlohmann::json(expected));
    EXPECT_EQ(nlohmann::json(Document::open_scene(scene::EditableGltf::open(path("scene.gltf"))).json()),
              nlohmann::json(document.json()));

    document.set_extension(kDvd, "dvd");
    EXPECT_TRUE(document.has_grating());
    document.save();
    EXPECT_EQ(saved()["materials"][0]["extensions"], Json::parse(R"({"KHR_materials_ior": {"ior": 1.0},
        "OTHER": {"a": 1.0}, "ROWLAND_materials_diffraction": )" +
                                                                 kDvd.dump() + "}"));
    for (int i = 0; i < 3; ++i) document.undo();
    EXPECT_TRUE(document.has_film());
    document.set_extension(nullptr, "nothing");
    document.save();
    EXPECT_EQ(saved()["materials"][0]["extensions"].size(), 2U);
    EXPECT_EQ(saved()["extensionsUsed"], Json({"KHR_materials_ior", "OTHER"}));
    document.undo();
    document.save();
    EXPECT_EQ(nlohmann::json(saved()["materials"]), nlohmann::json(Json::parse(kFilmScene)["materials"]));
}

TEST_F(SceneDocument, APictureOfAFilmsThicknessIsSavedOnce) {
    Document document = opened();
    document.choose(0);
    document.set_extension(Json::parse(R"({"iridescenceFactor": 1})"), "film");
    const std::size_t index = document.new_textures().add(foil_pattern("tiles"), "tiles.png");
    for (const char* texture : {"/iridescenceThicknessTexture", "/iridescenceTexture"})
        document.set_value(field_at(texture), {{"index", index}});
    document.save();
    const Json film = saved()["materials"][0]["extensions"]["KHR_materials_iridescence"];
    EXPECT_EQ(film["iridescenceThicknessTexture"]["index"], 0);
    EXPECT_EQ(film["iridescenceTexture"]["index"], 0);
    EXPECT_EQ(saved()["textures"].size(), 1U);
}

TEST_F(SceneDocument, AFilmOnAGratingAndBadFilmsAreRefusedByTheirPointers) {
    const auto message_with = [&](const std::string& extensions) {
        write_file_atomic(path("bad.gltf"),
                          R"({"asset": {"version": "2.0"}, "materials": [{"extensions": )" + extensions + "}]}");
        return test::message_of([&] { Document::open_scene(scene::EditableGltf::open(path("bad.gltf"))); });
    };
    const std::string grating = R"("ROWLAND_materials_diffraction": )" + kDvd.dump();
    const std::string pointer = "/materials/0/extensions/";
    EXPECT_THAT(message_with("{" + grating + R"(, "KHR_materials_iridescence": {}})"),
                HasSubstr(pointer + "KHR_materials_iridescence: a film on a grating"));
    EXPECT_THAT(message_with(R"({"KHR_materials_iridescence": {"iridescenceIor": 0.5}})"),
                HasSubstr(pointer + "KHR_materials_iridescence/iridescenceIor"));
    EXPECT_THAT(message_with(R"({"ROWLAND_materials_diffraction": {}})"),
                HasSubstr(pointer + "ROWLAND_materials_diffraction/grating: missing"));
}

TEST_F(SceneDocument, AFileThatAnotherProgramChangedIsNotWrittenOverUnasked) {
    Document document = opened();
    document.set_value(field_at("/grooveRotation"), 0.5);
    EXPECT_FALSE(document.changed_outside());
    write_file_atomic(path("scene.gltf"), kScene + " ");
    EXPECT_TRUE(document.changed_outside());
    EXPECT_THROW(document.save(), Error);
    EXPECT_EQ(text(), kScene + " ");
    EXPECT_TRUE(document.dirty());
    document.save(true);
    EXPECT_THAT(text(), HasSubstr("grooveRotation"));
    EXPECT_FALSE(document.changed_outside());
}

TEST_F(SceneDocument, ARefusedGratingIsNeitherAttachedNorSaved) {
    Document document = opened();
    document.choose(0);
    EXPECT_THAT(test::message_of(
                    [&] { document.set_extension(Json::parse(R"({"grating": {"pitch_nm": -1}})"), "the clipboard"); }),
                HasSubstr("the clipboard"));
    EXPECT_FALSE(document.has_grating());
    document.choose(1);
    document.set_value(field_at("/grooveTexture"), {{"index", -1}});
    ASSERT_TRUE(document.refusal());
    EXPECT_EQ(document.refusal()->field, &field_at("/grooveTexture/index"));
    document.choose(0);
    EXPECT_FALSE(document.refusal());
    EXPECT_THROW(document.save(), Error);
    EXPECT_EQ(text(), kScene);
}

TEST_F(SceneDocument, AnOpenedFilesBadGratingIsNamedByItsPointer) {
    std::string bad = kScene;
    bad.replace(bad.find("1600"), 4, "-160");
    write_file_atomic(path("scene.gltf"), bad);
    EXPECT_THAT(test::message_of([&] { opened(); }),
                HasSubstr("/materials/1/extensions/ROWLAND_materials_diffraction/grating/pitch_nm"));
}

TEST_F(SceneDocument, APictureIsWrittenOnceItIsUsedAndSaved) {
    Document document = opened();
    document.new_textures().add(foil_pattern("tiles"), "unused.png");
    const std::size_t index = document.new_textures().add(foil_pattern("hexagons"), "hexagons.png");
    document.set_value(field_at("/grooveTexture"), {{"index", index}});
    ASSERT_NE(document.accepted()->textures.find(index), nullptr);
    document.save();
    Json after = saved();
    ASSERT_EQ(after["textures"].size(), 1U);
    EXPECT_EQ(after["materials"][1]["extensions"]["ROWLAND_materials_diffraction"]["grooveTexture"]["index"], 0);
    const std::string image = after["images"][0]["uri"];
    EXPECT_EQ(read_file(path(image), 1 << 22), foil_pattern("hexagons"));
    document.set_value(field_at("/grooveTexture/sparkle"), true);
    document.save();
    EXPECT_EQ(saved()["textures"].size(), 1U);
}

TEST_F(SceneDocument, EditsAreRescuedAsAWholeScene) {
    Document document = opened();
    document.set_value(field_at("/grooveRotation"), 0.5);
    ASSERT_EQ(document.rescue(), path("scene.unsaved.gltf"));
    EXPECT_EQ(text(), kScene);
    const Document rescued = Document::open_scene(scene::EditableGltf::open(path("scene.unsaved.gltf")));
    EXPECT_EQ(nlohmann::json(rescued.json(1)), nlohmann::json(document.json(1)));
}

TEST(GrooveTexture, EveryPatternIsAGrooveTexture) {
    for (const char* name : kFoilPatterns) {
        const auto grooves = foil_pattern(name);
        const image::ByteImage image = image::decode_byte_image(grooves, name, image::Depth::OfFile);
        EXPECT_EQ(image.rgba16.size(), std::size_t{512} * 512 * 4) << name;
        std::set<int> directions;
        for (std::size_t i = 0; i < image.rgba16.size(); i += 4) {
            directions.insert(image.rgba16[i]);
            ASSERT_GE(image.rgba16[i + 1], 32768) << name;
        }
        EXPECT_EQ(directions.size() == 1, std::string_view(name) == "pillars") << name;
        EXPECT_EQ(as_groove_texture(grooves, name), grooves) << name;
    }
}

TEST(GrooveTexture, ARadialPatternsGratingVectorPointsAwayFromTheMiddle) {
    const image::ByteImage image = image::decode_byte_image(foil_pattern("radial"), "radial");
    const auto rotation_at = [&](double x, double y) {  // from the middle, y up
        const auto column = static_cast<std::size_t>((0.5 + x) * image.width);
        const auto row = static_cast<std::size_t>((0.5 - y) * image.height);
        return std::numbers::pi * image.rgba[4 * (row * static_cast<std::size_t>(image.width) + column)] / 255.0;
    };
    for (const double angle : {0.3, 1.0, 2.0, 2.9}) {
        // A step of R is 0.012.
        EXPECT_NEAR(rotation_at(0.3 * std::cos(angle), 0.3 * std::sin(angle)), angle, 0.02);
        EXPECT_NEAR(rotation_at(-0.3 * std::cos(angle), -0.3 * std::sin(angle)), angle, 0.02);
    }
}

TEST(GrooveTexture, APicturesBrightnessTurnsTheGrooves) {
    const std::vector<std::uint8_t> rgba = {0, 0, 0, 255, 255, 255, 255, 255, 128, 128, 128, 0};
    const auto made = image::decode_byte_image(as_groove_texture(image::encode_png(3, 1, 4, rgba), "p"), "p");
    EXPECT_EQ(made.rgba, (std::vector<std::uint8_t>{0, 128, 0, 255, 255, 128, 0, 255, 128, 0, 0, 255}));
}

}  // namespace
}  // namespace rowland::inspector
