#include "modules/diffraction/cook.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <memory>
#include <set>

#include "engine/core/json_reader.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/groove_pitches.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/support/threads.h"

namespace rowland::diffraction {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A material with a budget under a small probe recipe, in a folder of their own.
class BudgetMaterial : public ::testing::Test {
 protected:
    BudgetMaterial() {
        write_file_atomic(probe(), R"({"probe": {"type": "studio", "ceiling": [0.3, 0.3, 0.3], "wall": [0.2, 0.2, 0.3],
            "floor": [0.1, 0.1, 0.1], "width": 64, "key_lights": 3, "boxes": [{"azimuth_deg": 40, "elevation_deg": 50,
            "half_size_deg": [20, 10], "soft_edge_deg": 4, "radiance": [9, 8, 7]}]}})");
        write({{"max_error", 0.2}, {"illuminant", "F2"}, {"probes", {"room.json"}}});
        register_module(registry_);
    }

    std::filesystem::path source() const { return folder_.path() / "m.json"; }
    std::filesystem::path probe() const { return folder_.path() / "room.json"; }
    void write(const nlohmann::json& quality) const {
        const nlohmann::json json = {
            {"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}},
            {"quality", quality}};
        write_file_atomic(source(), json.dump());
    }
    std::vector<std::byte> cook() const {
        cook::Context context(source());
        return registry_.find(kMaterialAssetType)->cook(context);
    }

    rowland::test::TemporaryFolder folder_;
    cook::Registry registry_;
};

TEST_F(BudgetMaterial, RecordsWhatWasChosenAndMeasured) {
    const std::vector<std::byte> payload = cook();
    const CookedMaterial cooked = read_cooked_material(payload, "m.material");
    ASSERT_TRUE(cooked.measured);
    EXPECT_EQ(cooked.measured->max_error, 0.2);
    EXPECT_EQ(cooked.measured->frames, 240);
    ASSERT_EQ(cooked.measured->probes.size(), 1U);
    EXPECT_LE(cooked.measured->probes[0].error, 0.2);
    ASSERT_TRUE(cooked.material.quality.pinned);
    EXPECT_EQ(cooked.material.quality.illuminant.name, "F2");
    EXPECT_THAT(describe(cooked), ::testing::AllOf(HasSubstr("max_error: 0.2\n"), HasSubstr("under room.json"),
                                                   HasSubstr("flat surface, 240 frames"), HasSubstr("price: ")));
    for (std::size_t missing = 1; missing < 400; missing += 7)
        EXPECT_THROW(read_cooked_material(std::span(payload).first(payload.size() - missing), "m.material"), Error);
}

/// As the record and `rowland-cook info` say it, and as anyone computes it.
TEST_F(BudgetMaterial, MayAskForTheErrorThatIsSeen) {
    write({{"max_error", 0.1}, {"measure", "hdr_flip"}, {"surface", "curved"}, {"probes", {"room.json"}}});
    const CookedMaterial cooked = read_cooked_material(cook(), "m.material");
    ASSERT_TRUE(cooked.measured);
    EXPECT_EQ(cooked.measured->measure, ErrorMeasure::HdrFlip);
    const lighting::ProbeRecipe recipe =
        lighting::parse_probe_recipe(parse_json(read_text_file(probe(), 1 << 16), "room.json"), "room.json");
    const lighting::ProbeImage room = lighting::render_recipe(recipe, {}, "room.json");
    Material asked = cooked.material;
    asked.quality.measure = ErrorMeasure::HdrFlip;
    asked.quality.surface = SurfaceShape::Curved;
    const MeasuredViews views = drawn_views(asked, room);
    EXPECT_EQ(static_cast<std::size_t>(cooked.measured->frames), views.points());
    EXPECT_THAT(describe(cooked), ::testing::AllOf(HasSubstr("measure: hdr_flip\n"),
                                                   HasSubstr(fmt::format("{} frames", views.points()))));
    const BudgetRecord::OfProbe& of_room = cooked.measured->probes.at(0);
    const EvaluationLight light =
        EvaluationLight(room, recipe.settings.key_lights, math::SphericalWindow::None).with_first(of_room.key_lights);
    double error = 0.0;
    for (const std::vector<ShadingPoint>& points : views.parts)
        error = std::max(error, error_function(ErrorMeasure::HdrFlip, SurfaceShape::Curved)(
                                    evaluate_baked(cooked, light, points),
                                    reference_radiance(cooked.material.grating, room, colour::LightSpectra(), points)));
    EXPECT_LE(error, 0.1);
    EXPECT_GT(error, 0.0);
    EXPECT_NEAR(of_room.error, error, 1e-9);  // the same sums
}

TEST_F(BudgetMaterial, CookingAndCheckingDependOnTheProbe) {
    for (const bool cooking : {true, false}) {
        cook::Context context(source());
        const cook::AssetType* type = registry_.find(kMaterialAssetType);
        cooking ? static_cast<void>(type->cook(context)) : type->check(context);
        EXPECT_THAT(context.dependencies(), ElementsAre(source(), probe()));
    }
}

TEST_F(BudgetMaterial, HasTheSameBytesWithAnyNumberOfThreads) {
    rowland::test::expect_same_on_any_threads([&] { return cook(); });
}

TEST_F(BudgetMaterial, AMissingProbeIsRefusedAndStillADependency) {
    std::filesystem::remove(probe());
    cook::Context context(source());
    EXPECT_THAT(rowland::test::message_of([&] { registry_.find(kMaterialAssetType)->cook(context); }),
                HasSubstr("room.json"));
    EXPECT_THAT(context.dependencies(), ElementsAre(source(), probe()));
}

TEST_F(BudgetMaterial, OutOfReachIsRefusedByFileAndPlace) {
    write({{"max_error", 1e-6}, {"surface", "curved"}, {"probes", {"room.json"}}});
    EXPECT_THAT(rowland::test::message_of([&] { cook(); }),
                ::testing::AllOf(HasSubstr("m.json"), HasSubstr("/quality/max_error"), HasSubstr("at least")));
}

TEST_F(BudgetMaterial, APinnedMaterialIsBakedUnmeasured) {
    write({{"max_error", 1e-6}, {"representation", "arc"}, {"bands", 3}});
    const CookedMaterial cooked = read_cooked_material(cook(), "m.material");
    EXPECT_FALSE(cooked.measured);
    EXPECT_EQ(std::get<ArcTable>(cooked.tables).bands, 3);
    EXPECT_THAT(describe(cooked), ::testing::Not(HasSubstr("measured")));
}

TEST_F(BudgetMaterial, WithoutProbesTheClearSkyIsMeant) {
    write({{"max_error", 0.5}});
    const CookedMaterial cooked = read_cooked_material(cook(), "m.material");
    ASSERT_TRUE(cooked.measured);
    EXPECT_THAT(cooked.measured->probes.at(0).probe, HasSubstr("clear sky"));
}

/// The same grating on the only material of a scene.
class GratingInScene : public BudgetMaterial {
 protected:
    GratingInScene() {
        scene_.meshes.resize(1);
        scene_.meshes[0].normals = {{0.0F, 1.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
        scene_.instances = {{.name = "m", .mesh = 0, .material = 0, .node = 0, .skin = {}}};
        scene_.materials.resize(1);
        auto texture = std::make_shared<image::ByteImage>();
        texture->width = 2;
        texture->height = 1;
        texture->rgba = {10, 100, 0, 255, 200, 160, 0, 255};
        scene_.images = {texture};
        scene_.textures.resize(1);
    }

    const cook::GltfExtension& extension() const { return registry_.gltf_extensions().at(0); }
    std::vector<std::byte> tables(const nlohmann::json& quality, const nlohmann::json& more = {}) const {
        nlohmann::json object = {{"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}},
                                 {"quality", quality},
                                 {"grooveRotation", 0.5}};
        object.update(more.is_null() ? nlohmann::json::object() : more);
        cook::Context context(source());
        return extension().cook(context, {object, "/materials/0/extensions/E", scene_, 0});
    }
    CookedMaterial cooked(const nlohmann::json& quality, const nlohmann::json& more = {}) const {
        return read_gltf_tables(tables(quality, more), "s.scene");
    }

    scene::ImportedScene scene_;
};

TEST_F(GratingInScene, IsChosenForItsBudgetAsAMaterialFileIs) {
    const nlohmann::json quality = {{"max_error", 0.2}, {"illuminant", "F2"}, {"probes", {"room.json"}}};
    const std::vector<std::byte> bytes = tables(quality);
    const CookedMaterial in_scene = read_gltf_tables(bytes, "s.scene");
    const CookedMaterial in_file = read_cooked_material(cook(), "m.material");
    EXPECT_EQ(describe(in_scene), describe(in_file));
    EXPECT_EQ(extension().describe_tables(bytes, "s.scene"), describe(in_file));
    EXPECT_EQ(tables(quality, {{"grooveRotation", 1.5}}), bytes);  // the direction is the surface's
    for (std::size_t missing = 1; missing < 400; missing += 7)
        EXPECT_THROW(read_gltf_tables(std::span(bytes).first(bytes.size() - missing), "s.scene"), Error);
}

TEST_F(GratingInScene, APinnedOneStaysAndIsMeasured) {
    const CookedMaterial cooked = this->cooked({{"representation", "arc"}, {"bands", 3}});
    EXPECT_EQ(std::get<ArcTable>(cooked.tables).bands, 3);
    ASSERT_TRUE(cooked.measured);
    EXPECT_FALSE(cooked.measured->has_budget());
    EXPECT_GT(cooked.measured->largest_error(), 0.0);
    EXPECT_THAT(describe(cooked),
                ::testing::AllOf(HasSubstr("representation: arc"), HasSubstr("pinned"),
                                 HasSubstr("under the built-in clear sky"), HasSubstr("largest_error: ")));
}

TEST_F(GratingInScene, IsMeasuredOnTheShapeOfItsMeshesUnlessItNamesOne) {
    const auto measured_on = [&](nlohmann::json quality) {
        quality["probes"] = {"room.json"};
        return cooked(quality).measured->surface;
    };
    EXPECT_EQ(measured_on({{"max_error", 0.5}}), SurfaceShape::Flat);
    scene_.meshes[0].normals[1] = {1.0F, 0.0F, 0.0F};
    EXPECT_EQ(measured_on({{"max_error", 0.5}}), SurfaceShape::Curved);
    EXPECT_EQ(measured_on({{"max_error", 0.5}, {"surface", "flat"}}), SurfaceShape::Flat);
}

TEST_F(GratingInScene, AStatedBudgetOutOfReachIsRefusedByItsPointer) {
    EXPECT_THAT(rowland::test::message_of([&] {
                    tables({{"max_error", 1e-6}, {"surface", "curved"}, {"probes", {"room.json"}}});
                }),
                HasSubstr("/materials/0/extensions/E/quality/max_error"));
}

TEST_F(GratingInScene, ItsPartIsAnotherForAnotherShapeObjectOrTexture) {
    const auto key = [&](const nlohmann::json& object) {
        return extension().part_key({object, "/materials/0/extensions/E", scene_, 0});
    };
    const nlohmann::json plain = {{"grating", {{"pitch_nm", 1600}}}, {"grooveRotation", 0.5}};
    const nlohmann::json textured = {{"grating", {{"pitch_nm", 1600}}}, {"grooveTexture", {{"index", 0}}}};
    nlohmann::json turned = plain;
    turned["grooveRotation"] = 1.5;
    EXPECT_EQ(key(plain), key(turned));
    std::set<std::string> keys = {key(plain),
                                  key(textured),
                                  key({{"grating", {{"pitch_nm", 1601}}}}),
                                  key({{"grooveTexture", 3}}),
                                  key({{"grooveTexture", {{"index", 9}}}}),
                                  key({{"grooveTexture", {{"index", "x"}}}})};
    auto texture = std::make_shared<image::ByteImage>(*scene_.images[0]);
    texture->rgba[1] = 101;
    scene_.images[0] = texture;
    keys.insert(key(textured));
    scene_.meshes[0].normals[1] = {1.0F, 0.0F, 0.0F};
    keys.insert({key(plain), key(textured)});
    EXPECT_EQ(keys.size(), 9U);
}

TEST_F(GratingInScene, WithATextureHasTablesForItsPitches) {
    const nlohmann::json texture = {{"grooveTexture", {{"index", 0}}}};
    const CookedMaterial cooked = this->cooked({{"max_error", 0.5}, {"probes", {"room.json"}}}, texture);
    const GroovePitches pitches = groove_pitches(*scene_.images[0]);
    EXPECT_FALSE(groove_refusal(cooked.material, pitches));
    if (const auto* arc = std::get_if<ArcTable>(&cooked.tables)) {
        ASSERT_TRUE(arc->pitch);
        EXPECT_NEAR(arc->pitch->largest, 320.0 / 255.0, 1e-9);
    }
    EXPECT_THAT(rowland::test::message_of([&] {
                    tables({{"representation", "spikes"}}, texture);
                }),
                HasSubstr("grooveTexture"));
    EXPECT_THAT(rowland::test::message_of([&] {
                    tables(nlohmann::json::object(), {{"grooveTexture", {{"index", 3}}}});
                }),
                HasSubstr("1 textures"));
}

}  // namespace
}  // namespace rowland::diffraction
