#include "modules/diffraction/asset/method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/support/message_of.h"

namespace rowland::diffraction {
namespace {

using ::testing::HasSubstr;

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
    EXPECT_THAT(test::message_of([] { parse_method("arc/bands"); }), HasSubstr("\"bands\""));
    EXPECT_THAT(test::message_of([] { parse_method("arc/=3"); }), HasSubstr("name=value"));
    EXPECT_THAT(test::message_of([] { parse_method("arc/key_lights=65"); }), HasSubstr("0 to 64"));
    EXPECT_THAT(test::message_of([] { parse_method("arc/key_lights=many"); }), HasSubstr("many"));
    EXPECT_THAT(test::message_of([] { parse_method("arc/window=box"); }), HasSubstr("lanczos"));
    EXPECT_THAT(test::message_of([] {
                    method_from_json({{"quality", nlohmann::json::object()}}, "s.json");
                }),
                HasSubstr("s.json"));
    EXPECT_THAT(test::message_of([] { parse_method("arc/bands=5/bands=6"); }), HasSubstr("bands twice"));
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
    EXPECT_THAT(test::message_of([] { cook(kMaterial, "cd.json", parse_method("arc/band=3")); }), HasSubstr("bands"));
    EXPECT_THAT(test::message_of([] { cook(kMaterial, "cd.json", parse_method("arcs")); }), HasSubstr("arc"));
}

}  // namespace
}  // namespace rowland::diffraction
