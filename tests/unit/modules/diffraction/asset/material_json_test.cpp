#include "modules/diffraction/asset/material_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace rowland::diffraction {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Material parse(const std::string& text) {
    return parse_material(parse_json(text, "m.json"), "m.json");
}

std::string refusal(const std::string& text) {
    return rowland::test::message_of([&] { parse(text); });
}

std::string grating(const std::string& more) {
    return R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800})" + more + "}}";
}

TEST(MaterialJson, OnlyPitchAndProfileAreRequired) {
    const Material material = parse(grating(""));
    EXPECT_EQ(material.grating.pitch_nm, 1600.0);
    EXPECT_EQ(std::get<SlitProfile>(material.grating.profile).width_nm, 800.0);
    EXPECT_EQ(material.grating.grooves, 1500.0);
    EXPECT_THAT(material.grating.orders, ElementsAre(-2, -1, 1, 2));
    EXPECT_EQ(material.grating.normalization, Normalization::Energy);
    EXPECT_TRUE(is_flat(material.grating.lobe));
    EXPECT_FALSE(material.grating.metal.has_value());
    EXPECT_EQ(material.base.colour, glm::vec3(0.0F));
    EXPECT_EQ(material.quality.max_error, 0.05);
    EXPECT_FALSE(material.quality.pinned.has_value());
}

TEST(MaterialJson, EveryFieldReachesTheMaterial) {
    const Material material = parse(R"({
        "grating": { "pitch_nm": 740, "grooves": 900, "profile": { "type": "lamellar", "duty": 0.43, "depth_nm": 100 },
                     "orders": [1, -1, 0], "normalization": "energy", "groove_lobe": { "sigma": 0.2 } },
        "metal": "Au", "base": { "color": [0.1, 0.2, 0.3], "roughness": 0.7 },
        "quality": { "max_error": 0.1, "representation": "spikes", "bands": 8, "spikes": 16, "view_mapping": "spherical",
                     "view_resolution": 48, "storage": "fp16" } })");
    EXPECT_EQ(std::get<LamellarProfile>(material.grating.profile).duty, 0.43);
    EXPECT_EQ(std::get<LamellarProfile>(material.grating.profile).depth_nm, 100.0);
    EXPECT_EQ(material.grating.grooves, 900.0);
    EXPECT_THAT(material.grating.orders, ElementsAre(-1, 0, 1));
    EXPECT_EQ(std::get<GaussianLobe>(material.grating.lobe).sigma, 0.2);
    EXPECT_EQ(material.grating.metal, colour::Metal::Au);
    EXPECT_EQ(material.base.colour, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(material.base.roughness, 0.7F);
    EXPECT_EQ(material.quality.max_error, 0.1);
    const auto settings = std::get<SpikeTableSettings>(representation(material));
    EXPECT_EQ(settings.spikes.bands, 8);
    EXPECT_EQ(settings.spikes.spikes, 16);
    EXPECT_EQ(settings.theta_nodes, 48);
    EXPECT_EQ(settings.phi_nodes, 96);
    EXPECT_EQ(settings.storage, Storage::Half);
}

TEST(MaterialJson, ASheetTransmitsInAirWithoutMetal) {
    const std::string sheet =
        R"({"grating": {"pitch_nm": 2000, "profile": {"type": "lamellar", "duty": 0.5, "depth_nm": 550}},
                                  "transmission": )";
    ASSERT_TRUE(parse(sheet + R"({"ior": 1.46}})").grating.transmission);
    EXPECT_EQ(parse(sheet + R"({"ior": 1.46}})").grating.transmission->ior, 1.46);
    EXPECT_EQ(parse(sheet + R"({"ior": 1.5, "reflectance": 0.25}})").grating.transmission->reflectance, 0.25);
    EXPECT_THAT(refusal(sheet + R"({"ior": 1.5, "reflectance": 1.5}})"), HasSubstr("/transmission/reflectance"));
    EXPECT_THAT(refusal(sheet + "{}}"), HasSubstr("/transmission"));
    EXPECT_THAT(refusal(sheet + R"({"ior": 0.9}})"), HasSubstr("/transmission/ior"));
    EXPECT_THAT(refusal(sheet + R"({"ior": 3.1}})"), HasSubstr("/transmission/ior"));
    EXPECT_THAT(refusal(sheet + R"({"ior": 1.5, "tint": 1}})"), HasSubstr("tint"));
    EXPECT_THAT(refusal(sheet + R"({"ior": 1.5}, "metal": "Al"})"), HasSubstr("a metal beside a transmission"));
    EXPECT_THAT(refusal(sheet + R"({"ior": 1.5}, "cover": {"ior": 1.4}})"), HasSubstr("a cover beside a transmission"));
}

std::string with_quality(const std::string& quality, const std::string& lobe = "\"flat\"") {
    return R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}, "groove_lobe": )" + lobe +
           R"(}, "quality": )" + quality + "}";
}

TEST(MaterialJson, ABudgetNamesItsProbesAndItsSurface) {
    const Quality quality = parse(with_quality(
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

TEST(MaterialJson, ABudgetNamesWhatItsErrorIs) {
    const auto parsed = [](const std::string& quality) { return parse(with_quality(quality)).quality; };
    EXPECT_EQ(parsed(R"({"measure": "hdr_flip"})").measure, ErrorMeasure::HdrFlip);
    EXPECT_EQ(parsed(R"({"measure": "hdr_flip"})").max_error, 0.05);
    EXPECT_EQ(parsed(R"({"measure": "delta_e"})").measure, ErrorMeasure::DeltaE);
    EXPECT_EQ(parsed(R"({"measure": "delta_e"})").max_error, 3.0);
    EXPECT_EQ(parsed(R"({"measure": "delta_e", "max_error": 1.5})").max_error, 1.5);
    EXPECT_THAT(refusal(with_quality(R"({"measure": "flip"})")), HasSubstr("hdr_flip"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "direct", "measure": "hdr_flip"})")), HasSubstr("measure"));
}

TEST(MaterialJson, EveryRepresentationTakesItsSettings) {
    const auto pinned = [](const std::string& quality) { return representation(parse(with_quality(quality))); };
    const auto bins =
        std::get<BinSettings>(pinned(R"({"representation": "bins", "bands": 4, "bins": 9, "view_mapping": "parabolic",
                   "view_resolution": 20, "storage": "fp32"})"));
    EXPECT_EQ(bins.bands, 4);
    EXPECT_EQ(bins.bins, 9);
    EXPECT_EQ(bins.grid, (ViewGrid{.mapping = ViewMapping::Parabolic, .columns = 20, .rows = 20}));
    EXPECT_EQ(bins.storage, Storage::Float);
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

TEST(MaterialJson, KeyLightsAreApartWhereNothingElseWouldAddThem) {
    const auto apart = [](const std::string& quality) { return parse(with_quality(quality)).quality.key_lights; };
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

TEST(MaterialJson, LightsOfTheirOwnAreAtThePixelsUnlessTold) {
    const auto at_vertices = [](const std::string& quality) {
        return parse(with_quality(quality)).quality.lights_at_vertices;
    };
    EXPECT_FALSE(at_vertices(R"({"representation": "arc"})"));
    EXPECT_TRUE(at_vertices(R"({"representation": "arc", "lights_at": "vertices"})"));
    EXPECT_TRUE(at_vertices(R"({"representation": "planar", "key_lights": 0, "lights_at": "vertices"})"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "spikes", "lights_at": "vertices"})")),
                HasSubstr("/quality/lights_at"));  // it has none
}

TEST(MaterialJson, MapsAreLookedUpAtThePixelsUnlessTold) {
    const auto parsed = [](const std::string& quality) { return parse(with_quality(quality)).quality; };
    EXPECT_FALSE(parsed(R"({"representation": "planar"})").map_at_vertices);
    const Quality quality = parsed(R"({"representation": "circle", "map_at": "vertices"})");
    EXPECT_TRUE(quality.map_at_vertices);
    EXPECT_FALSE(quality.lights_at_vertices);
    EXPECT_THAT(refusal(with_quality(R"({"representation": "arc", "map_at": "vertices"})")),
                HasSubstr("/quality/map_at"));  // it has none
}

TEST(MaterialJson, SettingsThatARepresentationDoesNotHaveAreRefusedByName) {
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

TEST(MaterialJson, LobesThatARepresentationCannotShadeAreRefused) {
    const std::string sigma = R"({"sigma": 0.2})";
    EXPECT_THAT(refusal(with_quality(R"({"representation": "circle"})", sigma)), HasSubstr("/quality/representation"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "bins", "view_mapping": "one-dimensional"})", sigma)),
                HasSubstr("/quality/view_mapping"));
    EXPECT_NO_THROW(parse(with_quality(R"({"representation": "arc"})", sigma)));
    EXPECT_NO_THROW(parse(with_quality(R"({"representation": "planar", "views_h": 64})", sigma)));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "planar", "views_h": 64})")), HasSubstr("/quality/views_h"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "planar", "map_resolution": 257})", sigma)),
                HasSubstr("/quality/map_resolution"));
    EXPECT_THAT(refusal(with_quality(R"({"representation": "streak"})")), HasSubstr("/quality/representation"));
    EXPECT_THAT(
        refusal(with_quality(R"({"representation": "streak"})", R"({"pits": {"length_nm": 850, "coherent": 0}})")),
        HasSubstr("/quality/representation"));
}

TEST(MaterialJson, CirclesTakeAnglesOfTheNormal) {
    const auto angles = [](const std::string& given) {
        const Material material = parse(with_quality(R"({"representation": "circle")" + given + "}"));
        return std::get<CircleSettings>(representation(material)).size.angles;
    };
    EXPECT_EQ(angles(""), 14);
    EXPECT_EQ(angles(R"(, "angles": 0)"), 0);
    EXPECT_EQ(angles(R"(, "angles": 20)"), 20);
    EXPECT_THAT(refusal(with_quality(R"({"representation": "circle", "angles": 25})")), HasSubstr("/quality/angles"));
}

TEST(MaterialJson, StreaksTakeTheirSettings) {
    const auto settings = [](const std::string& quality, const std::string& lobe) {
        return std::get<StreakSurfaceSettings>(representation(parse(with_quality(quality, lobe))));
    };
    const auto narrow = settings(R"({"representation": "streak"})", R"({"sigma": 0.05})");
    EXPECT_EQ(narrow.streak.map_resolution, 320);
    EXPECT_FALSE(narrow.rest.has_value());
    const auto pits =
        settings(R"({"representation": "streak", "map_resolution": 128, "bands": 7, "rank": 11, "illuminant": "A"})",
                 R"({"pits": {"length_nm": 850, "coherent": 0.3}})");
    EXPECT_EQ(pits.streak.map_resolution, 128);
    EXPECT_EQ(pits.streak.illuminant.name, "A");
    ASSERT_TRUE(pits.rest.has_value());
    EXPECT_EQ(pits.rest->bands, 7);
    EXPECT_EQ(pits.rest->rank, 11);
    EXPECT_EQ(pits.rest->illuminant.name, "A");
    EXPECT_THAT(refusal(with_quality(R"({"representation": "streak", "map_resolution": 513})", R"({"sigma": 0.05})")),
                HasSubstr("/quality/map_resolution"));
    for (const std::string old : {"nodes", "taps"})
        EXPECT_THAT(refusal(with_quality(R"({"representation": "streak", ")" + old + "\": 5}", R"({"sigma": 0.05})")),
                    AllOf(HasSubstr("/quality/" + old), HasSubstr("\"map_resolution\"")));
}

TEST(MaterialJson, AllOrdersAreThoseThatPropagateSomewhere) {
    // d = 600 nm: |u| <= 2, so m λ <= 1200 nm: orders to ±3 at 380 nm.
    const std::string text = R"({"grating": {"pitch_nm": 600, "profile": {"type": "slit", "width_nm": 300},
                                 "orders": "all"}})";
    EXPECT_THAT(parse(text).grating.orders, ElementsAre(-3, -2, -1, 1, 2, 3));
}

TEST(MaterialJson, AnUnknownKeyNamesTheNearestValidOne) {
    EXPECT_THAT(refusal(grating(R"(, "ordres": [1])")),
                AllOf(HasSubstr("m.json"), HasSubstr("/grating/ordres"), HasSubstr("orders")));
    EXPECT_THAT(refusal(R"({"grating": {"pitch": 1600, "profile": {"type": "slit", "width_nm": 800}}})"),
                HasSubstr("pitch_nm"));
}

std::string with_profile(const std::string& profile, const std::string& pitch = "1600", const std::string& more = "") {
    return R"({"grating": {"pitch_nm": )" + pitch + R"(, "profile": )" + profile + more + "}}";
}

const std::string kSlit = R"({"type": "slit", "width_nm": 800})";

TEST(MaterialJson, PitchOutOfItsDomainIsRefused) {
    for (const char* pitch : {"0", "-1600", "0.5", "1e8", "\"1600\"", "null", "true"})
        EXPECT_THAT(refusal(with_profile(kSlit, pitch)), AllOf(HasSubstr("m.json"), HasSubstr("/grating/pitch_nm")));
    EXPECT_THAT(refusal(R"({"grating": {"profile": {"type": "slit", "width_nm": 800}}})"), HasSubstr("pitch_nm"));
}

/// JSON has no NaN and no infinity: the text itself is refused.
TEST(MaterialJson, NumbersThatAreNoneAreRefused) {
    for (const char* pitch : {"NaN", "nan", "Infinity", "-inf", "1e999"})
        EXPECT_THAT(refusal(with_profile(kSlit, pitch)), HasSubstr("m.json"));
}

TEST(MaterialJson, SlitsWiderThanTheirPitchAreRefused) {
    for (const char* width : {"1600.5", "0", "-5"})
        EXPECT_THAT(refusal(with_profile(R"({"type": "slit", "width_nm": )" + std::string(width) + "}")),
                    HasSubstr("/grating/profile/width_nm"));
    EXPECT_NO_THROW(parse(with_profile(R"({"type": "slit", "width_nm": 1600})")));
}

TEST(MaterialJson, DutiesOutsideTheirOpenIntervalAreRefused) {
    for (const char* duty : {"0", "1", "-0.2", "1.2"})
        EXPECT_THAT(refusal(with_profile(R"({"type": "lamellar", "depth_nm": 1, "duty": )" + std::string(duty) + "}")),
                    HasSubstr("/grating/profile/duty"));
}

TEST(MaterialJson, DepthsOfNothingAreRefused) {
    for (const char* type : {"sinusoidal", "blazed"})
        for (const char* depth : {"0", "-100"})
            EXPECT_THAT(refusal(with_profile(R"({"type": ")" + std::string(type) + R"(", "depth_nm": )" + depth + "}")),
                        HasSubstr("/grating/profile/depth_nm"));
}

TEST(MaterialJson, UnknownProfilesNameTheNearestOne) {
    EXPECT_THAT(refusal(with_profile(R"({"type": "slitt", "width_nm": 800})")), HasSubstr("\"slit\""));
    EXPECT_THAT(refusal(with_profile(R"({"type": "slit", "width": 800})")), HasSubstr("width_nm"));
}

TEST(MaterialJson, FewerGroovesThanOneAreRefused) {
    for (const char* grooves : {"0", "0.5", "-3"})
        EXPECT_THAT(refusal(grating(R"(, "grooves": )" + std::string(grooves))), HasSubstr("/grating/grooves"));
    EXPECT_EQ(parse(grating(R"(, "grooves": 1)")).grating.grooves, 1.0);
}

TEST(MaterialJson, OrdersThatAreNoListOfWholeNumbersAreRefused) {
    EXPECT_THAT(refusal(grating(R"(, "orders": [])")), HasSubstr("/grating/orders"));
    EXPECT_THAT(refusal(grating(R"(, "orders": "every")")), HasSubstr("\"all\""));
    EXPECT_THAT(refusal(grating(R"(, "orders": [1, 1.5])")), HasSubstr("/grating/orders/1"));
    EXPECT_THAT(refusal(grating(R"(, "orders": [1, 10001])")), HasSubstr("/grating/orders/1"));
    EXPECT_THAT(refusal(grating(R"(, "orders": [1, 1])")), HasSubstr("twice"));
}

TEST(MaterialJson, AllOrdersOfACoarseGratingAreTaken) {
    EXPECT_EQ(parse(with_profile(kSlit, "50000", R"(, "orders": "all")")).grating.orders.size(), 2U * 263U);
    EXPECT_THAT(refusal(with_profile(kSlit, "1e6", R"(, "orders": "all")")),
                AllOf(HasSubstr("/grating/orders"), HasSubstr("190000")));
}

TEST(MaterialJson, LobesOutOfTheirDomainAreRefused) {
    const auto lobe = [](const std::string& value) { return refusal(grating(R"(, "groove_lobe": )" + value)); };
    EXPECT_THAT(lobe(R"({"sigma": 0})"), HasSubstr("/grating/groove_lobe/sigma"));
    EXPECT_THAT(lobe("0.2"), AllOf(HasSubstr("/grating/groove_lobe"), HasSubstr("pits")));
    EXPECT_THAT(lobe(R"({"sigma": 0.2, "pits": {"length_nm": 850, "coherent": 0.3}})"), HasSubstr("sigma"));
    EXPECT_THAT(lobe(R"({"pits": {"length_nm": 850}})"), HasSubstr("/grating/groove_lobe/pits/coherent"));
    EXPECT_THAT(lobe(R"({"pits": {"length_nm": 0, "coherent": 0.3}})"),
                HasSubstr("/grating/groove_lobe/pits/length_nm"));
    EXPECT_THAT(lobe(R"({"pits": {"length_nm": 850, "coherent": 1.3}})"),
                HasSubstr("/grating/groove_lobe/pits/coherent"));
}

TEST(MaterialJson, PitsReachTheMaterial) {
    const Material material = parse(grating(R"(, "groove_lobe": {"pits": {"length_nm": 900, "coherent": 0.4}})"));
    EXPECT_EQ(std::get<PitsLobe>(material.grating.lobe).length_nm, 900.0);
    EXPECT_EQ(std::get<PitsLobe>(material.grating.lobe).coherent, 0.4);
}

TEST(MaterialJson, MetalsAndBasesOutOfTheirDomainAreRefused) {
    const auto beside = [](const std::string& member) {
        return refusal(R"({"grating": {"pitch_nm": 1600, "profile": )" + kSlit + "}, " + member + "}");
    };
    EXPECT_THAT(beside(R"("metal": "Fe")"), HasSubstr("/metal"));
    EXPECT_THAT(beside(R"("base": {"color": [0.1, 0.2]})"), HasSubstr("/base/color"));
    EXPECT_THAT(beside(R"("base": {"color": [0.1, 0.2, 1.1]})"), HasSubstr("/base/color/2"));
    EXPECT_THAT(beside(R"("base": {"roughness": 2})"), HasSubstr("/base/roughness"));
    EXPECT_THAT(beside(R"("quality": {"max_error": 0})"), HasSubstr("/quality/max_error"));
    EXPECT_THAT(beside(R"("quality": {"illuminant": "F12"})"),
                testing::AllOf(HasSubstr("/quality/illuminant"), HasSubstr("F11")));
    EXPECT_THAT(refusal("[]"), HasSubstr("object"));
}

/// A material with a table, whatever its name, of this text.
Material parse_with_table(const std::string& text, const std::string& table) {
    return parse_material(parse_json(text, "m.json"), "m.json",
                          [&](const std::string& name) { return NamedText{.text = table, .file = "folder/" + name}; });
}

const std::string kTable = R"({"type": "table", "file": "t.csv"})";

TEST(MaterialJson, ATableIsReadBesideTheMaterial) {
    const rowland::test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "t.csv", "wavelength_nm,R-1,R+1\n500,0.1,0.4\n");
    write_file_atomic(folder.path() / "m.json", with_profile(kTable));
    const Material material = load_material(folder.path() / "m.json");
    EXPECT_EQ(profile_efficiency(material.grating.profile, 1600.0, 1, 500.0), 0.4);
    EXPECT_EQ(profile_efficiency(material.grating.profile, 1600.0, -1, 500.0), 0.1);
    EXPECT_EQ(profile_efficiency(material.grating.profile, 1600.0, 2, 500.0), 0.0);
}

TEST(MaterialJson, ABadTableIsNamedByItsOwnFile) {
    const auto read = [&] { parse_with_table(with_profile(kTable), "wavelength_nm,R+1\n500,1.4\n"); };
    EXPECT_THAT(rowland::test::message_of(read), AllOf(HasSubstr("folder/t.csv: row 2"), HasSubstr("1.4")));
    EXPECT_THAT(refusal(with_profile(R"({"type": "table", "file": "no_such_table.csv"})")),
                HasSubstr("no_such_table.csv"));
    EXPECT_THAT(refusal(with_profile(R"({"type": "table", "file": ""})")), HasSubstr("/grating/profile/file"));
}

TEST(MaterialJson, AMetalBesideATableIsRefused) {
    const auto read = [&] {
        parse_with_table(R"({"grating": {"pitch_nm": 1600, "profile": )" + kTable + R"(}, "metal": "Al"})",
                         "wavelength_nm,R+1\n500,0.4\n");
    };
    EXPECT_THAT(rowland::test::message_of(read), AllOf(HasSubstr("m.json: /metal"), HasSubstr("already")));
}

TEST(MaterialJson, ACoverIsReadAndRefusedOutOfItsDomain) {
    const auto beside = [](const std::string& cover) {
        return R"({"grating": {"pitch_nm": 1600, "profile": )" + kSlit + R"(}, "cover": )" + cover + "}";
    };
    EXPECT_FALSE(parse(grating("")).grating.cover.has_value());
    const Cover clear = parse(beside(R"({"ior": 1.58})")).grating.cover.value();
    EXPECT_EQ(clear.ior, 1.58);
    EXPECT_EQ(clear.tint, glm::dvec3(1.0));
    EXPECT_EQ(parse(beside(R"({"ior": 1, "tint": [0, 0.5, 1]})")).grating.cover->tint, glm::dvec3(0.0, 0.5, 1.0));
    EXPECT_THAT(refusal(beside("1.5")), HasSubstr("/cover"));
    EXPECT_THAT(refusal(beside("{}")), HasSubstr("/cover/ior"));
    EXPECT_THAT(refusal(beside(R"({"ior": 0.99})")), AllOf(HasSubstr("/cover/ior"), HasSubstr("[1, 3]")));
    EXPECT_THAT(refusal(beside(R"({"ior": 3.1})")), HasSubstr("/cover/ior"));
    EXPECT_THAT(refusal(beside(R"({"ior": 1.5, "tint": [1, 1]})")), HasSubstr("/cover/tint"));
    EXPECT_THAT(refusal(beside(R"({"ior": 1.5, "tint": [1, 1, 1.2]})")), HasSubstr("/cover/tint/2"));
    EXPECT_THAT(refusal(beside(R"({"ior": 1.5, "tnt": [1, 1, 1]})")), AllOf(HasSubstr("tnt"), HasSubstr("tint")));
}

TEST(MaterialJson, ATableTakesACoverButNoTint) {
    const auto read = [&](const std::string& cover) {
        return parse_with_table(
            R"({"grating": {"pitch_nm": 1600, "profile": )" + kTable + R"(}, "cover": )" + cover + "}",
            "wavelength_nm,R+1\n500,0.4\n");
    };
    EXPECT_EQ(read(R"({"ior": 1.5})").grating.cover->ior, 1.5);
    const auto tinted = [&] { read(R"({"ior": 1.5, "tint": [1, 1, 0]})"); };
    EXPECT_THAT(rowland::test::message_of(tinted), AllOf(HasSubstr("m.json: /cover/tint"), HasSubstr("already")));
}

TEST(MaterialJson, FewGroovesNeedAGrooveAndOneLobeForAllWavelengths) {
    const auto read = [&] {
        parse_with_table(with_profile(kTable, "1600", R"(, "grooves": 49)"), "wavelength_nm,R+1\n500,0.4\n");
    };
    EXPECT_THAT(rowland::test::message_of(read), AllOf(HasSubstr("/grating/grooves"), HasSubstr("table")));
    EXPECT_THAT(refusal(grating(R"(, "grooves": 7, "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}})")),
                AllOf(HasSubstr("/grating/grooves"), HasSubstr("pits")));
}

TEST(MaterialJson, AguNormalisationIsForTheSlitOnly) {
    EXPECT_EQ(parse(grating(R"(, "normalization": "agu")")).grating.normalization, Normalization::Agu);
    EXPECT_THAT(refusal(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "sinusoidal", "depth_nm": 100},
                            "normalization": "agu"}})"),
                HasSubstr("slit"));
}

}  // namespace
}  // namespace rowland::diffraction
