#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <thread>

#include "editor/inspector/session.h"
#include "engine/core/file.h"
#include "engine/platform/headless_context.h"
#include "engine/scene/glb_write.h"
#include "engine/scene/mesh_recipe.h"
#include "tests/support/small_sky.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

constexpr glm::ivec2 kSize{64, 48};

/// A red sphere on the left and a blue one on the right.
std::vector<std::byte> two_spheres() {
    scene::GlbScene scene;
    for (std::size_t i = 0; i < 2; ++i) {
        scene::GlbMaterial& material = scene.materials.emplace_back();
        material.name = i == 0 ? "red" : "blue";
        material.colour = i == 0 ? glm::dvec4(0.8, 0.02, 0.02, 1.0) : glm::dvec4(0.02, 0.02, 0.8, 1.0);
        scene.meshes.push_back(
            {i == 0 ? "left" : "right", {{scene::build_mesh(scene::SphereRecipe{.radius = 0.5}), i}}});
        scene::GlbNode& node = scene.nodes.emplace_back();
        node.name = i == 0 ? "left" : "right";
        node.local.translation.x = i == 0 ? -0.6F : 0.6F;
        node.mesh = i;
    }
    return scene::write_glb(scene);
}

class SceneSession : public testing::Test {
 protected:
    SceneSession() {
        write_file_atomic(path("sky.json"), test::small_sky(64));
        write_file_atomic(
            path("m.json"),
            R"({"grating": {"pitch_nm": 1600, "orders": [1], "profile": {"type": "slit", "width_nm": 800}},
                "base": {"color": [0, 1, 0]}, "quality": {"representation": "spikes", "bands": 3, "spikes": 2}})");
        write_file_atomic(path("spheres.glb"), two_spheres());
        session_.choose_light(path("sky.json"));
        session_.open(path("spheres.glb"));
    }
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    void draw(int frames) {
        for (int i = 0; i < frames; ++i) {
            session_.update();
            session_.draw(kSize, opening_camera(), false, 0.01F);
        }
    }
    template <typename Condition>
    void draw_until(Condition&& holds) {
        for (int i = 0; i < 24000 && !holds(); ++i) {
            draw(1);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        ASSERT_TRUE(holds());
    }
    void draw_until_open() {
        draw_until([&] { return session_.scene() != nullptr && session_.ready(); });
        draw(3);
    }
    void draw_until_cooked() {
        draw(1);  // begins it
        draw_until([&] { return session_.cooked() && !session_.cooking(); });
    }
    void attach() {
        session_.open(path("m.json"));
        draw_until_cooked();
        draw(100);
    }
    std::vector<glm::vec4> picture() { return session_.preview().linear().read_rgba_float(); }
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

    test::TemporaryFolder folder_;
    platform::HeadlessContext context_;
    post::OcioConfig config_ = post::OcioConfig::choose(std::nullopt);
    Session session_{config_, {.content_folder = test::source_path("content"), .still = true}};
};

TEST_F(SceneSession, OpensInTheBackgroundAndShowsItsOwnMaterials) {
    EXPECT_EQ(session_.opening(), path("spheres.glb"));
    EXPECT_EQ(session_.scene(), nullptr);
    draw_until_open();
    EXPECT_TRUE(session_.opening().empty());
    EXPECT_EQ(session_.shape(), PreviewShape::Model);
    const auto shown = picture();
    const glm::vec4 left = shown[pixel(0.3, 0.5)];
    const glm::vec4 right = shown[pixel(0.7, 0.5)];
    EXPECT_GT(left.r, 3.0F * left.b);
    EXPECT_GT(right.b, 3.0F * right.r);
    ASSERT_EQ(session_.scene()->materials.size(), 2U);
    EXPECT_EQ(session_.scene()->materials[1].name, "blue");
    EXPECT_THAT(session_.scene()->materials[1].meshes, testing::ElementsAre("right"));
}

TEST_F(SceneSession, AClickChoosesAMaterialAndItsGratingLeavesTheOthersAsTheyWere) {
    draw_until_open();
    draw(100);
    const auto before = picture();
    session_.pick({0.7, 0.5});
    EXPECT_EQ(session_.document().chosen(), 1U);
    attach();
    const auto after = picture();
    EXPECT_EQ(changes(before, after)[0], 0);
    EXPECT_GT(changes(before, after)[1], 100);
    // The scene's own surface stays under the grating: blue, not the material file's green.
    EXPECT_FALSE(session_.document().json().contains("base"));
    session_.remove_grating();
    draw(100);
    EXPECT_EQ(picture(), before);
    session_.document().undo();
    draw_until_cooked();
    draw(100);
    EXPECT_EQ(picture(), after);
}

TEST_F(SceneSession, TurnedGroovesAreDrawnWithoutBakingAndThePickedFrameTurnsWithThem) {
    draw_until_open();
    session_.pick({0.3, 0.5});
    attach();
    const auto before = picture();
    const auto cooked = session_.cooked();
    ASSERT_TRUE(session_.surface());
    const glm::dvec3 g = session_.surface()->frame.grating;
    session_.document().set_value(field_at("/grooveRotation"), 1.0);
    draw_until_cooked();
    draw(100);
    EXPECT_EQ(session_.cooked(), cooked);
    EXPECT_EQ(changes(before, picture())[1], 0);
    EXPECT_GT(changes(before, picture())[0], 50);
    const glm::dvec3 turned = session_.surface()->frame.grating;
    EXPECT_NEAR(glm::dot(turned, g), std::cos(1.0), 1e-6);
}

TEST_F(SceneSession, StrokesFollowTheGroovesWhereTheyAreSeen) {
    draw_until_open();
    session_.pick({0.3, 0.5});
    attach();
    session_.shows_grooves = true;
    // On the sphere's equator the tangent is along the longitude, so the grooves run up and down.
    const auto gradients = [&] {
        draw(2);
        const auto strokes = session_.preview().grooves()->read_rgba_float();
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
    session_.document().set_value(field_at("/grooveRotation"), 1.571);
    draw_until_cooked();
    draw(2);
    const glm::dvec2 flat = gradients();
    EXPECT_GT(flat.y, 1.5 * flat.x);
    for (const glm::vec4& of_right : {session_.preview().grooves()->read_rgba_float()[pixel(0.7, 0.5)]})
        EXPECT_EQ(of_right.a, 0.0F);
}

TEST_F(SceneSession, AFoilPatternVariesTheGroovesOfItsMaterial) {
    draw_until_open();
    session_.pick({0.3, 0.5});
    session_.set_foil_pattern("tiles");
    EXPECT_TRUE(session_.messages().back().failure) << "there is no grating that it could vary";
    write_file_atomic(path("foil.json"),
                      R"({"grating": {"pitch_nm": 1600, "orders": [1], "profile": {"type": "slit", "width_nm": 800}},
                          "quality": {"representation": "direct"}})");
    session_.open(path("foil.json"));
    draw_until_cooked();
    draw(10);
    const auto before = picture();
    session_.set_foil_pattern("tiles");
    EXPECT_FALSE(session_.messages().back().failure) << session_.messages().back().text;
    draw_until_cooked();
    draw(10);
    EXPECT_GT(changes(before, picture())[0], 50);
    EXPECT_EQ(changes(before, picture())[1], 0);
}

TEST_F(SceneSession, OpeningIsCancelledAndARefusedFileIsSaid) {
    session_.cancel_opening();
    EXPECT_TRUE(session_.opening().empty());
    draw(5);
    write_file_atomic(path("bad.glb"), std::string_view("glTF, but not really"));
    session_.open(path("bad.glb"));
    draw_until([&] { return session_.opening().empty(); });
    EXPECT_TRUE(session_.messages().back().failure);
    EXPECT_THAT(session_.messages().back().text, HasSubstr("bad.glb"));
    EXPECT_EQ(session_.scene(), nullptr);
    EXPECT_EQ(session_.document().name(), "cd.json");
}

TEST_F(SceneSession, LeavingASceneShowsAMaterialOnAShapeAgain) {
    draw_until_open();
    session_.close_scene();
    EXPECT_EQ(session_.scene(), nullptr);
    EXPECT_EQ(session_.shape(), PreviewShape::Disc);
    draw_until([&] { return session_.ready() && session_.cooked(); });
    EXPECT_EQ(session_.document().name(), "cd.json");
}

TEST_F(SceneSession, AsksBeforeItSavesOverAFileThatAnotherProgramChanged) {
    draw_until_open();
    session_.open(path("m.json"));
    const std::vector<std::byte> exported = read_file(path("spheres.glb"), 1 << 24);
    std::vector<std::byte> again = exported;
    again.resize(again.size() + 4);
    write_file_atomic(path("spheres.glb"), again);
    session_.save();
    EXPECT_TRUE(session_.asks_to_overwrite);
    EXPECT_EQ(read_file(path("spheres.glb"), 1 << 24), again);
    session_.save(true);
    EXPECT_FALSE(session_.asks_to_overwrite);
    EXPECT_FALSE(session_.document().dirty());
    EXPECT_NE(read_file(path("spheres.glb"), 1 << 24), again);
}

}  // namespace
}  // namespace rowland::inspector
