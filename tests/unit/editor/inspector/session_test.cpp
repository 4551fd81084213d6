#include "editor/inspector/session.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/file.h"
#include "engine/platform/gl_context.h"
#include "engine/scene/mesh_recipe.h"
#include "tests/support/files.h"
#include "tests/support/light.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

/// A session without a window, whose picture is small and whose light is quick for the reference.
class SmallSession : public testing::Test {
 protected:
    /// `base`: a member of the material, or nothing.
    explicit SmallSession(const std::string& base) {
        write_file_atomic(path("sky.json"), test::small_sky(64, 1));
        write_file_atomic(
            path("m.json"),
            R"({"grating": {"pitch_nm": 1600, "orders": [1], "profile": {"type": "slit", "width_nm": 800}}, )" + base +
                R"("quality": {"representation": "spikes", "bands": 3, "spikes": 2}})");
        session_.light.choose(path("sky.json"));
    }
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

    void draw(int frames, bool with_saved = false) {
        for (int i = 0; i < frames; ++i) {
            session_.update();
            session_.view.draw(kSize, opening_camera(), with_saved, 0.01F);
        }
    }
    /// Frames until a condition holds; fails after two minutes.
    template <typename Condition>
    void draw_until(Condition&& holds, bool with_saved = false) {
        for (int i = 0; i < 24000 && !holds(); ++i) {
            draw(1, with_saved);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        ASSERT_TRUE(holds());
    }
    const Document& document() const { return session_.opened.document(); }
    Document& document() { return session_.opened.document(); }
    const Message& last_message() const { return session_.messages.all().back(); }
    std::vector<glm::vec4> picture() const { return session_.view.preview().linear().read_rgba_float(); }
    std::vector<std::uint8_t> display() const { return session_.view.preview().display().read_rgba8(); }

    static constexpr glm::ivec2 kSize{64, 48};
    test::TemporaryFolder folder_;
    platform::HeadlessContext context_;
    post::OcioConfig config_ = post::OcioConfig::choose(std::nullopt);
    Session session_{config_, {.content_folder = test::source_path("content"), .still = true}};
};

class SessionTest : public SmallSession {
 protected:
    SessionTest() : SmallSession("") { session_.open(path("m.json")); }

    void draw_until_cooked(double pitch_nm, bool with_saved = false) {
        draw_until(
            [&] { return session_.view.ready() && session_.opened.cooked()->material.grating.pitch_nm == pitch_nm; },
            with_saved);
    }
    /// Frames until all values are computed, which takes seconds.
    void settle() {
        draw_until([&] {
            session_.update();
            return session_.view.preview().drawn() && !session_.busy();
        });
    }
    const PricedChoice& present() {
        list_ = session_.measurement.prices();
        for (const PricedChoice& choice : list_.choices)
            if (choice.present) return choice;
        ADD_FAILURE() << "no present choice";
        list_.choices.emplace_back().settings = nlohmann::json::object();
        return list_.choices.back();
    }

    PriceList list_;
};

TEST(GratingCook, AnEditedTableOfEfficienciesIsBakedAgain) {
    const test::TemporaryFolder folder;
    const auto material = Json::parse(R"({"grating": {"pitch_nm": 1600, "orders": [1],
        "profile": {"type": "table", "file": "t.csv"}}, "quality": {"representation": "direct"}})");
    GratingCook cook(nullptr);
    const auto cooked = [&](const char* efficiency) {
        write_file_atomic(folder.path() / "t.csv", std::string("wavelength_nm,R+1\n550,") + efficiency + "\n");
        return cook.cook(*accept_material(material, "m.json", folder.path()))->material;
    };
    const auto first = cooked("0.1");
    EXPECT_EQ(cooked("0.1"), first);
    EXPECT_NE(cooked("0.2"), first);
}

TEST_F(SessionTest, AllValuesFollowAnEdit) {
    settle();
    EXPECT_TRUE(session_.measurement.point_numbers_are_current());
    EXPECT_TRUE(session_.measurement.prices_are_current());
    const double error = present().error;
    const glm::dvec3 before = session_.measurement.point_numbers()->radiance.reference;
    document().set_value(field_at("/grating/pitch_nm"), 900);
    draw(1);
    EXPECT_FALSE(session_.measurement.prices_are_current());
    EXPECT_TRUE(session_.busy());
    EXPECT_NE(session_.opened.cooked(), nullptr);  // the last good one is shown until there is another
    settle();
    EXPECT_EQ(session_.opened.cooked()->material.grating.pitch_nm, 900.0);
    EXPECT_NE(session_.measurement.point_numbers()->radiance.reference, before);
    EXPECT_TRUE(session_.measurement.prices_are_current());
    EXPECT_NE(present().error, error);
}

TEST_F(SessionTest, TheMaterialIsLookedThrough) {
    session_.view.stage.exposure_stops = 6.0F;  // so that the sky is bright enough
    settle();
    draw(3);
    const std::vector<std::uint8_t> without = display();
    session_.view.looks_through = true;
    draw(3);
    EXPECT_NE(display(), without);
    session_.view.looks_through = false;
    draw(3);
    EXPECT_EQ(display(), without);
}

TEST_F(SessionTest, MeasuredPricesStayWhileOnlyTheChoiceChanges) {
    settle();
    session_.measurement.measure_all();
    draw_until(
        [&] { return !session_.measurement.prices().choices.empty() && session_.measurement.prices().total > 20; });
    session_.measurement.stop_pricing();
    settle();
    const std::size_t measured = session_.measurement.prices().choices.size();
    EXPECT_EQ(present().settings["spikes"], 2);
    EXPECT_TRUE(session_.measurement.prices_are_current());

    document().replace_quality({{"representation", "spikes"}, {"bands", 3}, {"spikes", 3}});
    EXPECT_TRUE(session_.measurement.prices_are_current());
    settle();
    EXPECT_EQ(session_.measurement.prices().choices.size(), measured + 1);  // the new choice is measured in addition
    EXPECT_EQ(present().settings["spikes"], 3);
    document().undo();
    EXPECT_EQ(present().settings["spikes"], 2);

    document().set_value(field_at("/grating/pitch_nm"), 900);
    EXPECT_FALSE(session_.measurement.prices_are_current());
}

TEST_F(SessionTest, ThePriceIsOfTheRepresentationThatDrawsTheShapeInView) {
    document().replace_quality({{"representation", "planar"}, {"map_resolution", 32}});
    draw_until([&] { return !session_.opened.busy() && session_.view.ready(); });
    const auto bytes_on = [&](PreviewShape shape, const char* representation, diffraction::SurfaceShape surface) {
        session_.view.choose_shape(shape);
        EXPECT_EQ(session_.view.drawn_as()->representation, representation);
        EXPECT_EQ(session_.view.surface_shape(), surface);
        return session_.view.drawn_as()->cost.table_bytes;
    };
    const std::size_t flat = bytes_on(PreviewShape::Disc, "planar", diffraction::SurfaceShape::Flat);
    EXPECT_NE(bytes_on(PreviewShape::Sphere, "arc", diffraction::SurfaceShape::Curved), flat);
    EXPECT_EQ(bytes_on(PreviewShape::Card, "planar", diffraction::SurfaceShape::Flat), flat);
}

TEST_F(SessionTest, TheShapeInViewDecidesTheSurfaceThatIsMeasured) {
    document().replace_quality({{"representation", "planar"}, {"map_resolution", 128}});
    settle();
    const double flat = present().error;
    session_.view.choose_shape(PreviewShape::Sphere);
    EXPECT_FALSE(session_.measurement.prices_are_current());
    settle();
    EXPECT_TRUE(session_.measurement.prices_are_current());
    EXPECT_GT(present().error, 3.0 * flat) << "of arc, which draws the sphere";
}

TEST_F(SessionTest, TheDemoIsGivenTheDocumentAsEdited) {
    EXPECT_THAT(session_.opened.demo_arguments(), testing::ElementsAre("--disc", "--material", path("m.json")));
    for (const int pitch_nm : {900, 950}) {
        document().set_value(field_at("/grating/pitch_nm"), pitch_nm);
        EXPECT_EQ(session_.opened.demo_arguments().back(), path("m.unsaved.json"));
        EXPECT_EQ(Document::open(path("m.unsaved.json")).json(), document().json());
    }
}

TEST_F(SessionTest, TheChosenPartIsFramedWhateverTheStagesRotation) {
    draw_until_cooked(1600.0);
    session_.view.choose_shape(PreviewShape::Sphere);
    draw(1);
    const glm::vec4 sphere = session_.view.chosen_sphere().value();
    EXPECT_NEAR(sphere.w, 0.05F * std::sqrt(3.0F), 1e-3F);
    session_.view.stage.rotation_deg = 90.0F;
    draw(1);
    EXPECT_LT(glm::distance(session_.view.chosen_sphere().value(), sphere), 1e-3F);
}

TEST_F(SessionTest, APresetOpensOnTheShapeThatShowsItsColours) {
    session_.open_preset("blu_ray");
    EXPECT_EQ(session_.view.shape(), PreviewShape::Sheet);
    session_.open_preset("phone_screen");
    EXPECT_EQ(session_.view.shape(), PreviewShape::Card) << "lattices are drawn by planar on flat shapes";
    session_.open_preset("cd");
    EXPECT_EQ(session_.view.shape(), PreviewShape::Disc);
}

TEST_F(SessionTest, ACookToABudgetMeasuresWhatItNeeds) {
    settle();
    session_.measurement.cook_to_budget(0.2);
    EXPECT_TRUE(document().material().quality.pinned.has_value());
    settle();
    const auto expected = cheapest_within(session_.measurement.prices(), 0.2);
    ASSERT_TRUE(expected.has_value());
    EXPECT_EQ(nlohmann::json(document().json()["quality"]), expected->settings);
    EXPECT_LE(present().error, 0.2);
}

TEST_F(SessionTest, AnEditEndsACookToABudget) {
    settle();
    session_.measurement.cook_to_budget(0.2);
    draw(2);
    document().set_value(field_at("/grating/pitch_nm"), 900);
    draw(2);
    EXPECT_THAT(last_message().text, HasSubstr("an edit ended the measurement"));
    EXPECT_EQ(document().json()["quality"]["spikes"], 2);
}

/// A grating that sends next to nothing on: what a cover adds to the preview is its gloss.
TEST_F(SessionTest, AGlossIsSeenInThePreviewAndTakenBack) {
    document().set_value(field_at("/grating/profile/width_nm"), 1);
    document().finish_edit();
    const auto drawn = [&](bool covered) {
        draw_until([&] {
            return session_.view.ready() && session_.opened.cooked()->material.grating.cover.has_value() == covered &&
                   session_.opened.cooked()->material.grating.profile.index() == 0;
        });
        draw(20);
        return picture();
    };
    const auto bare = drawn(false);
    document().set_choice(field_at("/cover"), "over the grooves");
    const auto covered = drawn(true);
    int brighter = 0;
    for (std::size_t i = 0; i < bare.size(); ++i) brighter += covered[i].y > 1.3F * bare[i].y ? 1 : 0;
    EXPECT_GT(brighter, 160);  // of 3072 pixels
    document().undo();
    EXPECT_EQ(drawn(false), bare);
}

TEST_F(SessionTest, WhatIsSavedIsDrawnInAnIdleInspector) {
    draw_until([&] { return session_.view.ready() && session_.opened.saved(); }, true);
    document().set_value(field_at("/grating/pitch_nm"), 900);
    draw_until_cooked(900.0, true);
    draw(100, true);  // the picture is at rest
    const auto now = display();
    EXPECT_NE(session_.view.preview().saved_display().read_rgba8(), now);
    session_.opened.save();
    draw_until([&] { return session_.opened.saved()->material.grating.pitch_nm == 900.0; }, true);
    draw(3, true);
    EXPECT_EQ(session_.view.preview().saved_display().read_rgba8(), now);
}

TEST_F(SessionTest, AModelIsDrawnInPlaceOfAnotherInAnIdleInspector) {
    constexpr int kTriangleStrip = 5;
    nlohmann::json file = scene::test::document(kTriangleStrip);
    for (const auto& [name, scale] : {std::pair("wide.gltf", glm::vec2(1.0F, 0.2F)), {"tall.gltf", {0.2F, 1.0F}}}) {
        file["nodes"][0]["scale"] = {scale.x, scale.y, 1.0F};
        write_file_atomic(path(name), file.dump());
    }
    session_.open(path("wide.gltf"));
    draw_until([&] { return session_.view.shape() == PreviewShape::Model && session_.view.ready(); });
    draw(100);
    const auto wide = display();
    session_.open(path("tall.gltf"));
    session_.opened.finish_opening();
    draw(3);
    EXPECT_NE(display(), wide);
}

TEST_F(SessionTest, ALightThatIsRefusedBecomesAMessageAndTheOldOneStays) {
    draw_until_cooked(1600.0);
    session_.light.choose(path("none.hdr"));
    draw_until([&] { return last_message().failure; });
    EXPECT_THAT(last_message().text, HasSubstr("none.hdr"));
    EXPECT_EQ(session_.light.current()->path, path("sky.json"));
}

TEST_F(SessionTest, AnOpenedTableIsComparedWithAScalarProfileAndTheLastScalarProfileWithATable) {
    draw_until_cooked(1600.0);
    EXPECT_FALSE(session_.opened.compared());
    write_file_atomic(path("table.csv"), "wavelength_nm,R-1,R+0,R+1\n380,.2,.3,.2\n780,.1,.4,.1\n");
    session_.open(path("table.csv"));
    ASSERT_TRUE(session_.opened.compared());
    EXPECT_TRUE(std::holds_alternative<diffraction::EfficiencyTable>(session_.opened.compared()->profile));
    document().set_value(field_at("/grating/profile"), {{"type", "table"}, {"file", "table.csv"}});
    draw_until([&] {
        return std::holds_alternative<diffraction::EfficiencyTable>(session_.opened.cooked()->material.grating.profile);
    });
    ASSERT_TRUE(session_.opened.compared());
    EXPECT_TRUE(std::holds_alternative<diffraction::SlitProfile>(session_.opened.compared()->profile));
}

/// A red sphere on the left and a blue one on the right.
std::vector<std::byte> two_spheres() {
    nlohmann::json file = {{"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0, 1}}}}}};
    for (int i = 0; i < 2; ++i) {
        const char* name = i == 0 ? "left" : "right";
        nlohmann::json primitive =
            scene::test::primitive_of(file, scene::build_mesh(scene::SphereRecipe{.radius = 0.5}));
        primitive["material"] = i;
        file["meshes"].push_back({{"name", name}, {"primitives", {primitive}}});
        file["nodes"].push_back({{"name", name}, {"mesh", i}, {"translation", {i == 0 ? -0.6 : 0.6, 0, 0}}});
        file["materials"].push_back({{"name", i == 0 ? "red" : "blue"},
                                     {"pbrMetallicRoughness",
                                      {{"baseColorFactor", {i == 0 ? 0.8 : 0.02, 0.02, i == 0 ? 0.02 : 0.8, 1.0}},
                                       {"metallicFactor", 0},
                                       {"roughnessFactor", 0.5}}}});
    }
    return scene::test::glb_of(file);
}

class SceneSession : public SmallSession {
 protected:
    SceneSession() : SmallSession(R"("base": {"color": [0, 1, 0]}, )") {
        write_file_atomic(path("spheres.glb"), two_spheres());
        session_.open(path("spheres.glb"));
    }
    void draw_until_open() {
        draw_until([&] { return session_.opened.scene() != nullptr && session_.view.ready(); });
        draw(3);
    }
    void draw_until_cooked() {
        draw(1);  // begins it
        draw_until([&] { return session_.opened.cooked() && !session_.opened.cooking(); });
    }
    void attach() {
        session_.open(path("m.json"));
        draw_until_cooked();
        draw(100);
    }
    static std::size_t pixel(double x, double y) {
        return static_cast<std::size_t>(y * kSize.y) * static_cast<std::size_t>(kSize.x) +
               static_cast<std::size_t>(x * kSize.x);
    }
    /// Pixels of the left and of the right half that differ.
    static glm::ivec2 changes(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
        glm::ivec2 count(0);
        for (std::size_t i = 0; i < a.size(); ++i)
            if (a[i] != b[i]) ++count[static_cast<int>(i % static_cast<std::size_t>(kSize.x)) < kSize.x / 2 ? 0 : 1];
        return count;
    }
};

TEST_F(SceneSession, OpensInTheBackgroundAndShowsItsOwnMaterials) {
    EXPECT_EQ(session_.opened.opening(), path("spheres.glb"));
    EXPECT_EQ(session_.opened.scene(), nullptr);
    draw_until_open();
    EXPECT_TRUE(session_.opened.opening().empty());
    EXPECT_EQ(session_.view.shape(), PreviewShape::Model);
    const auto shown = picture();
    const glm::vec4 left = shown[pixel(0.3, 0.5)];
    const glm::vec4 right = shown[pixel(0.7, 0.5)];
    EXPECT_GT(left.r, 3.0F * left.b);
    EXPECT_GT(right.b, 3.0F * right.r);
    ASSERT_EQ(session_.opened.scene()->materials.size(), 2U);
    EXPECT_EQ(session_.opened.scene()->materials[1].name, "blue");
    EXPECT_THAT(session_.opened.scene()->materials[1].meshes, testing::ElementsAre("right"));
}

TEST_F(SceneSession, AClickChoosesAMaterialAndItsGratingLeavesTheOthersAsTheyWere) {
    draw_until_open();
    draw(100);
    const auto before = picture();
    session_.view.pick({0.7, 0.5});
    EXPECT_EQ(document().chosen(), 1U);
    attach();
    const auto after = picture();
    EXPECT_EQ(changes(before, after)[0], 0);
    EXPECT_GT(changes(before, after)[1], 100);
    // The scene's own surface stays under the grating: blue, not the material file's green.
    EXPECT_FALSE(document().json().contains("base"));
    session_.opened.remove_grating();
    draw(100);
    EXPECT_EQ(picture(), before);
    document().undo();
    draw_until_cooked();
    draw(100);
    EXPECT_EQ(picture(), after);
}

TEST_F(SceneSession, RotatedGroovesAreDrawnWithoutBakingAndThePickedFrameRotatesWithThem) {
    draw_until_open();
    session_.view.pick({0.3, 0.5});
    attach();
    const auto before = picture();
    const auto cooked = session_.opened.cooked();
    ASSERT_TRUE(session_.view.surface());
    const glm::dvec3 g = session_.view.surface()->frame.grating;
    document().set_value(field_at("/grooveRotation"), 1.0);
    draw_until_cooked();
    draw(100);
    EXPECT_EQ(session_.opened.cooked(), cooked);
    EXPECT_EQ(changes(before, picture())[1], 0);
    EXPECT_GT(changes(before, picture())[0], 50);
    const glm::dvec3 rotated = session_.view.surface()->frame.grating;
    EXPECT_NEAR(glm::dot(rotated, g), std::cos(1.0), 1e-6);
}

TEST_F(SceneSession, StrokesFollowTheGroovesWhereTheyAreSeen) {
    draw_until_open();
    session_.view.pick({0.3, 0.5});
    attach();
    session_.view.shows_grooves = true;
    // On the sphere's equator the tangent is along the longitude, so the grooves run up and down.
    const auto gradients = [&] {
        draw(2);
        const auto strokes = session_.view.preview().grooves()->read_rgba_float();
        glm::dvec2 sum(0.0);
        for (int y = 16; y < 32; ++y)
            for (int x = 12; x < 28; ++x) {
                const auto at = [&](int column, int row) {
                    return strokes[static_cast<std::size_t>(row * kSize.x + column)].a;
                };
                sum += glm::dvec2(std::abs(at(x + 1, y) - at(x, y)), std::abs(at(x, y + 1) - at(x, y)));
            }
        return sum;
    };
    const glm::dvec2 upright = gradients();
    EXPECT_GT(upright.x, 1.5 * upright.y);
    document().set_value(field_at("/grooveRotation"), 1.571);
    draw_until_cooked();
    draw(2);
    const glm::dvec2 flat = gradients();
    EXPECT_GT(flat.y, 1.5 * flat.x);
    for (const glm::vec4& of_right : {session_.view.preview().grooves()->read_rgba_float()[pixel(0.7, 0.5)]})
        EXPECT_EQ(of_right.a, 0.0F);
}

TEST_F(SceneSession, AFoilPatternVariesTheGroovesOfItsMaterial) {
    draw_until_open();
    session_.view.pick({0.3, 0.5});
    session_.opened.set_foil_pattern("tiles");
    EXPECT_TRUE(last_message().failure) << "there is no grating that it could vary";
    write_file_atomic(path("foil.json"),
                      R"({"grating": {"pitch_nm": 1600, "orders": [1], "profile": {"type": "slit", "width_nm": 800}},
                          "quality": {"representation": "direct"}})");
    session_.open(path("foil.json"));
    draw_until_cooked();
    draw(10);
    const auto before = picture();
    session_.opened.set_foil_pattern("tiles");
    EXPECT_FALSE(last_message().failure) << last_message().text;
    draw_until_cooked();
    draw(10);
    EXPECT_GT(changes(before, picture())[0], 50);
    EXPECT_EQ(changes(before, picture())[1], 0);
}

TEST_F(SceneSession, OpeningIsCancelledAndARefusedFileIsSaid) {
    session_.opened.cancel_opening();
    EXPECT_TRUE(session_.opened.opening().empty());
    draw(5);
    write_file_atomic(path("bad.glb"), std::string_view("glTF, but not really"));
    session_.open(path("bad.glb"));
    draw_until([&] { return session_.opened.opening().empty(); });
    EXPECT_TRUE(last_message().failure);
    EXPECT_THAT(last_message().text, HasSubstr("bad.glb"));
    EXPECT_EQ(session_.opened.scene(), nullptr);
    EXPECT_EQ(document().name(), "cd.json");
}

TEST_F(SceneSession, LeavingASceneShowsAMaterialOnAShapeAgain) {
    draw_until_open();
    session_.opened.close_scene();
    session_.update();
    EXPECT_EQ(session_.opened.scene(), nullptr);
    EXPECT_EQ(session_.view.shape(), PreviewShape::Disc);
    draw_until([&] { return session_.view.ready() && session_.opened.cooked(); });
    EXPECT_EQ(document().name(), "cd.json");
}

TEST_F(SceneSession, AsksBeforeItSavesOverAFileThatAnotherProgramChanged) {
    draw_until_open();
    session_.open(path("m.json"));
    const std::vector<std::byte> exported = read_file(path("spheres.glb"), 1 << 24);
    std::vector<std::byte> again = exported;
    again.resize(again.size() + 4);
    write_file_atomic(path("spheres.glb"), again);
    session_.opened.save();
    EXPECT_TRUE(session_.opened.asks_to_overwrite);
    EXPECT_EQ(read_file(path("spheres.glb"), 1 << 24), again);
    session_.opened.save(true);
    EXPECT_FALSE(session_.opened.asks_to_overwrite);
    EXPECT_FALSE(document().dirty());
    EXPECT_NE(read_file(path("spheres.glb"), 1 << 24), again);
}

}  // namespace
}  // namespace rowland::inspector
