#include "editor/trade/setting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/support/message_of.h"

namespace rowland::trade {
namespace {

using ::testing::HasSubstr;

const nlohmann::json kMaterial = {
    {"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}}};

TEST(Setting, TextReadsBackAsItself) {
    for (const char* text : {"direct", "arc/bands=5/rank=8", "spikes/bands=5/view_mapping=parabolic/window=hann",
                             "planar/map_resolution=128/key_lights=16"}) {
        const Setting setting = parse_setting(text);
        EXPECT_EQ(setting_name(setting), text);
        EXPECT_EQ(setting_from_json(to_json(setting), "s.json"), setting) << text;
    }
}

TEST(Setting, NamesOfDifferentSettingsDiffer) {
    EXPECT_NE(setting_name(parse_setting("arc/bands=5")), setting_name(parse_setting("arc/bands=5/key_lights=4")));
    EXPECT_NE(setting_name(parse_setting("arc")), setting_name(parse_setting("arc/window=lanczos")));
}

TEST(Setting, BadTextIsRefusedByName) {
    EXPECT_THAT(test::message_of([] { parse_setting("arc/bands"); }), HasSubstr("\"bands\""));
    EXPECT_THAT(test::message_of([] { parse_setting("arc/=3"); }), HasSubstr("name=value"));
    EXPECT_THAT(test::message_of([] { parse_setting("arc/key_lights=65"); }), HasSubstr("0 to 64"));
    EXPECT_THAT(test::message_of([] { parse_setting("arc/key_lights=many"); }), HasSubstr("many"));
    EXPECT_THAT(test::message_of([] { parse_setting("arc/window=box"); }), HasSubstr("lanczos"));
    EXPECT_THAT(test::message_of([] {
                    setting_from_json({{"quality", nlohmann::json::object()}}, "s.json");
                }),
                HasSubstr("s.json"));
}

TEST(Setting, CooksTheMaterialAsItSays) {
    const auto arc = cook(kMaterial, "cd.json", parse_setting("arc/bands=3/rank=4"));
    const auto& table = std::get<diffraction::ArcTable>(arc.tables);
    EXPECT_EQ(table.bands, 3);
    EXPECT_EQ(table.rank, 4);
    EXPECT_FALSE(arc.material.quality.key_lights);
    EXPECT_TRUE(cook(kMaterial, "cd.json", parse_setting("arc/bands=3/key_lights=4")).material.quality.key_lights);
    EXPECT_TRUE(cook(kMaterial, "cd.json", parse_setting("planar/map_resolution=16")).material.quality.key_lights)
        << "maps are of what key lights leave";
}

TEST(Setting, WhatAMaterialFileRefusesIsRefused) {
    EXPECT_THAT(test::message_of([] { cook(kMaterial, "cd.json", parse_setting("arc/band=3")); }), HasSubstr("bands"));
    EXPECT_THAT(test::message_of([] { cook(kMaterial, "cd.json", parse_setting("arcs")); }), HasSubstr("arc"));
}

}  // namespace
}  // namespace rowland::trade
