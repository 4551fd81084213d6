#include "engine/scene/gltf_import.h"

#include <gmock/gmock.h>

#include <limits>

#include "tests/unit/engine/scene/hand_written_gltf.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

json with_colours(const std::string& type, int component_type, std::span<const std::byte> bytes, bool normalised) {
    json file = test::document(5);
    test::set_attribute(file, "COLOR_0", test::add_accessor(file, type, component_type, 5, bytes, normalised));
    return file;
}

TEST(PrimitiveAttribute, ColoursOfEveryTypeAreRead) {
    const std::vector<float> floats = {0, 0.5F, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0.25F, 3.4e38F, 0};
    Mesh mesh = load(with_colours("VEC3", 5126, std::as_bytes(std::span(floats)), false)).meshes.at(0);
    EXPECT_TRUE(test::is_sane(mesh));
    ASSERT_EQ(mesh.colours.size(), 5U);
    EXPECT_EQ(mesh.colours[0], glm::vec4(0.0F, 0.5F, 1.0F, 1.0F));
    EXPECT_EQ(mesh.colours[4], glm::vec4(0.25F, 1.0F, 0.0F, 1.0F));
    std::vector<std::uint8_t> bytes(20, 0);
    bytes[0] = 255;
    bytes[3] = 51;
    mesh = load(with_colours("VEC4", 5121, std::as_bytes(std::span(bytes)), true)).meshes.at(0);
    EXPECT_EQ(mesh.colours.at(0), glm::vec4(1.0F, 0.0F, 0.0F, 0.2F));
    std::vector<std::uint16_t> shorts(20, 0);
    shorts[1] = 65535;
    mesh = load(with_colours("VEC4", 5123, std::as_bytes(std::span(shorts)), true)).meshes.at(0);
    EXPECT_EQ(mesh.colours.at(0), glm::vec4(0.0F, 1.0F, 0.0F, 0.0F));
    EXPECT_TRUE(load(test::document(5)).meshes.at(0).colours.empty());
}

TEST(PrimitiveAttribute, ColoursOfOtherTypesAreRefused) {
    const std::vector<std::uint8_t> bytes(40, 0);
    EXPECT_THAT(error_of(with_colours("VEC4", 5121, std::as_bytes(std::span(bytes)), false)),
                HasSubstr("COLOR_0 of another type"));
    EXPECT_THAT(error_of(with_colours("VEC2", 5126, std::as_bytes(std::span(bytes)), false)),
                HasSubstr("vectors of 4 components"));
}

TEST(PrimitiveAttribute, ColoursThatAreNotNumbersAreWhite) {
    std::vector<float> floats(20, 0.5F);
    floats[0] = kNan;
    floats[4] = -3.0F;
    const ImportedScene scene = load(with_colours("VEC4", 5126, std::as_bytes(std::span(floats)), false));
    EXPECT_TRUE(test::is_sane(scene));
    EXPECT_EQ(scene.meshes[0].colours[0], glm::vec4(1.0F));
    EXPECT_EQ(scene.meshes[0].colours[1], glm::vec4(0.0F, 0.5F, 0.5F, 0.5F));
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("set to white")));
}

TEST(PrimitiveAttribute, SecondUvsAreReadAndTheirTangentsUsed) {
    json file = test::document(5);
    // u grows along -Y in the second set.
    test::set_attribute(file, "TEXCOORD_0", test::add_floats(file, "VEC2", {0, 0, 1, 0, 0, 1, 1, 1, 0, 2}));
    test::set_attribute(file, "TEXCOORD_1", test::add_floats(file, "VEC2", {0, 0, 0, 1, -1, 0, -1, 1, -2, 0}));
    EXPECT_EQ(load(file).meshes.at(0).tangents.at(0), glm::vec4(1.0F, 0.0F, 0.0F, -1.0F));
    EXPECT_EQ(load(file).meshes.at(0).uvs1.at(4), glm::vec2(-2.0F, 0.0F));
    file["images"] = {{{"uri",
                        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGA"
                        "WjR9awAAAABJRU5ErkJggg=="}}};
    file["textures"] = {{{"source", 0}}};
    file["materials"] = {{{"normalTexture", {{"index", 0}, {"texCoord", 1}}}}};
    file["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_EQ(load(file).meshes.at(0).tangents.at(0), glm::vec4(0.0F, -1.0F, 0.0F, -1.0F));
}

TEST(PrimitiveAttribute, CountsMustAgree) {
    for (const char* name : {"TEXCOORD_1", "COLOR_0"}) {
        json file = test::document(5);
        const std::string type = std::string(name) == "COLOR_0" ? "VEC4" : "VEC2";
        test::set_attribute(file, name, test::add_floats(file, type, std::vector<float>(4, 0.0F)));
        EXPECT_THAT(error_of(file), HasSubstr(std::string("values of ") + name));
    }
}

json skinned(const std::vector<std::uint16_t>& joints, const std::vector<float>& weights) {
    json file = test::document(5);
    const std::size_t count = joints.size() / 4;
    test::set_attribute(file, "JOINTS_0",
                        test::add_accessor(file, "VEC4", 5123, count, std::as_bytes(std::span(joints))));
    test::set_attribute(file, "WEIGHTS_0", test::add_floats(file, "VEC4", weights));
    return file;
}

TEST(PrimitiveAttribute, WeightsAreMadeToSumToOne) {
    std::vector<std::uint16_t> joints(20, 0);
    for (std::size_t i = 0; i < 4; ++i) joints[i] = static_cast<std::uint16_t>(i + 300);
    std::vector<float> weights(20, 0.0F);
    weights[0] = 2.0F;
    weights[1] = 6.0F;
    for (std::size_t i = 4; i < 20; i += 4) weights[i] = 1.0F;
    const ImportedScene scene = load(skinned(joints, weights));
    EXPECT_TRUE(test::is_sane(scene.meshes.at(0)));
    EXPECT_EQ(scene.meshes[0].weights[0], glm::vec4(0.25F, 0.75F, 0.0F, 0.0F));
    EXPECT_EQ(scene.meshes[0].joints[0], glm::u16vec4(300, 301, 0, 0)) << "unused slots name no joint";
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(PrimitiveAttribute, UnusableWeightsAreRepairedWithWarnings) {
    std::vector<float> weights(20, 0.0F);
    weights[0] = kNan;
    weights[1] = -1.0F;
    weights[2] = 0.5F;
    std::vector<std::uint16_t> joints(20, 7);
    const ImportedScene scene = load(skinned(joints, weights));
    EXPECT_TRUE(test::is_sane(scene.meshes.at(0)));
    EXPECT_EQ(scene.meshes[0].weights[0], glm::vec4(0.0F, 0.0F, 1.0F, 0.0F));
    EXPECT_EQ(scene.meshes[0].weights[1], glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
    EXPECT_EQ(scene.meshes[0].joints[1].x, 7);
    EXPECT_THAT(scene.warnings,
                testing::ElementsAre(HasSubstr("negative or not numbers"), HasSubstr("given to their first joint")));
}

TEST(PrimitiveAttribute, JointsOfOtherTypesAreRefused) {
    json file = skinned(std::vector<std::uint16_t>(20, 0), std::vector<float>(20, 1.0F));
    const auto joints = file["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"].get<std::size_t>();
    file["accessors"][joints]["normalized"] = true;
    EXPECT_THAT(error_of(file), HasSubstr("JOINTS_0 of another type"));
    file["accessors"][joints]["normalized"] = false;
    file["accessors"][joints]["componentType"] = 5122;
    EXPECT_THAT(error_of(file), HasSubstr("JOINTS_0 of another type"));
    EXPECT_THAT(error_of(skinned(std::vector<std::uint16_t>(20, 0), std::vector<float>(16, 1.0F))),
                HasSubstr("as many as WEIGHTS_0, 4"));
    EXPECT_THAT(error_of(skinned(std::vector<std::uint16_t>(16, 0), std::vector<float>(16, 1.0F))),
                HasSubstr("4 values of JOINTS_0"));
}

TEST(PrimitiveAttribute, SecondSetOfJointsIsIgnoredWithAWarning) {
    json file = skinned(std::vector<std::uint16_t>(20, 0), std::vector<float>(20, 1.0F));
    const json& attributes = file["meshes"][0]["primitives"][0]["attributes"];
    test::set_attribute(file, "JOINTS_1", attributes["JOINTS_0"].get<std::size_t>());
    EXPECT_THAT(load(file).warnings, testing::ElementsAre("joints beyond four a vertex are ignored"));
}

}  // namespace
}  // namespace rowland::scene
