#include "modules/diffraction/asset/lattice_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/height_map_png.h"
#include "modules/diffraction/asset/layer_weights.h"
#include "tests/support/message_of.h"

namespace rowland::diffraction {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

HeightMap staircase() {
    HeightMap map{.columns = 16, .rows = 8, .heights = {}, .depth_nm = 120.0};
    for (int i = 0; i < 16 * 8; ++i) map.heights.push_back(static_cast<std::uint8_t>(2 * i));
    return map;
}

NamedText read_cell(const std::string& name) {
    return {.text = name == "cell.png" ? write_height_map(staircase()) : "no picture", .file = name};
}

Material lattice_of(const std::string& text) {
    return parse_material(parse_json(text, "m.json"), "m.json", read_cell);
}

std::string lattice_refusal(const std::string& text) {
    return rowland::test::message_of([&] { lattice_of(text); });
}

std::string with_cell(const std::string& profile, const std::string& more = "") {
    return R"({"grating": {"lattice": {"a_nm": [50000, 0], "b_nm": [0, 40000]}, "profile": )" + profile + more + "}}";
}

const char* const kAperture = R"({"type": "aperture", "width_nm": 15000, "height_nm": 40000})";

TEST(LatticeJson, EveryProfileReachesTheMaterial) {
    const Material screen = lattice_of(with_cell(kAperture, R"(, "orders": 12)"));
    ASSERT_TRUE(screen.grating.lattice);
    EXPECT_EQ(screen.grating.lattice->a_nm, glm::dvec2(50000.0, 0.0));
    EXPECT_EQ(screen.grating.lattice->b_nm, glm::dvec2(0.0, 40000.0));
    EXPECT_EQ(screen.grating.lattice->orders, 12);
    EXPECT_EQ(std::get<ApertureProfile>(screen.grating.lattice->profile).width_nm, 15000.0);
    EXPECT_EQ(std::get<ApertureProfile>(screen.grating.lattice->profile).height_nm, 40000.0);
    EXPECT_TRUE(screen.grating.orders.empty());
    const Material crossed = lattice_of(with_cell(
        R"({"type": "crossed", "along_a": {"type": "sinusoidal", "depth_nm": 120}, "along_b": {"type": "blazed", "depth_nm": 90}})"));
    const auto& grooves = std::get<CrossedProfile>(crossed.grating.lattice->profile);
    EXPECT_EQ(std::get<SinusoidalProfile>(grooves.along_a).depth_nm, 120.0);
    EXPECT_EQ(std::get<BlazedProfile>(grooves.along_b).depth_nm, 90.0);
    EXPECT_EQ(crossed.grating.lattice->orders, 2);
    const Material relief = lattice_of(with_cell(R"({"type": "height_map", "file": "cell.png", "depth_nm": 75})"));
    const auto& heights = std::get<HeightMap>(relief.grating.lattice->profile);
    EXPECT_EQ(heights.columns, 16);
    EXPECT_EQ(heights.heights, staircase().heights);
    EXPECT_EQ(heights.depth_nm, 75.0);
}

TEST(LatticeJson, ParallelSidesAreRefused) {
    const auto with_sides = [](const std::string& sides) {
        return R"({"grating": {"lattice": )" + sides + R"(, "profile": )" + kAperture + "}}";
    };
    for (const char* sides :
         {R"({"a_nm": [50000, 0], "b_nm": [40000, 0]})", R"({"a_nm": [500, 500], "b_nm": [-5000, -5000]})",
          R"({"a_nm": [50000, 0], "b_nm": [40000, 1000]})"})
        EXPECT_THAT(lattice_refusal(with_sides(sides)),
                    AllOf(HasSubstr("/grating/lattice/b_nm"), HasSubstr("degrees")));
    EXPECT_NO_THROW(lattice_of(with_sides(R"({"a_nm": [50000, 0], "b_nm": [50000, 4374]})")));  // 5 degrees
    EXPECT_THAT(lattice_refusal(with_sides(R"({"a_nm": [299, 0], "b_nm": [0, 50000]})")), HasSubstr("length of 299"));
    EXPECT_THAT(lattice_refusal(with_sides(R"({"a_nm": [9e6, 9e6], "b_nm": [0, 50000]})")), HasSubstr("/lattice/a_nm"));
    EXPECT_THAT(lattice_refusal(with_sides(R"({"a_nm": [50000], "b_nm": [0, 50000]})")), HasSubstr("/lattice/a_nm"));
}

TEST(LatticeJson, WhatIsOfGroovesAloneIsRefused) {
    for (const char* member :
         {R"("pitch_nm": 1600)", R"("grooves": 1500)", R"("normalization": "agu")", R"("groove_lobe": {"sigma": 0.2})"})
        EXPECT_THAT(lattice_refusal(with_cell(kAperture, std::string(", ") + member)), HasSubstr("beside a lattice"));
    EXPECT_THAT(lattice_refusal(with_cell(kAperture, R"(, "orders": [1, 2])")), HasSubstr("/grating/orders"));
    EXPECT_THAT(lattice_refusal(with_cell(kAperture, R"(, "orders": 10000)")), HasSubstr("/grating/orders"));
    EXPECT_THAT(lattice_refusal(with_cell(R"({"type": "slit", "width_nm": 800})")), HasSubstr("/grating/profile/type"));
    EXPECT_THAT(
        lattice_refusal(with_cell(
            R"({"type": "crossed", "along_a": {"type": "table", "file": "t.csv"}, "along_b": {"type": "blazed", "depth_nm": 9}})")),
        AllOf(HasSubstr("/grating/profile/along_a"), HasSubstr("table")));
    EXPECT_THAT(lattice_refusal(R"({"grating": {"pitch_nm": 1600, "profile": )" + std::string(kAperture) + "}}"),
                HasSubstr("/grating/profile/type"));
}

TEST(LatticeJson, PicturesThatHoldNoCellAreRefused) {
    EXPECT_THAT(lattice_refusal(with_cell(R"({"type": "height_map", "file": "other.png", "depth_nm": 75})")),
                AllOf(HasSubstr("other.png"), HasSubstr("PNG")));
    EXPECT_THAT(
        lattice_refusal(with_cell(R"({"type": "height_map", "file": "cell.png", "depth_nm": 75})", R"(, "orders": 4)")),
        AllOf(HasSubstr("/grating/profile/file"), HasSubstr("more than 8 texels")));
}

TEST(LatticeJson, RepresentationsForGroovesAreRefused) {
    const auto asking_for = [](const std::string& name) {
        std::string text = with_cell(kAperture);
        text.back() = ',';
        return text + R"( "quality": {"representation": ")" + name + "\"}}";
    };
    EXPECT_THAT(lattice_refusal(asking_for("circle")),
                AllOf(HasSubstr("/quality/representation"), HasSubstr("with a lattice"), HasSubstr("\"planar\"")));
    for (const char* name : {"spikes", "bins", "transfer", "arc", "planar", "direct", "streak"})
        EXPECT_NO_THROW(lattice_of(asking_for(name))) << name;
}

TEST(LatticeJson, AGrooveTextureOnALatticeIsRefused) {
    const std::string text = with_cell(kAperture);
    const auto parse_members = [&](const std::string& more) {
        const nlohmann::json json = parse_json(text.substr(0, text.size() - 1) + more + "}", "disc.gltf");
        parse_gltf_extension(json, "disc.gltf", "");
    };
    EXPECT_NO_THROW(parse_members(R"(, "grooveRotation": 0.5)"));
    EXPECT_THAT(rowland::test::message_of([&] { parse_members(R"(, "grooveTexture": {"index": 2})"); }),
                AllOf(HasSubstr("/grooveTexture"), HasSubstr("lattice")));
}

/// What is neither in the listed orders nor in the mirror's goes to the base.
TEST(LatticeJson, LayersShareTheLight) {
    const Material screen = lattice_of(with_cell(kAperture, R"(, "orders": 40)"));
    const LayerWeights weights = layer_weights(screen.grating);
    EXPECT_NEAR(weights.mirror.y, 0.3 * 0.3, 1e-9);
    EXPECT_NEAR(weights.base.y, 0.7, 5e-3);
}

TEST(LatticeJson, ACookedMaterialHoldsItsHeights) {
    const nlohmann::json json =
        parse_json(with_cell(R"({"type": "height_map", "file": "cell.png", "depth_nm": 75})"), "m.json");
    const CookedMaterial cooked = cook_material(json, "m.json", read_cell);
    const CookedMaterial again = read_cooked_material(write_cooked_material(json, cooked), "m.material");
    EXPECT_EQ(std::get<HeightMap>(again.material.grating.lattice->profile).heights, staircase().heights);
    EXPECT_THAT(describe(again), AllOf(HasSubstr("a_nm: 50000 0"), HasSubstr("representation: planar")));
}

}  // namespace
}  // namespace rowland::diffraction
