#include "modules/diffraction/asset/material_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/modules/diffraction/asset/material_text.h"

namespace rowland::diffraction {
namespace {

using test::grating;
using test::parse;
using test::refusal;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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