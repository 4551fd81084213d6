#include "editor/inspector/session.h"

#include <gmock/gmock.h>

#include "tests/unit/editor/inspector/small_session.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

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

TEST(SurfaceCook, AnEditedTableOfEfficienciesIsBakedAgain) {
    const test::TemporaryFolder folder;
    const auto material = Json::parse(R"({"grating": {"pitch_nm": 1600, "orders": [1],
        "profile": {"type": "table", "file": "t.csv"}}, "quality": {"representation": "direct"}})");
    SurfaceCook cook(nullptr);
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

TEST_F(SessionTest, AFilmIsDrawnOnEveryShapeAndFollowsItsFields) {
    session_.open_preset("soap_film");
    EXPECT_EQ(session_.view.shape(), PreviewShape::Sphere);
    const auto drawn = [&] {
        draw_until([&] { return session_.view.ready() && session_.opened.film() && !session_.opened.busy(); });
        draw(4);
        return picture();
    };
    drawn();
    for (const PreviewShape shape : {PreviewShape::Sheet, PreviewShape::Card, PreviewShape::Disc}) {
        session_.view.choose_shape(shape);
        const auto thick = drawn();
        document().set_value(field_at("/film/thickness_nm"), 0);
        document().finish_edit();
        EXPECT_NE(drawn(), thick) << preview_shape_name(shape);
        document().undo();
        EXPECT_EQ(drawn(), thick);
    }
    session_.opened.save_as(path("film.json"));
    document().set_value(field_at("/film/thickness_nm"), 0);
    drawn();
    draw(4, true);
    EXPECT_NE(session_.view.preview().saved_display().read_rgba8(), display());
    EXPECT_EQ(session_.view.drawn_as(), nullptr) << "which is of gratings";
    EXPECT_FALSE(session_.measurement.busy());
    session_.open_preset("cd");
    draw_until([&] { return session_.opened.cooked() != nullptr; });
    EXPECT_FALSE(session_.opened.film());
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
    draw_until([&] { return session_.view.ready() && session_.opened.surface(true); }, true);
    document().set_value(field_at("/grating/pitch_nm"), 900);
    draw_until_cooked(900.0, true);
    draw(100, true);  // the picture is at rest
    const auto now = display();
    EXPECT_NE(session_.view.preview().saved_display().read_rgba8(), now);
    session_.opened.save();
    draw_until([&] { return session_.opened.surface(true)->material->material.grating.pitch_nm == 900.0; }, true);
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
    draw_until([&] { return session_.view.shape() == PreviewShape::Scene && session_.view.ready(); });
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

}  // namespace
}  // namespace rowland::inspector
