// A session that shows a scene.
#include <gmock/gmock.h>

#include "engine/scene/mesh_recipe.h"
#include "tests/support/program.h"
#include "tests/unit/editor/inspector/small_session.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

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
    EXPECT_EQ(session_.view.shape(), PreviewShape::Scene);
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
    session_.opened.remove();
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

TEST_F(SceneSession, AFilmIsAttachedEditedVariedByAPictureSavedAndOpenedAgainAsItWas) {
    draw_until_open();
    session_.view.pick({0.3, 0.5});
    draw(4);
    const auto bare = picture();
    const auto drawn = [&] {
        draw_until([&] { return !session_.opened.busy(); });
        draw(4);
        return picture();
    };
    session_.open_preset("anodised_titanium");
    EXPECT_FALSE(last_message().failure) << last_message().text;
    const auto attached = drawn();
    EXPECT_EQ(changes(bare, attached)[1], 0);
    EXPECT_GT(changes(bare, attached)[0], 100);
    EXPECT_EQ(session_.opened.film()->material.range.roughest, 0.5) << "the surface's own";

    document().set_value(field_at("/iridescenceFactor"), 0);
    document().finish_edit();
    EXPECT_EQ(drawn(), bare);
    document().undo();
    EXPECT_EQ(drawn(), attached);
    const auto table = session_.opened.film();
    document().set_value(field_at("/iridescenceFactor"), 0.5);
    const auto half = drawn();
    EXPECT_NE(half, attached);
    EXPECT_EQ(session_.opened.film(), table) << "which does not depend on the factor";

    const std::vector<std::uint8_t> grey = {40, 40, 40, 255, 220, 220, 220, 255};
    write_file_atomic(path("bands.png"), image::encode_png(2, 1, 4, grey));
    session_.open(path("bands.png"));
    EXPECT_FALSE(last_message().failure) << last_message().text;
    const auto varied = drawn();
    EXPECT_NE(varied, half);
    EXPECT_EQ(session_.opened.film()->material.range.thinnest_nm, 0.0);
    session_.opened.save();
    EXPECT_EQ(test::run({ROWLAND_COOK, "check", path("spheres.glb").string()}).code, 0);
    session_.open(path("spheres.glb"));
    session_.opened.finish_opening();
    EXPECT_TRUE(document().has_film());
    EXPECT_EQ(drawn(), varied);
    session_.open(path("m.json"));
    EXPECT_TRUE(document().has_grating()) << "which replaces the film";
    session_.opened.remove();
    EXPECT_EQ(drawn(), bare);
}

TEST_F(SceneSession, WhatAFilmCannotBeIsSaid) {
    draw_until_open();
    write_file_atomic(path("stack.json"), R"({"film": [{"ior": 2.4, "thickness_nm": 57},
        {"ior": 1.46, "thickness_nm": 94}], "base": {"ior": 1.52}})");
    session_.open(path("stack.json"));
    EXPECT_THAT(last_message().text, testing::AllOf(HasSubstr("stack.json: /film: 2 layers"), HasSubstr("one layer")));
    EXPECT_FALSE(document().accepted());
    session_.opened.paste(R"({"film": {"ior": 1.33, "thickness_nm": 250}, "metal": "Au"})");
    EXPECT_EQ(document().json()["extras"]["metal"], "Au") << last_message().text;
    document().set_choice(field_at("/iridescenceThicknessTexture"), "texture");
    draw_until([&] { return last_message().failure; });
    EXPECT_THAT(last_message().text, HasSubstr("/iridescenceThicknessTexture"));
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

TEST_F(SceneSession, CapturesTheLightOfItsBoxesAgain) {
    EXPECT_EQ(session_.boxes(), 0U);
    const auto glb = [](double distance) {
        nlohmann::json file = {{"asset", {{"version", "2.0"}}}, {"extensionsUsed", {"ROWLAND_light_probe"}}};
        nlohmann::json primitive =
            scene::test::primitive_of(file, scene::build_mesh(scene::SphereRecipe{.radius = 0.5}));
        file["meshes"] = {{{"primitives", {primitive}}}};
        file["nodes"] = {{{"mesh", 0}, {"translation", {distance, 0, 0}}},
                         {{"name", "hall"},
                          {"extensions", {{"ROWLAND_light_probe", {{"size_m", {4, 4, 4}}, {"probe", "hall.probe"}}}}}}};
        file["scenes"] = {{{"nodes", {0, 1}}}};
        return scene::test::glb_of(file);
    };
    const auto capture = [&](double distance) {
        write_file_atomic(path("hall.glb"), glb(distance));
        session_.open(path("hall.glb"));
        draw_until(
            [&] { return session_.boxes() == 1 && session_.opened.opening().empty() && session_.light.current(); });
        session_.capture_probes();
        EXPECT_TRUE(session_.capturing() && session_.busy());
        draw_until([&] { return !session_.capturing(); });
        EXPECT_THAT(last_message().text, HasSubstr("captured"));
        return read_file(path("hall.probe"), 1 << 26);
    };
    const auto near = capture(1.0);
    EXPECT_NE(near, capture(5.0));
    write_file_atomic(path("hall.glb"), std::vector<std::byte>(5));  // another program damages it
    session_.capture_probes();
    draw_until([&] { return !session_.capturing(); });
    EXPECT_TRUE(last_message().failure);
    EXPECT_THAT(last_message().text, HasSubstr("exit code 2"));
    session_.opened.close_scene();
    session_.capture_probes();
    EXPECT_FALSE(session_.capturing());
}

}  // namespace
}  // namespace rowland::inspector
