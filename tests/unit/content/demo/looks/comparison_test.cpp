// Looks of gratings, drawn without a window.
#include "content/demo/looks/comparison.h"

#include <gmock/gmock.h>

#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/vertex_light.h"
#include "tests/gpu/render_test.h"

namespace rowland::demo {
namespace {

using Pixels = std::vector<glm::vec4>;

class ComparisonTest : public test::RenderTest {
 protected:
    ComparisonTest() {
        diffraction::register_module(renderer_);
        renderer_.set_probe(lighting::build_light_probe(
            sky(), {.bands = 8, .key_lights = 0, .light_face = 16, .prefilter = {.face_size = 16}}));
        grating_ = add_grating(cooked(1600));
        camera_.eye = {1.6F, 0.4F, 2.2F};
    }

    static lighting::ProbeImage sky() {
        image::Image image{.width = 64, .height = 32, .texels = std::vector(std::size_t{64} * 32, glm::vec3(0.1F))};
        for (int row = 6; row < 12; ++row)
            for (int column = 8; column < 24; ++column)
                image.texels[static_cast<std::size_t>(row * 64 + column)] = glm::vec3(9.0F, 8.0F, 7.0F);
        return {std::move(image), lighting::Mapping::Equirectangular, "sky"};
    }
    static diffraction::CookedMaterial cooked(int pitch_nm) {
        const std::string json = R"({"grating": {"pitch_nm": )" + std::to_string(pitch_nm) +
                                 R"(, "profile": {"type": "slit", "width_nm": 300}},
                                     "quality": {"representation": "spikes", "bands": 8}})";
        return diffraction::cook_material(nlohmann::json::parse(json), "test");
    }
    ecs::Entity add_grating(const diffraction::CookedMaterial& material) {
        const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.0F)});
        world_.add(entity, surface_of(material));
        return entity;
    }
    diffraction::DiffractionSurface surface_of(const diffraction::CookedMaterial& material) const {
        return {.material = diffraction::make_gpu_material(material, renderer_.xyz_to_working())};
    }
    /// As drawn once nothing is being baked any more.
    Pixels settled() {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        do {
            comparison_.update();
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        } while (comparison_.baking() && std::chrono::steady_clock::now() < deadline);
        EXPECT_FALSE(comparison_.baking());
        comparison_.update();
        return draw();
    }
    /// Columns [begin, end) of both are the same, or not.
    static bool same(const Pixels& a, const Pixels& b, int begin, int end) {
        for (int row = 0; row < kSize; ++row)
            for (int column = begin; column < end; ++column) {
                const auto at = static_cast<std::size_t>(row * kSize + column);
                if (a[at] != b[at]) return false;
            }
        return true;
    }

    static Look coarse_spikes() { return {.representation = "spikes", .detail = Detail::Coarse}; }

    /// The folder of the shader that gives an object its light from the probe, once its maps are filled; empty: none.
    std::string drawn_by(ecs::Entity grating) {
        do draw();
        while (diffraction::maps_are_filling(world_));
        const auto& state = world_.get<diffraction::SurfaceState>(grating);
        for (const auto& [name, file] : state.material->program(state).defines)
            if (name == "PROBE_LIGHT" || name == "VERTEX_LIGHT")
                return std::filesystem::path(file).parent_path().filename().string();
        return {};
    }
    /// Patches of two directions.
    static std::shared_ptr<const diffraction::GrooveMap> patches() {
        image::ByteImage image{.width = 2, .height = 1, .rgba = {0, 128, 0, 255, 90, 128, 0, 255}};
        scene::ImportedScene scene;
        scene.images = {std::make_shared<const image::ByteImage>(std::move(image))};
        scene.textures.resize(1);
        render::SurfaceTextures textures(scene);
        return std::make_shared<const diffraction::GrooveMap>(diffraction::GrooveTexture{}, textures, "test", "");
    }

    Comparison comparison_{world_, renderer_.xyz_to_working()};
    ecs::Entity grating_;
};

TEST_F(ComparisonTest, PanelsNameTheRepresentationThatDrawsWhateverTheMeshForces) {
    const std::string slit = R"({"pitch_nm": 1600, "orders": [1], "profile": {"type": "slit", "width_nm": 300}})";
    const std::string narrow = R"({"pitch_nm": 1600, "orders": [1], "groove_lobe": {"sigma": 0.1},
                                   "profile": {"type": "slit", "width_nm": 300}})";
    const std::string lattice = R"({"lattice": {"a_nm": [1000, 0], "b_nm": [0, 1000]}, "orders": 1,
        "profile": {"type": "aperture", "width_nm": 500, "height_nm": 500}})";
    scene::Mesh bent = square();
    bent.normals[0] = glm::normalize(glm::vec3(0.1F, 0.0F, 1.0F));
    scene::Mesh skinned = square();
    skinned.joints.assign(4, glm::u16vec4(0));
    skinned.weights.assign(4, {1.0F, 0.0F, 0.0F, 0.0F});
    const ecs::Entity joint = world_.create();
    world_.add(joint, scene::WorldMatrix{glm::mat4(1.0F)});
    struct Object {
        const char* name;
        std::string grating;
        scene::Mesh mesh = square();
        bool skinned = false;
        std::shared_ptr<const diffraction::GrooveMap> grooves = nullptr;
        std::string only{};  ///< representation; empty: all
    };
    const Object objects[] = {{"flat", slit},
                              {"curved", slit, bent},
                              {"skinned", slit, skinned, true},
                              {"groove texture", slit, square(), false, patches()},
                              {"flat, a lobe", narrow, square(), false, nullptr, "streak"},
                              {"curved, a lobe", narrow, bent, false, nullptr, "streak"},
                              {"flat lattice", lattice},
                              {"curved lattice", lattice, bent},
                              {"skinned lattice", lattice, skinned, true}};
    std::map<std::string, int> cases;
    for (const Object& object : objects)
        for (const auto* info : diffraction::representations()) {
            if (!object.only.empty() && object.only != info->name) continue;
            SCOPED_TRACE(std::string(info->name) + ", " + object.name);
            nlohmann::json quality{{"representation", info->name}, {"key_lights", 4}};
            // Quick to bake: only the program is looked at.
            for (const auto& [key, value] : {std::pair("bands", 3), {"rank", 4}, {"spikes", 2}, {"map_resolution", 16}})
                if (info->find(key) != nullptr) quality[key] = value;
            const auto grating = nlohmann::json::parse(object.grating);
            diffraction::Material material = diffraction::parse_material({{"grating", grating}}, "test");
            const auto suited = diffraction::suited_quality(quality, material.grating);
            if (!std::holds_alternative<diffraction::Quality>(suited)) continue;
            material.quality = std::get<diffraction::Quality>(suited);
            if (object.grooves) {
                if (groove_refusal(material, object.grooves->pitches())) continue;
                material = suited_to_grooves(material, object.grooves->pitches());
            }
            world_.destroy(grating_);
            const auto cooked = diffraction::bake_material(material);
            grating_ = add(scene::Mesh(object.mesh), {.base_colour = glm::vec3(0.0F)});
            world_.add(grating_, surface_of(cooked));
            world_.get<diffraction::DiffractionSurface>(grating_).grooves = object.grooves;
            if (object.skinned) world_.add(grating_, scene::Skin{{joint}, {glm::mat4(1.0F)}});
            comparison_.update();
            const std::string drawn = drawn_by(grating_);
            const std::string expected = drawn.empty() ? "direct" : drawn;
            const auto layout = comparison_.layout(grating_);
            EXPECT_EQ(comparison_.title(grating_, Side::Left),
                      expected + (expected == info->name ? " (cooked)" : std::string(" in place of ") + info->name));
            EXPECT_EQ(diffraction::drawn_info(cooked.tables, layout).name, expected);
            EXPECT_EQ(diffraction::info(as_drawn(cooked, layout).tables).name, expected) << "measured and priced";
            ++cases[expected == info->name ? info->name : "another"];
        }
    using testing::Pair;
    EXPECT_THAT(cases, testing::ElementsAre(Pair("another", 4), Pair("arc", 7), Pair("circle", 3), Pair("direct", 7),
                                            Pair("planar", 3), Pair("spikes", 6), Pair("streak", 2)));
}

TEST_F(ComparisonTest, AnotherLookShowsOnceItIsBakedAndTheOldOneUntilThen) {
    const Pixels own = settled();
    comparison_.set_look(grating_, Side::Left, coarse_spikes());
    comparison_.update();
    EXPECT_TRUE(comparison_.baking());
    EXPECT_TRUE(same(draw(), own, 0, kSize));
    EXPECT_FALSE(same(settled(), own, 0, kSize));
    comparison_.set_look(grating_, Side::Left, {});
    EXPECT_TRUE(same(settled(), own, 0, kSize));
}

TEST_F(ComparisonTest, AWipeShowsEachLookOnItsSideOfTheLineAndNothingElse) {
    const Pixels own = settled();
    comparison_.set_look(grating_, Side::Left, coarse_spikes());
    const Pixels coarse = settled();
    comparison_.set_look(grating_, Side::Left, {});
    comparison_.set_look(grating_, Side::Right, coarse_spikes());
    comparison_.set_wiping(true);
    comparison_.set_line(0.5F);
    const int line = static_cast<int>(std::lround(0.5F * kSize));
    const Pixels wiped = settled();
    EXPECT_TRUE(same(wiped, own, 0, line));
    EXPECT_TRUE(same(wiped, coarse, line, kSize));
    EXPECT_FALSE(same(wiped, own, line, kSize));
    comparison_.set_line(1.0F);
    EXPECT_TRUE(same(settled(), own, 0, kSize));
    comparison_.set_line(0.0F);
    EXPECT_TRUE(same(settled(), coarse, 0, kSize));
    comparison_.set_wiping(false);
    EXPECT_TRUE(same(settled(), own, 0, kSize));
}

TEST_F(ComparisonTest, CopiesAreNoGratingsAndEndWithTheirGrating) {
    comparison_.set_wiping(true);
    settled();
    EXPECT_EQ(comparison_.gratings().size(), 1U);
    const std::size_t living = world_.living();
    world_.destroy(grating_);
    comparison_.update();
    EXPECT_EQ(world_.living(), living - 2);
}

TEST_F(ComparisonTest, GratingsAreListedInTheOrderOfTheirCreation) {
    add_grating(cooked(900));
    add_grating(cooked(1100));
    const std::vector<ecs::Entity> before = comparison_.gratings();
    ASSERT_EQ(before.size(), 3U);
    world_.remove<diffraction::DiffractionSurface>(before[0]);
    world_.add(before[0], surface_of(cooked(1300)));
    EXPECT_EQ(comparison_.gratings(), before);
}

TEST_F(ComparisonTest, AReloadedMaterialKeepsItsObjectsLook) {
    comparison_.set_look(grating_, Side::Left, coarse_spikes());
    const Pixels before = settled();
    world_.add(grating_, surface_of(cooked(700)));
    EXPECT_FALSE(same(settled(), before, 0, kSize));
    EXPECT_EQ(comparison_.look(grating_, Side::Left), coarse_spikes());
    const auto& shown = comparison_.shown(grating_, Side::Left)->cooked();
    EXPECT_TRUE(std::holds_alternative<diffraction::SpikeTable>(shown->tables));
    EXPECT_EQ(shown->material.grating.pitch_nm, 700.0);
}

TEST_F(ComparisonTest, AChoiceForAllIsForObjectsToComeAndOnlyWhereItSuits) {
    comparison_.set_look_of_all(Side::Left, {.representation = "planar"});
    EXPECT_EQ(comparison_.look(grating_, Side::Left).representation, "planar");
    comparison_.set_look_of_all(Side::Left, {.representation = "streak"});
    EXPECT_TRUE(comparison_.look(grating_, Side::Left).own());
    comparison_.set_look_of_all(Side::Left, coarse_spikes());
    const ecs::Entity later = add_grating(cooked(700));
    EXPECT_EQ(comparison_.look(later, Side::Left), coarse_spikes());
}

}  // namespace
}  // namespace rowland::demo
