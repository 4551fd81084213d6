#include "editor/inspector/field.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "engine/core/file.h"
#include "modules/asset_types.h"
#include "modules/diffraction/asset/material.h"
#include "modules/thin_film/asset/gltf_iridescence.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

Json cd() {
    return Json::parse(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})");
}

diffraction::Material parse(const Json& material) {
    return diffraction::parse_material(nlohmann::json::parse(material.dump()), "m.json",
                                       diffraction::read_beside(test::content_path("materials")));
}

/// A list of fields, with the least material that shows them.
struct Kind {
    std::span<const Field> fields;
    Json least;
    void (*parse)(const Json&);
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {fields(), cd(), [](const Json& material) { parse(material); }},
        {film_fields(), Json::parse(R"({"film": {"ior": 1.33, "thickness_nm": 400}, "base": {"ior": 1}})"),
         [](const Json& material) { thin_film::parse_film_material(nlohmann::json(material), "m.json"); }},
        {iridescence_fields(), Json::parse(R"({"iridescenceFactor": 1})"),
         [](const Json& material) { thin_film::parse_gltf_iridescence(nlohmann::json(material), "m.glb", ""); }}};
    return all;
}

const Kind& kind_of(const Field& field) {
    return *std::ranges::find_if(kinds(), [&](const Kind& kind) {
        return &field >= kind.fields.data() && &field < kind.fields.data() + kind.fields.size();
    });
}

/// A material that shows the field.
Json suited_to(const Field& field) {
    const Kind& kind = kind_of(field);
    if (field.only_with.empty()) return kind.least;
    const std::string& name = field.only_for.front();
    const auto offers = [&](const Field& other) {
        return other.pointer == field.only_with &&
               std::ranges::any_of(other.choices, [&](const Choice& choice) { return choice.name == name; });
    };
    const Field& other = *std::ranges::find_if(kind.fields, offers);
    Json material = with_choice(suited_to(other), other, name);
    if (name == "streak") material["grating"]["groove_lobe"] = {{"sigma", 0.1}};
    if (name == "height_map") material["grating"]["profile"]["file"] = "wing_cell.png";
    return material;
}

/// Fields with the same pointer are told apart by what they are shown for.
std::string name_of(const Field& field) {
    return field.pointer + " " + field.only_with + " " + (field.only_for.empty() ? "" : field.only_for.front());
}

TEST(Fields, EveryOneHasItsUnitRangeHelpAndSource) {
    for (const Kind& kind : kinds()) {
        std::set<std::string> pointers;
        for (const Field& field : kind.fields) {
            EXPECT_TRUE(pointers.insert(name_of(field)).second) << field.pointer;
            EXPECT_FALSE(field.label.empty()) << field.pointer;
            EXPECT_GT(field.help.size(), 20U) << field.pointer;
            EXPECT_FALSE(field.source.empty()) << field.pointer;
            EXPECT_LT(field.minimum, field.maximum) << field.pointer;
            EXPECT_EQ(field.pointer.ends_with("_nm") || field.pointer.find("ThicknessM") != std::string::npos,
                      field.unit == "nm")
                << field.pointer;
        }
    }
}

TEST(Fields, AMaterialShowsOneFieldOfAPointer) {
    for (const Kind& kind : kinds())
        for (const Field& suited : kind.fields) {
            const Json material = suited_to(suited);
            EXPECT_EQ(shown_field(suited.pointer, material), &suited) << name_of(suited);
            std::set<std::string> shown;
            for (const Field& field : kind.fields)
                EXPECT_TRUE(!is_shown(field, material) || shown.insert(field.pointer).second) << field.pointer;
        }
}

// The schema lists what a material may hold; whoever adds a member must tell the inspector of it.
TEST(Fields, EveryMemberOfTheSchemaHasAField) {
    const Json members = modules::asset_types()->find("material")->schema()["properties"];
    const auto has_field = [](const std::string& pointer) {
        return std::ranges::any_of(fields(), [&](const Field& field) { return field.pointer == pointer; });
    };
    for (const Json& grating : members["grating"]["oneOf"])
        for (const auto& [name, part] : grating["properties"].items())
            EXPECT_TRUE(has_field("/grating/" + name) || name == "lattice") << name;
    for (const char* name : {"/grating/lattice/a_nm", "/grating/lattice/b_nm", "/metal", "/quality"})
        EXPECT_TRUE(has_field(name)) << name;
    EXPECT_EQ(members.size(), 6U);  // those, the grating and these
    for (const std::string of : {"base", "cover", "transmission"})
        for (const auto& [name, part] : members[of]["properties"].items())
            EXPECT_TRUE(has_field(fmt::format("/{}/{}", of, name))) << name;
    std::set<std::string> of_film;
    const Json film = modules::asset_types()->find("film")->schema();
    for (const Json& alternative : film["oneOf"])
        for (const auto& [name, part] : alternative["properties"].items()) of_film.insert("/" + name);
    EXPECT_EQ(of_film.size(), 5U);
    for (const std::string& pointer : of_film)
        EXPECT_TRUE(std::ranges::any_of(film_fields(), [&](const Field& field) {
            return field.pointer.starts_with(pointer);
        })) << pointer;
}

/// Grooves that rigorous theory knows.
void make_solvable(Json& material) {
    material["grating"]["profile"] = {{"type", "sinusoidal"}, {"depth_nm", 100.0}};
    material["metal"] = "Al";
}

TEST(Fields, BothEndsOfEverySliderAreSaneMaterials) {
    int checked = 0;
    for (const Kind& kind : kinds())
        for (const Field& field : kind.fields) {
            if (field.kind != FieldKind::Number && field.kind != FieldKind::Count) continue;
            for (const double end : {field.minimum, field.maximum}) {
                Json material = suited_to(field);
                if (field.pointer.starts_with("/grating/films")) make_solvable(material);
                if (const Json& grating = material.value("grating", Json()); grating.contains("lattice"))
                    material["grating"]["lattice"] = {{"a_nm", {end + 500.0, 0.0}}, {"b_nm", {0.0, end + 500.0}}};
                else if (field.pointer == "/grating/profile/width_nm")
                    material["grating"]["pitch_nm"] = end;
                if (field.pointer == "/grating/pitch_nm") material["grating"]["profile"]["width_nm"] = end / 2.0;
                if (field.pointer == "/quality/map_resolution" && end < 8.0) continue;  // the parser's is 8
                const Json value = field.kind == FieldKind::Count ? Json(static_cast<int>(end)) : Json(end);
                EXPECT_NO_THROW(kind.parse(with_value(material, field, value))) << field.pointer << " " << end;
                ++checked;
            }
        }
    EXPECT_GT(checked, 100);
}

TEST(Fields, EveryChoiceIsASaneMaterial) {
    int checked = 0;
    for (const Kind& kind : kinds())
        for (const Field& field : kind.fields) {
            for (const Choice& choice : field.choices) {
                if (choice.name == "table") continue;  // needs a file
                Json material = suited_to(field);
                if (choice.name == "rigorous" || choice.name == "a film") make_solvable(material);
                if (choice.name == "streak") material["grating"]["groove_lobe"] = {{"sigma", 0.1}};
                Json chosen = with_choice(material, field, choice.name);
                if (choice.name == "height_map") chosen["grating"]["profile"]["file"] = "wing_cell.png";
                EXPECT_NO_THROW(kind.parse(chosen)) << field.pointer << " " << choice.name;
                EXPECT_EQ(choice_of(field, chosen), choice.name) << field.pointer;
                ++checked;
            }
        }
    EXPECT_GT(checked, 50);
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

TEST(Fields, AFilmLiesOnAMetalOrAnIndexAndKeepsItsFirstLayers) {
    const Json titanium = Json::parse(R"({"film": {"ior": 2.4, "thickness_nm": 45}, "base": {"ior": 2.5, "k": 3.3}})");
    const Field& metal = *shown_field("/metal", titanium);
    const Json gold = with_choice(titanium, metal, "Au");
    EXPECT_EQ(gold.dump(), R"({"film":{"ior":2.4,"thickness_nm":45},"metal":"Au"})");
    EXPECT_EQ(reverted(gold, metal)["base"], Json::parse(R"({"ior": 1.5})"));
    const Json in_scene = Json::parse(R"({"extras": {"base": {"ior": 2.5, "k": 3.3}, "by": "hand"}})");
    const Field& in_scene_metal = *shown_field("/extras/metal", in_scene);
    const Json on_gold = with_choice(in_scene, in_scene_metal, "Au");
    EXPECT_EQ(on_gold["extras"], Json::parse(R"({"metal": "Au", "by": "hand"})"));
    EXPECT_EQ(reverted(on_gold, in_scene_metal)["extras"], Json::parse(R"({"by": "hand"})")) << "as its surface";

    const Field& layers = field_at("/film");
    const Json three = with_choice(titanium, layers, "3");
    EXPECT_EQ(three["film"].size(), 3U);
    EXPECT_EQ(three["film"][0], titanium["film"]);
    const Json edited = with_value(three, *shown_field("/film/1/ior", three), 1.46);
    EXPECT_EQ(edited["film"][1]["ior"], 1.46);
    EXPECT_EQ(edited["film"][2], three["film"][2]);
    EXPECT_EQ(with_choice(edited, layers, "2")["film"][1], edited["film"][1]);
    EXPECT_EQ(with_choice(edited, layers, "1"), titanium);
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

TEST(Fields, AnotherPatternReplacesTheGratingAndIsNotReverted) {
    const Field& pattern = field_at("/grating");
    const Json lattice = with_choice(cd(), pattern, "lattice");
    EXPECT_FALSE(lattice["grating"].contains("pitch_nm"));
    EXPECT_TRUE(parse(lattice).grating.lattice.has_value());
    EXPECT_FALSE(can_revert(pattern, lattice));
    EXPECT_EQ(value_of(*shown_field("/grating/orders", lattice), lattice), parse(lattice).grating.lattice->orders);
    EXPECT_EQ(parse(with_choice(lattice, pattern, "grooves")).grating.pitch_nm, 1600.0);
}

TEST(Fields, ARefusalIsAboutTheFieldOfItsPlace) {
    const auto field = [](const char* pointer) { return field_of_refusal(pointer, cd()); };
    EXPECT_EQ(field("/grating/orders/3"), &field_at("/grating/orders"));
    EXPECT_EQ(field("/grating/profile/width_nm"), &field_at("/grating/profile/width_nm"));
    EXPECT_EQ(field("/grating/profile/unknown"), &field_at("/grating/profile"));
    EXPECT_EQ(field("/grating/pitch_nm2"), &field_at("/grating"));
    EXPECT_EQ(field("/gratings"), nullptr);
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

TEST(OrderedJson, ShippedMaterialsAreWrittenAsTheyWereRead) {
    int files = 0;
    const std::filesystem::path folder = test::content_path("materials");
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        const std::string text = read_text_file(entry.path(), 1 << 20);
        EXPECT_EQ(format_json(parse_ordered(text, entry.path().string())), text) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 8);
}

TEST(OrderedJson, KeysKeepTheOrderOfTheFile) {
    EXPECT_EQ(format_json(parse_ordered(R"({"z":1,"a":{"y":2,"b":[3,4]}})", "m.json")),
              "{\n  \"z\": 1,\n  \"a\": { \"y\": 2, \"b\": [3, 4] }\n}\n");
}

TEST(OrderedJson, WhatWouldBeTooWideIsBroken) {
    Json wide;
    for (int i = 0; i < 40; ++i) wide["list"].push_back(1000 + i);
    const std::string text = format_json(wide);
    EXPECT_THAT(text, testing::HasSubstr("[\n    1000,\n    1001,"));
    EXPECT_EQ(Json::parse(text), wide);
}

TEST(OrderedJson, HostileTextIsRefusedWithItsPlace) {
    EXPECT_THAT(test::message_of([] { parse_ordered("{\"a\": 1,\n  b}", "m.json"); }),
                testing::AllOf(testing::HasSubstr("m.json"), testing::HasSubstr("line 2")));
    EXPECT_THAT(test::message_of([] { parse_ordered(std::string(20000, '['), "m.json"); }),
                testing::HasSubstr("nested too deep"));
    EXPECT_THAT(test::message_of([] { parse_ordered("{\"a\": \"\xff\"}", "m.json"); }), testing::HasSubstr("m.json"));
}

TEST(Field, AnglesAreShownInDegreesAndStoredInRadians) {
    const Field& rotation = field_at("/grooveRotation");
    EXPECT_NEAR(shown_number(rotation, std::numbers::pi / 3.0), 60.0, 1e-12);
    EXPECT_NEAR(stored_number(rotation, 60.0), std::numbers::pi / 3.0, 1e-15);
    EXPECT_EQ(shown_unit(rotation), "°");
    EXPECT_EQ(shown_number(field_at("/grating/pitch_nm"), 1600.0), 1600.0);
    EXPECT_EQ(shown_unit(field_at("/grating/pitch_nm")), "nm");
}

}  // namespace
}  // namespace rowland::inspector
