#include "modules/diffraction/asset/material_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"

namespace rowland::diffraction {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Material parse(const std::string& text) {
    return parse_material(parse_json(text, "m.json"), "m.json");
}

std::string refusal(const std::string& text) {
    try {
        parse(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, Fault::Input);
        return error.what();
    }
    ADD_FAILURE() << "accepted: " << text;
    return "";
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
    const SpikeTableSettings settings = table_settings(material);
    EXPECT_EQ(settings.spikes.bands, 8);
    EXPECT_EQ(settings.spikes.spikes, 16);
    EXPECT_EQ(settings.theta_nodes, 48);
    EXPECT_EQ(settings.phi_nodes, 96);
    EXPECT_EQ(settings.storage, Storage::Half);
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

TEST(MaterialJson, ValuesOutOfTheirDomainAreRefusedWithTheirPlace) {
    EXPECT_THAT(refusal(R"({"grating": {"pitch_nm": 0, "profile": {"type": "slit", "width_nm": 800}}})"),
                HasSubstr("/grating/pitch_nm"));
    EXPECT_THAT(refusal(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 1601}}})"),
                HasSubstr("/grating/profile/width_nm"));
    EXPECT_THAT(
        refusal(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "lamellar", "duty": 1.2, "depth_nm": 1}}})"),
        HasSubstr("/grating/profile/duty"));
    EXPECT_THAT(refusal(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slitt", "width_nm": 800}}})"),
                HasSubstr("\"slit\""));
    EXPECT_THAT(refusal(grating(R"(, "grooves": 0)")), HasSubstr("/grating/grooves"));
    EXPECT_THAT(refusal(grating(R"(, "orders": [])")), HasSubstr("/grating/orders"));
    EXPECT_THAT(refusal(grating(R"(, "orders": [1, 1.5])")), HasSubstr("/grating/orders/1"));
    EXPECT_THAT(refusal(grating(R"(, "orders": [1, 1])")), HasSubstr("twice"));
    EXPECT_THAT(refusal(grating(R"(, "groove_lobe": {"sigma": 0})")), HasSubstr("/grating/groove_lobe/sigma"));
    EXPECT_THAT(refusal("[]"), HasSubstr("object"));
}

TEST(MaterialJson, AguNormalisationIsForTheSlitOnly) {
    EXPECT_EQ(parse(grating(R"(, "normalization": "agu")")).grating.normalization, Normalization::Agu);
    EXPECT_THAT(refusal(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "sinusoidal", "depth_nm": 100},
                            "normalization": "agu"}})"),
                HasSubstr("slit"));
}

}  // namespace
}  // namespace rowland::diffraction
