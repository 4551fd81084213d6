#include "editor/inspector/field.h"

#include <gmock/gmock.h>

#include <set>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "modules/diffraction/asset/material_json.h"
#include "tests/support/source_tree.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

Json cd() {
    return Json::parse(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})");
}

diffraction::Material parse(const Json& material) {
    return diffraction::parse_material(nlohmann::json::parse(material.dump()), "m.json");
}

/// A material for which the field means something.
Json suited_to(const Field& field) {
    Json material = cd();
    if (field.pointer == "/quality/representation" || field.only_with.empty()) return material;
    const Field& other = field_at(field.only_with);
    material = with_choice(material, other, field.only_for.front());
    if (field.only_for.front() == "streak") material["grating"]["groove_lobe"] = {{"sigma", 0.1}};
    return material;
}

TEST(Fields, EveryOneHasItsUnitRangeHelpAndSource) {
    std::set<std::string> pointers;
    for (const Field& field : fields()) {
        EXPECT_TRUE(pointers.insert(field.pointer).second) << field.pointer;
        EXPECT_FALSE(field.label.empty()) << field.pointer;
        EXPECT_GT(field.help.size(), 20U) << field.pointer;
        EXPECT_FALSE(field.source.empty()) << field.pointer;
        EXPECT_LT(field.minimum, field.maximum) << field.pointer;
        EXPECT_EQ(field.pointer.ends_with("_nm"), field.unit == "nm") << field.pointer;
    }
}

// The schema lists what a material may hold; whoever adds a member there must tell the inspector of it.
TEST(Fields, EveryMemberOfTheSchemaHasAField) {
    const Json schema =
        Json::parse(read_text_file(test::source_path("modules/diffraction/asset/material.schema.json"), 1 << 20));
    for (const auto& [name, part] : schema["$defs"]["grating"]["properties"].items())
        EXPECT_NE(field_of_refusal("/grating/" + name), nullptr) << name;
    for (const char* name : {"metal", "quality"}) EXPECT_NE(field_of_refusal(std::string("/") + name), nullptr) << name;
    EXPECT_EQ(schema["properties"].size(), 5U);  // those, the grating, the cover and the base
    for (const std::string of : {"base", "cover"})
        for (const auto& [name, part] : schema["$defs"][of]["properties"].items())
            EXPECT_EQ(field_of_refusal("/" + of + "/" + name)->pointer, "/" + of + "/" + name);
}

TEST(Fields, BothEndsOfEverySliderAreSaneMaterials) {
    int checked = 0;
    for (const Field& field : fields()) {
        if (field.kind != FieldKind::Number && field.kind != FieldKind::Count) continue;
        for (const double end : {field.minimum, field.maximum}) {
            Json material = suited_to(field);
            if (field.pointer == "/grating/profile/width_nm") material["grating"]["pitch_nm"] = end;
            if (field.pointer == "/grating/pitch_nm") material["grating"]["profile"]["width_nm"] = end / 2.0;
            if (field.pointer == "/quality/map_resolution" && end < 8.0) continue;  // the parser's is 8
            const Json value = field.kind == FieldKind::Count ? Json(static_cast<int>(end)) : Json(end);
            EXPECT_NO_THROW(parse(with_value(material, field, value))) << field.pointer << " " << end;
            ++checked;
        }
    }
    EXPECT_GT(checked, 25);
}

TEST(Fields, EveryChoiceIsASaneMaterial) {
    int checked = 0;
    for (const Field& field : fields()) {
        for (const Choice& choice : field.choices) {
            if (choice.name == "table") continue;  // needs a file
            Json material = suited_to(field);
            if (choice.name == "streak") material["grating"]["groove_lobe"] = {{"sigma", 0.1}};
            const Json chosen = with_choice(material, field, choice.name);
            EXPECT_NO_THROW(parse(chosen)) << field.pointer << " " << choice.name;
            EXPECT_EQ(choice_of(field, chosen), choice.name) << field.pointer;
            ++checked;
        }
    }
    EXPECT_GT(checked, 20);
}

TEST(Fields, WhatAnAbsentMemberMeansIsWhatTheParserTakes) {
    const diffraction::Material parsed = parse(cd());
    EXPECT_EQ(value_of(field_at("/grating/grooves"), cd()), parsed.grating.grooves);
    EXPECT_EQ(value_of(field_at("/grating/orders"), cd()), Json(parsed.grating.orders));
    EXPECT_EQ(value_of(field_at("/base/roughness"), cd()).get<float>(), parsed.base.roughness);
    EXPECT_EQ(value_of(field_at("/quality/max_error"), cd()), parsed.quality.max_error);
    EXPECT_EQ(choice_of(field_at("/metal"), cd()), "none");
    EXPECT_EQ(choice_of(field_at("/quality"), cd()), "by budget");
}

TEST(Fields, AnotherProfileKeepsWhatBothHave) {
    const Field& profile = field_at("/grating/profile");
    Json material = with_choice(cd(), profile, "lamellar");
    material = with_value(material, field_at("/grating/profile/depth_nm"), 123);
    material = with_choice(material, profile, "blazed");
    EXPECT_EQ(material["grating"]["profile"].dump(), R"({"type":"blazed","depth_nm":123})");
}

TEST(Fields, NewMembersStandWhereFilesHaveThem) {
    Json material = with_value(cd(), field_at("/quality"), {{"max_error", 0.1}});
    material = with_value(material, field_at("/base/roughness"), 0.5);
    material = with_value(material, field_at("/metal"), "Al");
    material = with_choice(material, field_at("/cover"), "over the grooves");
    material = with_value(material, field_at("/cover/tint"), {0.5, 1, 1});
    material = with_value(material, field_at("/grating/grooves"), 100);
    EXPECT_EQ(
        material.dump(),
        R"({"grating":{"pitch_nm":1600,"grooves":100,"profile":{"type":"slit","width_nm":800}},)"
        R"("metal":"Al","cover":{"ior":1.58,"tint":[0.5,1,1]},"base":{"roughness":0.5},"quality":{"max_error":0.1}})");
}

TEST(Fields, RevertingLeavesOutWhatNeedNotBeThere) {
    const Field& roughness = field_at("/base/roughness");
    EXPECT_FALSE(can_revert(roughness, cd()));
    const Json set = with_value(cd(), roughness, 0.5);
    EXPECT_TRUE(can_revert(roughness, set));
    EXPECT_FALSE(reverted(set, roughness)["base"].contains("roughness"));
    const Field& pitch = field_at("/grating/pitch_nm");
    EXPECT_FALSE(can_revert(pitch, cd()));
    EXPECT_EQ(reverted(with_value(cd(), pitch, 740), pitch), cd());
}

TEST(Fields, ARefusalIsAboutTheFieldOfItsPlace) {
    EXPECT_EQ(field_of_refusal("/grating/orders/3"), &field_at("/grating/orders"));
    EXPECT_EQ(field_of_refusal("/grating/profile/width_nm"), &field_at("/grating/profile/width_nm"));
    EXPECT_EQ(field_of_refusal("/grating/profile/unknown"), &field_at("/grating/profile"));
    EXPECT_EQ(field_of_refusal("/grating/pitch_nm2"), nullptr);
}

TEST(Fields, OrdersAreReadAsPeopleWriteThem) {
    EXPECT_EQ(parse_orders(" -2 -1, +1;2 "), Json({-2, -1, 1, 2}));
    EXPECT_EQ(parse_orders("all"), Json("all"));
    EXPECT_EQ(parse_orders("1 two"), Json("1 two"));
    EXPECT_EQ(format_orders(parse_orders("-1 0 3")), "-1 0 3");
    EXPECT_EQ(format_orders("all"), "all");
}

TEST(Fields, LinesPerMillimetreAreAPitchOfWholePicometres) {
    EXPECT_EQ(pitch_of_lines(600.0), 1666.667);
    EXPECT_EQ(pitch_of_lines(1200.0), 833.333);
    EXPECT_NEAR(lines_per_mm(pitch_of_lines(1200.0)), 1200.0, 1200.0 * 0.5e-3 / 833.0);  // half a picometre
}

}  // namespace
}  // namespace rowland::inspector
