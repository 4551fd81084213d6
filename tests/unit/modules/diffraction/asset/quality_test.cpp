// The member "quality" of a material, and methods, which are written as one.
#include "modules/diffraction/asset/quality.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "modules/diffraction/asset/cooked_material.h"
#include "tests/support/expect.h"

namespace rowland::diffraction {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Material parse_alone(const std::string& text) {
    return parse_material(parse_json(text, "m.json"), "m.json");
}

/// The message that refuses it.
std::string refusal(const std::string& text) {
    return rowland::test::message_of([&] { parse_alone(text); });
}

std::string with_quality(const std::string& quality, const std::string& lobe = "\"flat\"") {
    return R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}, "groove_lobe": )" + lobe +
           R"(}, "quality": )" + quality + "}";
}

TEST(QualityJson, ABudgetNamesItsProbesAndItsSurface) {
    const Quality quality = parse_alone(with_quality(
                                            R"({"max_error": 0.1, "surface": "curved",
                      "probes": ["a.json", "b.hdr", {"image": "c.hdr", "mapping": "angular"}, {"image": "d.exr"}]})"))
                                .quality;
    EXPECT_EQ(quality.surface, SurfaceShape::Curved);
    EXPECT_EQ(quality.measure, ErrorMeasure::RelativeRms);
    ASSERT_EQ(quality.probes.size(), 4U);
    EXPECT_EQ(quality.probes[0].file, "a.json");
    EXPECT_EQ(quality.probes[1].mapping, lighting::Mapping::Equirectangular);
    EXPECT_EQ(quality.probes[2].mapping, lighting::Mapping::Angular);
    EXPECT_EQ(quality.probes[3].file, "d.exr");
}

TEST(QualityJson, ABudgetNamesWhatItsErrorIs) {
    const auto parsed = [](const std::string& quality) { return parse_alone(with_quality(quality)).quality; };
    EXPECT_EQ(parsed(R"({"measure": "hdr_flip"})").measure, ErrorMeasure::HdrFlip);
    EXPECT_EQ(parsed(R"({"measure": "hdr_flip"})").max_error, 0.05);
    EXPECT_EQ(parsed(R"({"measure": "delta_e"})").measure, ErrorMeasure::DeltaE);
    EXPECT_EQ(parsed(R"({"measure": "delta_e"})").max_error, 3.0);
    EXPECT_EQ(parsed(R"({"measure": "delta_e", "max_error": 1.5})").max_error, 1.5);
}

TEST(QualityJson, EveryRepresentationTakesItsSettings) {
    const auto pinned = [](const std::string& quality) { return representation(parse_alone(with_quality(quality))); };
    EXPECT_EQ(std::get<ArcSettings>(pinned(R"({"representation": "arc"})")).grid, default_view_grid(Grating{}));
    const auto arc = std::get<ArcSettings>(
        pinned(R"({"representation": "arc", "bands": 7, "rank": 12, "view_resolution": 99, "storage": "unorm8"})"));
    EXPECT_EQ(arc.storage, Storage::Unorm8);
    EXPECT_EQ(arc.bands, 7);
    EXPECT_EQ(arc.rank, 12);
    EXPECT_EQ(arc.grid, (ViewGrid{.mapping = ViewMapping::OneDimensional, .columns = 99, .rows = 1}));
    const auto planar =
        std::get<PlanarSettings>(pinned(R"({"representation": "planar", "rank": 6, "map_resolution": 63})"));
    EXPECT_EQ(planar.stand_in.rank, 6);
    EXPECT_EQ(planar.size.views, 63);
    EXPECT_EQ(planar.size.azimuths, 126);
    const auto circle = std::get<CircleSettings>(pinned(R"({"representation": "circle", "map_resolution": 31})"));
    EXPECT_EQ(circle.size.side, 31);
    EXPECT_EQ(circle.size.views, 62);
    EXPECT_TRUE(std::holds_alternative<DirectSettings>(pinned(R"({"representation": "direct"})")));
    const auto spikes = std::get<SpikeTableSettings>(
        pinned(R"({"representation": "spikes", "view_mapping": "one-dimensional", "view_resolution": 100})"));
    EXPECT_EQ(spikes.grid.mapping, ViewMapping::OneDimensional);
    EXPECT_EQ(spikes.grid.columns, 100);
    EXPECT_EQ(spikes.grid.rows, 1);
}

TEST(QualityJson, KeyLightsAreApartWhereNothingElseWouldAddThem) {
    const auto apart = [](const std::string& quality) { return parse_alone(with_quality(quality)).quality.key_lights; };
    constexpr int kAll = lighting::kMaximumKeyLights;
    EXPECT_EQ(apart(R"({"representation": "spikes"})"), 0);
    EXPECT_EQ(apart(R"({"representation": "spikes", "key_lights": 64})"), kAll);
    EXPECT_EQ(apart(R"({"representation": "arc"})"), kAll);
    EXPECT_EQ(apart(R"({"representation": "arc", "key_lights": 0})"), 0);
    EXPECT_EQ(apart(R"({"representation": "circle"})"), kAll);
    EXPECT_EQ(apart(R"({"representation": "circle", "key_lights": 8})"), 8);
    EXPECT_EQ(apart(R"({"representation": "spikes", "key_lights": true})"), kAll);
    EXPECT_EQ(apart(R"({"representation": "arc", "key_lights": false})"), 0);
}

TEST(QualityJson, LightsOfTheirOwnAreAtThePixelsUnlessTold) {
    const auto at_vertices = [](const std::string& quality) {
        return parse_alone(with_quality(quality)).quality.lights_at_vertices;
    };
    EXPECT_FALSE(at_vertices(R"({"representation": "arc"})"));
    EXPECT_TRUE(at_vertices(R"({"representation": "arc", "lights_at": "vertices"})"));
    EXPECT_TRUE(at_vertices(R"({"representation": "planar", "key_lights": 0, "lights_at": "vertices"})"));
}

TEST(QualityJson, MapsAreLookedUpAtThePixelsUnlessTold) {
    const auto parsed = [](const std::string& quality) { return parse_alone(with_quality(quality)).quality; };
    EXPECT_FALSE(parsed(R"({"representation": "planar"})").map_at_vertices);
    const Quality quality = parsed(R"({"representation": "circle", "map_at": "vertices"})");
    EXPECT_TRUE(quality.map_at_vertices);
    EXPECT_FALSE(quality.lights_at_vertices);
}

/// The member is named, and where it helps what is allowed.
TEST(QualityJson, WhatDoesNotSuitIsRefusedByItsPointer) {
    const std::string flat = "\"flat\"";
    const std::string sigma = R"({"sigma": 0.2})";
    const struct {
        const char* quality;
        std::string lobe;
        std::vector<const char*> told;
    } rows[] = {
        {R"("probes": [])", flat, {"/quality/probes"}},
        {R"("probes": ["a", 3])", flat, {"/quality/probes/1"}},
        {R"("probes": [{"image": "a.hdr", "file": "b"}])", flat, {"/quality/probes/0/file"}},
        {R"("representation": "direct", "probes": ["a.json"])", flat, {"probes"}},
        {R"("measure": "flip")", flat, {"hdr_flip"}},
        {R"("representation": "direct", "measure": "hdr_flip")", flat, {"measure"}},
        {R"("representation": "direct", "key_lights": false)", flat, {"/quality/key_lights"}},
        {R"("representation": "direct", "key_lights": false)", flat, {"/quality/key_lights"}},
        {R"("representation": "arc", "key_lights": 65)", flat, {"/quality/key_lights"}},
        {R"("representation": "spikes", "lights_at": "vertices")", flat, {"/quality/lights_at"}},
        {R"("representation": "arc", "map_at": "vertices")", flat, {"/quality/map_at"}},
        {R"("representation": "arc", "spikes": 4)", flat, {"/quality/spikes"}},
        {R"("representation": "arc", "rnak": 4)", flat, {"/quality/rnak", "rank"}},
        {R"("representation": "arc", "rank": 17)", flat, {"/quality/rank"}},
        {R"("representation": "arc", "view_mapping": "parabolic")", flat, {"/quality/view_mapping"}},
        {R"("representation": "spikes", "bands": 16, "spikes": 64)", flat, {"/quality/spikes", "2048"}},
        {R"("representation": "plannar")", flat, {"\"planar\""}},
        {R"("representation": "transfer")", flat, {"/quality/representation", "spikes, arc"}},
        {R"("representation": "circle", "angles": 25)", flat, {"/quality/angles"}},
        {R"("representation": "planar", "views_h": 64)", flat, {"/quality/views_h"}},
        {R"("representation": "streak")", flat, {"/quality/representation"}},
        {R"("representation": "streak")",
         R"({"pits": {"length_nm": 850, "coherent": 0}})",
         {"/quality/representation"}},
        {R"("representation": "circle")", sigma, {"/quality/representation"}},
        {R"("representation": "spikes", "view_mapping": "one-dimensional")", sigma, {"/quality/view_mapping"}},
        {R"("representation": "planar", "map_resolution": 257)", sigma, {"/quality/map_resolution"}},
        {R"("representation": "streak", "map_resolution": 513)", sigma, {"/quality/map_resolution"}},
        {R"("representation": "streak", "nodes": 5)", sigma, {"/quality/nodes", "\"map_resolution\""}},
        {R"("representation": "streak", "taps": 5)", sigma, {"/quality/taps", "\"map_resolution\""}},
    };
    for (const auto& row : rows) {
        const std::string message = refusal(with_quality(fmt::format("{{{}}}", row.quality), row.lobe));
        for (const char* told : row.told) EXPECT_THAT(message, HasSubstr(told)) << row.quality;
    }
    EXPECT_NO_THROW(parse_alone(with_quality(R"({"representation": "arc"})", sigma)));
    EXPECT_NO_THROW(parse_alone(with_quality(R"({"representation": "planar", "views_h": 64})", sigma)));
}

TEST(QualityJson, CirclesTakeAnglesOfTheNormal) {
    const auto angles = [](const std::string& given) {
        const Material material = parse_alone(with_quality(R"({"representation": "circle")" + given + "}"));
        return std::get<CircleSettings>(representation(material)).size.angles;
    };
    EXPECT_EQ(angles(""), 14);
    EXPECT_EQ(angles(R"(, "angles": 0)"), 0);
    EXPECT_EQ(angles(R"(, "angles": 20)"), 20);
}

TEST(QualityJson, StreaksTakeTheirSettings) {
    const auto settings = [](const std::string& quality, const std::string& lobe) {
        return std::get<StreakSurfaceSettings>(representation(parse_alone(with_quality(quality, lobe))));
    };
    const auto narrow = settings(R"({"representation": "streak"})", R"({"sigma": 0.05})");
    EXPECT_EQ(narrow.streak.map_resolution, 320);
    EXPECT_FALSE(narrow.incoherent.has_value());
    const auto pits =
        settings(R"({"representation": "streak", "map_resolution": 128, "bands": 7, "rank": 11, "illuminant": "A"})",
                 R"({"pits": {"length_nm": 850, "coherent": 0.3}})");
    EXPECT_EQ(pits.streak.map_resolution, 128);
    EXPECT_EQ(pits.streak.illuminant.name, "A");
    ASSERT_TRUE(pits.incoherent.has_value());
    EXPECT_EQ(pits.incoherent->bands, 7);
    EXPECT_EQ(pits.incoherent->rank, 11);
    EXPECT_EQ(pits.incoherent->illuminant.name, "A");
}

const nlohmann::json kMaterial = {
    {"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}}};

TEST(Method, TextReadsBackAsItself) {
    for (const char* text : {"direct", "arc/bands=5/rank=8", "spikes/bands=5/view_mapping=parabolic/window=hann",
                             "planar/map_resolution=128/key_lights=16"}) {
        EXPECT_EQ(method_name(parse_method(text)), text);
    }
}

TEST(Method, BadTextIsRefusedByName) {
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/bands"); }), HasSubstr("\"bands\""));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/=3"); }), HasSubstr("name=value"));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/key_lights=65"); }), HasSubstr("[0, 64]"));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/key_lights=many"); }), HasSubstr("many"));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/window=box"); }), HasSubstr("lanczos"));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/bands=5/bands=6"); }), HasSubstr("bands twice"));
}

TEST(Method, CooksTheMaterialAsItSays) {
    const auto arc = cook(kMaterial, "cd.json", parse_method("arc/bands=3/rank=4"));
    const auto& table = std::get<ArcTable>(arc.tables);
    EXPECT_EQ(table.bands, 3);
    EXPECT_EQ(table.rank, 4);
    EXPECT_EQ(arc.material.quality.key_lights, 0);
    EXPECT_EQ(cook(kMaterial, "cd.json", parse_method("arc/bands=3/key_lights=4")).material.quality.key_lights, 4);
    EXPECT_EQ(cook(kMaterial, "cd.json", parse_method("planar/map_resolution=16")).material.quality.key_lights, 0)
        << "a map without key lights holds the whole probe";
}

TEST(Method, TakesWhatItDoesNotNameFromAMaterialThatPinsTheSameRepresentation) {
    nlohmann::json pinned = kMaterial;
    pinned["quality"] = {{"representation", "arc"}, {"bands", 3}, {"rank", 5}};
    const auto rank = [&](const char* text) {
        return std::get<ArcSettings>(*cook(pinned, "cd.json", parse_method(text)).material.quality.pinned).rank;
    };
    EXPECT_EQ(rank("arc"), 5);
    EXPECT_EQ(rank("arc/rank=4"), 4);
    const auto other = cook(pinned, "cd.json", parse_method("spikes")).material.quality.pinned;
    EXPECT_EQ(std::get<SpikeTableSettings>(*other).spikes.bands, SpikeSettings().bands);
}

TEST(Method, WhatAMaterialFileRefusesIsRefused) {
    EXPECT_THAT(rowland::test::message_of([] { cook(kMaterial, "cd.json", parse_method("arc/band=3")); }),
                HasSubstr("bands"));
    EXPECT_THAT(rowland::test::message_of([] { cook(kMaterial, "cd.json", parse_method("arcs")); }), HasSubstr("arc"));
}

}  // namespace
}  // namespace rowland::diffraction
