// The member "quality" of a material, and methods, which are written as one.
#include "modules/diffraction/asset/quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/diffraction/asset/cooked_material.h"
#include "tests/support/expect.h"

namespace rowland::diffraction {
namespace {

using ::testing::AllOf;
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
    EXPECT_THAT(refusal(with_quality(R"({"probes": []})")), HasSubstr("/quality/probes"));
    EXPECT_THAT(refusal(with_quality(R"({"probes": ["a", 3]})")), HasSubstr("/quality/probes/1"));
    EXPECT_THAT(refusal(with_quality(R"({"probes": [{"image": "a.hdr", "file": "b"}]})")),
                HasSubstr("/quality/probes/0/file"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "direct", "probes": ["a.json"]})")), HasSubstr("probes"));
}

TEST(QualityJson, ABudgetNamesWhatItsErrorIs) {
    const auto parsed = [](const std::string& quality) { return parse_alone(with_quality(quality)).quality; };
    EXPECT_EQ(parsed(R"({"measure": "hdr_flip"})").measure, ErrorMeasure::HdrFlip);
    EXPECT_EQ(parsed(R"({"measure": "hdr_flip"})").max_error, 0.05);
    EXPECT_EQ(parsed(R"({"measure": "delta_e"})").measure, ErrorMeasure::DeltaE);
    EXPECT_EQ(parsed(R"({"measure": "delta_e"})").max_error, 3.0);
    EXPECT_EQ(parsed(R"({"measure": "delta_e", "max_error": 1.5})").max_error, 1.5);
    EXPECT_THAT(refusal(with_quality(R"({"measure": "flip"})")), HasSubstr("hdr_flip"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "direct", "measure": "hdr_flip"})")), HasSubstr("measure"));
}

TEST(QualityJson, EveryRepresentationTakesItsSettings) {
    const auto pinned = [](const std::string& quality) { return representation(parse_alone(with_quality(quality))); };
    const auto transfer =
        std::get<TransferSettings>(pinned(R"({"representation": "transfer", "bands": 6, "storage": "unorm8"})"));
    EXPECT_EQ(transfer.bands, 6);
    EXPECT_EQ(transfer.grid, default_view_grid(Grating{}));
    EXPECT_EQ(transfer.storage, Storage::Unorm8);
    const auto arc =
        std::get<ArcSettings>(pinned(R"({"representation": "arc", "bands": 7, "rank": 12, "view_resolution": 99})"));
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
    EXPECT_EQ(spikes.mapping, ViewMapping::OneDimensional);
    EXPECT_EQ(spikes.phi_nodes, 100);
    EXPECT_EQ(spikes.theta_nodes, 1);
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
    for (const char* out :
         {R"("direct", "key_lights": 0)", R"("direct", "key_lights": false)", R"("arc", "key_lights": 65)"})
        EXPECT_THAT(refusal(with_quality(std::string(R"({"representation": )") + out + "}")),
                    HasSubstr("/quality/key_lights"));
}

TEST(QualityJson, LightsOfTheirOwnAreAtThePixelsUnlessTold) {
    const auto at_vertices = [](const std::string& quality) {
        return parse_alone(with_quality(quality)).quality.lights_at_vertices;
    };
    EXPECT_FALSE(at_vertices(R"({"representation": "arc"})"));
    EXPECT_TRUE(at_vertices(R"({"representation": "arc", "lights_at": "vertices"})"));
    EXPECT_TRUE(at_vertices(R"({"representation": "planar", "key_lights": 0, "lights_at": "vertices"})"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "spikes", "lights_at": "vertices"})")),
                HasSubstr("/quality/lights_at"));  // it has none
}

TEST(QualityJson, MapsAreLookedUpAtThePixelsUnlessTold) {
    const auto parsed = [](const std::string& quality) { return parse_alone(with_quality(quality)).quality; };
    EXPECT_FALSE(parsed(R"({"representation": "planar"})").map_at_vertices);
    const Quality quality = parsed(R"({"representation": "circle", "map_at": "vertices"})");
    EXPECT_TRUE(quality.map_at_vertices);
    EXPECT_FALSE(quality.lights_at_vertices);
    EXPECT_THAT(refusal(with_quality(R"({"representation": "arc", "map_at": "vertices"})")),
                HasSubstr("/quality/map_at"));  // it has none
}

TEST(QualityJson, SettingsThatARepresentationDoesNotHaveAreRefusedByName) {
    EXPECT_THAT(refusal(with_quality(R"({"representation": "arc", "spikes": 4})")), HasSubstr("/quality/spikes"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "arc", "rnak": 4})")),
                AllOf(HasSubstr("/quality/rnak"), HasSubstr("rank")));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "arc", "rank": 17})")), HasSubstr("/quality/rank"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "arc", "view_mapping": "parabolic"})")),
                HasSubstr("/quality/view_mapping"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "spikes", "bands": 16, "spikes": 64})")),
                AllOf(HasSubstr("/quality/spikes"), HasSubstr("2048")));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "plannar"})")), HasSubstr("\"planar\""));
}

TEST(QualityJson, LobesThatARepresentationCannotShadeAreRefused) {
    const std::string sigma = R"({"sigma": 0.2})";
    EXPECT_THAT(refusal(with_quality(R"({"representation": "circle"})", sigma)), HasSubstr("/quality/representation"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "spikes", "view_mapping": "one-dimensional"})", sigma)),
                HasSubstr("/quality/view_mapping"));
    EXPECT_NO_THROW(parse_alone(with_quality(R"({"representation": "arc"})", sigma)));
    EXPECT_NO_THROW(parse_alone(with_quality(R"({"representation": "planar", "views_h": 64})", sigma)));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "planar", "views_h": 64})")), HasSubstr("/quality/views_h"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "planar", "map_resolution": 257})", sigma)),
                HasSubstr("/quality/map_resolution"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "streak"})")), HasSubstr("/quality/representation"));
    EXPECT_THAT(
        refusal(with_quality(R"({"representation": "streak"})", R"({"pits": {"length_nm": 850, "coherent": 0}})")),
        HasSubstr("/quality/representation"));
}

TEST(QualityJson, CirclesTakeAnglesOfTheNormal) {
    const auto angles = [](const std::string& given) {
        const Material material = parse_alone(with_quality(R"({"representation": "circle")" + given + "}"));
        return std::get<CircleSettings>(representation(material)).size.angles;
    };
    EXPECT_EQ(angles(""), 14);
    EXPECT_EQ(angles(R"(, "angles": 0)"), 0);
    EXPECT_EQ(angles(R"(, "angles": 20)"), 20);
    EXPECT_THAT(refusal(with_quality(R"({"representation": "circle", "angles": 25})")), HasSubstr("/quality/angles"));
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
    EXPECT_THAT(refusal(with_quality(R"({"representation": "streak", "map_resolution": 513})", R"({"sigma": 0.05})")),
                HasSubstr("/quality/map_resolution"));
    for (const std::string old : {"nodes", "taps"})
        EXPECT_THAT(refusal(with_quality(R"({"representation": "streak", ")" + old + "\": 5}", R"({"sigma": 0.05})")),
                    AllOf(HasSubstr("/quality/" + old), HasSubstr("\"map_resolution\"")));
}

const nlohmann::json kMaterial = {
    {"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}}};

TEST(Method, TextReadsBackAsItself) {
    for (const char* text : {"direct", "arc/bands=5/rank=8", "spikes/bands=5/view_mapping=parabolic/window=hann",
                             "planar/map_resolution=128/key_lights=16"}) {
        const Method method = parse_method(text);
        EXPECT_EQ(method_name(method), text);
        EXPECT_EQ(method_from_json(to_json(method), "s.json"), method) << text;
    }
}

TEST(Method, NamesOfDifferentMethodsDiffer) {
    EXPECT_NE(method_name(parse_method("arc/bands=5")), method_name(parse_method("arc/bands=5/key_lights=4")));
    EXPECT_NE(method_name(parse_method("arc")), method_name(parse_method("arc/window=lanczos")));
}

TEST(Method, BadTextIsRefusedByName) {
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/bands"); }), HasSubstr("\"bands\""));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/=3"); }), HasSubstr("name=value"));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/key_lights=65"); }), HasSubstr("[0, 64]"));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/key_lights=many"); }), HasSubstr("many"));
    EXPECT_THAT(rowland::test::message_of([] { parse_method("arc/window=box"); }), HasSubstr("lanczos"));
    EXPECT_THAT(rowland::test::message_of([] {
                    method_from_json({{"quality", nlohmann::json::object()}}, "s.json");
                }),
                HasSubstr("s.json"));
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
    const auto other = cook(pinned, "cd.json", parse_method("transfer")).material.quality.pinned;
    EXPECT_EQ(std::get<TransferSettings>(*other).bands, TransferSettings().bands);
}

TEST(Method, WhatAMaterialFileRefusesIsRefused) {
    EXPECT_THAT(rowland::test::message_of([] { cook(kMaterial, "cd.json", parse_method("arc/band=3")); }),
                HasSubstr("bands"));
    EXPECT_THAT(rowland::test::message_of([] { cook(kMaterial, "cd.json", parse_method("arcs")); }), HasSubstr("arc"));
}

}  // namespace
}  // namespace rowland::diffraction
