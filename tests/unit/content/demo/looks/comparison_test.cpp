// Looks of gratings, drawn without a window.
#include "content/demo/looks/comparison.h"

#include <chrono>
#include <thread>

#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/module.h"
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

    Comparison comparison_{world_, renderer_.xyz_to_working()};
    ecs::Entity grating_;
};

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
