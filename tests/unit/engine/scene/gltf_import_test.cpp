#include "engine/scene/gltf_import.h"

#include <gmock/gmock.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/file.h"
#include "engine/scene/mesh_recipe.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::data_uri;
using test::document;
using test::error_of;
using test::indexed;
using test::load;
using test::set_attribute;
using testing::HasSubstr;

// The vertices of test::document.
constexpr std::array<float, 15> kPositions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

/// Strips keep the winding of their first triangle, fans rotate about their first vertex.
TEST(GltfImport, ListsStripsAndFansBecomeTriangles) {
    const std::tuple<json, std::vector<std::uint32_t>> cases[] = {
        {indexed(4, {0, 1, 2}), {0, 1, 2}},
        {document(5), {0, 1, 2, 1, 3, 2, 2, 3, 4}},
        {indexed(6, {0, 1, 3, 2}), {1, 3, 0, 3, 2, 0}},
    };
    for (const auto& [file, indices] : cases) {
        const Mesh mesh = load(file).meshes.at(0);
        EXPECT_EQ(mesh.indices, indices);
        EXPECT_TRUE(test::is_sane(mesh));
        EXPECT_EQ(mesh.normals[0], glm::vec3(0.0F, 0.0F, 1.0F));
    }
}

TEST(GltfImport, PointsAndLinesAreLeftOutWithOneWarning) {
    json file = document(0);
    file["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
    const ImportedScene scene = load(file);
    EXPECT_TRUE(scene.meshes.empty());
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_THAT(scene.warnings, testing::ElementsAre("points and lines are ignored"));
}

TEST(GltfImport, NodeTransformsMultiplyDownTheTree) {
    json file = document(5);
    file["nodes"] = {{{"children", {1}}, {"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}},
                     {{"mesh", 0}, {"rotation", {0, 0, 0.70710678, 0.70710678}}}};
    const ImportedScene scene = load(file);
    // +X turned to +Y, doubled and moved. Rotation given to 8 digits.
    const glm::vec4 p = scene.instances.at(0).transform * glm::vec4(1.0F, 0.0F, 0.0F, 1.0F);
    EXPECT_LT(glm::distance(glm::vec3(p), glm::vec3(1.0F, 4.0F, 3.0F)), 1e-6F);
}

TEST(GltfImport, MatrixIsColumnMajor) {
    json file = document(5);
    file["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    const glm::vec4 p = load(file).instances.at(0).transform * glm::vec4(1.0F, 0.0F, 0.0F, 1.0F);
    EXPECT_EQ(p, glm::vec4(5.0F, 7.0F, 7.0F, 1.0F));
}

TEST(GltfImport, NormalisedAttributesAreScaled) {
    json file = document(4);
    const std::vector<std::uint8_t> uvs = {0, 255, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    file["accessors"][0]["count"] = 3;
    set_attribute(file, "TEXCOORD_0", test::add_accessor(file, "VEC2", 5121, 3, std::as_bytes(std::span(uvs)), true));
    file["bufferViews"].back()["byteStride"] = 4;
    const Mesh mesh = load(file).meshes.at(0);
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0.0F, 1.0F));
    EXPECT_EQ(mesh.uvs[1], glm::vec2(0.0F, 0.0F));
}

TEST(GltfImport, UnusableNormalsAreGeneratedWithAWarning) {
    json file = document(5);
    std::vector<float> normals(15, 0.0F);
    normals[0] = 3.0F;  // usable, not unit
    normals[5] = std::numeric_limits<float>::quiet_NaN();
    set_attribute(file, "NORMAL", test::add_floats(file, "VEC3", normals));
    const ImportedScene scene = load(file);
    EXPECT_TRUE(test::is_sane(scene));
    EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(scene.meshes[0].normals[1], glm::vec3(0.0F, 0.0F, 1.0F));
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("normals without a direction")));
}

TEST(GltfImport, MaterialExtensionsArriveAsJson) {
    json file = document(5);
    file["extensionsUsed"] = {"VENDOR_material", "VENDOR_other", "VENDOR_other"};
    file["extensionsRequired"] = {"VENDOR_material"};
    file["materials"] = {{{"name", "m"}, {"extensions", {{"VENDOR_material", {{"pitch", 1600}, {"list", {1, 2}}}}}}}};
    const std::vector<std::string> handled = {"VENDOR_material"};
    const ImportedScene scene = load(file, handled);
    EXPECT_EQ(scene.materials.at(0).extensions.at("VENDOR_material")["list"][1], 2);
    EXPECT_THAT(scene.warnings, testing::ElementsAre("the extension VENDOR_other is ignored"));
    EXPECT_THAT(error_of(file), HasSubstr("\"VENDOR_material\""));
}

TEST(GltfImport, DataUrisOfAnyMediaTypeAreRead) {
    json file = document(5);
    file["buffers"][0]["uri"] = data_uri(std::as_bytes(std::span(kPositions)), "application/x-anything");
    EXPECT_EQ(load(file).meshes.at(0).positions.size(), 5U);
    file["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAA";
    EXPECT_THAT(error_of(file), HasSubstr("/buffers/0: 3 bytes of data"));
    file["buffers"][0]["uri"] = "data:,hello";
    EXPECT_THAT(error_of(file), HasSubstr("/buffers/0"));
}

TEST(GltfImport, FilesAreReadOnlyFromTheGltfsFolder) {
    const rowland::test::TemporaryFolder temporary;
    const std::filesystem::path folder = temporary.path() / "scene";
    const auto bytes = std::as_bytes(std::span(kPositions));
    write_file_atomic(temporary.path() / "secret.bin", bytes);
    write_file_atomic(folder / "parts" / "my mesh.bin", bytes);
    const auto load_with = [&](const std::string& uri) {
        json file = document(5);
        file["buffers"][0]["uri"] = uri;
        write_file_atomic(folder / "f.gltf", file.dump());
        load_gltf(folder / "f.gltf");
    };
    EXPECT_NO_THROW(load_with("parts/my%20mesh.bin"));
    EXPECT_NO_THROW(load_with("parts/../parts/my mesh.bin"));
    const auto refusal = [&](const std::string& uri) { return rowland::test::message_of([&] { load_with(uri); }); };
    EXPECT_THAT(refusal("../secret.bin"), HasSubstr("outside the glTF's folder"));
    EXPECT_THAT(refusal("parts/../../secret.bin"), HasSubstr("outside the glTF's folder"));
    EXPECT_THAT(refusal("%2e%2e/secret.bin"), HasSubstr("outside the glTF's folder"));
    EXPECT_THAT(
        refusal((temporary.path() / "secret.bin").string()),
        HasSubstr(rowland::test::has_posix_files() ? "outside the glTF's folder" : "expected the name of a file"));
    EXPECT_THAT(refusal("file:///etc/passwd"), HasSubstr("expected the name of a file"));
    EXPECT_THAT(refusal(""), HasSubstr("expected the name of a file"));
    EXPECT_THAT(refusal("parts"), HasSubstr("not a regular file"));
}

TEST(GltfImport, FileInMemoryMayNameNoFiles) {
    json file = document(5);
    file["buffers"][0]["uri"] = "mesh.bin";
    EXPECT_THAT(error_of(file), HasSubstr("an external file \"mesh.bin\""));
}

TEST(GltfImport, ZerosMayPadTheJsonOfAGlb) {
    json file = document(5);
    while (file.dump().size() % 4 != 1) file["asset"]["generator"] = file["asset"].value("generator", "") + "x";
    std::vector<std::byte> glb = test::glb_of(file);
    std::fill(glb.end() - 3, glb.end(), std::byte{0});
    EXPECT_EQ(load_glb(glb, "f.glb").meshes.size(), 1U);
}

TEST(GltfImport, RangesAreCheckedWithoutOverflow) {
    const auto with = [](const char* array, const char* key, const json& value) {
        json file = document(5);
        file[array][0][key] = value;
        return error_of(file);
    };
    EXPECT_THAT(with("accessors", "count", 6), HasSubstr("/accessors/0: 6 elements"));
    EXPECT_THAT(with("accessors", "count", 2147483647), HasSubstr("/accessors/0"));
    EXPECT_THAT(with("accessors", "count", 1ULL << 62), HasSubstr("/accessors/0/count"));
    EXPECT_THAT(with("accessors", "count", 0), HasSubstr("/accessors/0/count"));
    EXPECT_THAT(with("accessors", "count", -1), HasSubstr("/accessors/0/count"));
    EXPECT_THAT(with("accessors", "count", 1.5), HasSubstr("/accessors/0/count"));
    EXPECT_THAT(with("accessors", "byteOffset", 4), HasSubstr("/accessors/0"));
    EXPECT_THAT(with("accessors", "byteOffset", 18446744073709551612ULL), HasSubstr("/accessors/0/byteOffset"));
    EXPECT_THAT(with("accessors", "componentType", 5124), HasSubstr("/accessors/0/componentType"));
    EXPECT_THAT(with("accessors", "type", "VEC9"), HasSubstr("/accessors/0/type"));
    EXPECT_THAT(with("accessors", "type", "VEC2"), HasSubstr("vectors of 3 components"));
    EXPECT_THAT(with("bufferViews", "byteLength", 61), HasSubstr("/bufferViews/0"));
    EXPECT_THAT(with("bufferViews", "byteOffset", 1), HasSubstr("/bufferViews/0"));
    EXPECT_THAT(with("bufferViews", "byteStride", 16), HasSubstr("/accessors/0"));
    EXPECT_THAT(with("bufferViews", "byteStride", 0), HasSubstr("/bufferViews/0/byteStride"));
    EXPECT_THAT(with("bufferViews", "buffer", 4294967296ULL), HasSubstr("/bufferViews/0/buffer"));
    EXPECT_THAT(with("buffers", "byteLength", 61), HasSubstr("/buffers/0"));
    // GLB holds 32 bits of it.
    EXPECT_THAT(with("buffers", "byteLength", 3000000000), HasSubstr("the 3000000000 bytes of byteLength"));
    EXPECT_THAT(with("buffers", "byteLength", 0), HasSubstr("/buffers/0/byteLength"));
    EXPECT_THAT(with("nodes", "mesh", 1), HasSubstr("/nodes/0/mesh"));
    EXPECT_THAT(with("nodes", "children", json::array({7})), HasSubstr("/nodes/0/children"));
    EXPECT_THAT(with("nodes", "matrix", json::array({1, 2})), HasSubstr("/nodes/0/matrix"));
    EXPECT_THAT(with("nodes", "rotation", {0, 0, 0, 0}), HasSubstr("a zero quaternion"));
    EXPECT_THAT(with("scenes", "nodes", json::array({1})), HasSubstr("/scenes/0/nodes"));
}

TEST(GltfImport, ColumnsOfSmallMatricesBeginOnFourBytes) {
    const auto with = [](std::size_t size) {
        json file = document(5);
        const std::vector<std::byte> bytes(size);
        test::add_accessor(file, "MAT3", 5121, 2, bytes);
        return error_of(file);
    };
    EXPECT_EQ(with(24), "no error");
    EXPECT_THAT(with(20), HasSubstr("/accessors/1"));  // 18 would do without padding
}

TEST(GltfImport, SparseIndicesAndRangesAreChecked) {
    const auto with = [](std::uint16_t target, std::size_t count) {
        json file = document(5);
        std::vector<std::byte> bytes(14);
        std::memcpy(bytes.data(), &target, sizeof target);
        file["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}});
        file["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 2}});
        file["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 2}, {"byteLength", 12}});
        file["accessors"][0]["sparse"] = {{"count", count},
                                          {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                          {"values", {{"bufferView", 2}}}};
        return error_of(file);
    };
    EXPECT_EQ(with(4, 1), "no error");
    EXPECT_THAT(with(5, 1), HasSubstr("sparse index 5"));
    EXPECT_THAT(with(4, 2), HasSubstr("/accessors/0: sparse elements beyond"));
    EXPECT_THAT(with(4, 6), HasSubstr("6 sparse elements"));
}

TEST(GltfImport, AccessorWithoutDataDoesNotAllocateItsCount) {
    json file = document(5);
    file["accessors"][0] = {{"componentType", 5126}, {"count", 2000000000}, {"type", "VEC3"}};
    EXPECT_THAT(error_of(file), HasSubstr("2000000000 elements of 12 bytes"));
    file["accessors"][0]["sparse"] = {
        {"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
    EXPECT_THAT(error_of(file), HasSubstr("2000000000 elements of 12 bytes"));
}

TEST(GltfImport, AVariableRaisesTheMemoryOfAScene) {
    const auto asked = [] { MemoryBudget("a.glb").require_left(600, 1 << 20, "/meshes/0"); };
    EXPECT_THAT(rowland::test::message_of(asked),
                testing::AllOf(HasSubstr("at most 536870912 bytes"), HasSubstr("ROWLAND_SCENE_MEMORY")));
    rowland::test::set_variable("ROWLAND_SCENE_MEMORY", "600");
    EXPECT_NO_THROW(asked());
    rowland::test::set_variable("ROWLAND_SCENE_MEMORY", "511");
    EXPECT_THAT(rowland::test::message_of(asked), HasSubstr("expected a number of MiB from 512 to 4095"));
    rowland::test::set_variable("ROWLAND_SCENE_MEMORY", std::nullopt);
}

TEST(GltfImport, NamingTheSameDataOftenDoesNotMultiplyMemoryWithoutLimit) {
    // 3 MB of vertices named by 4000 primitives would be 12 GB.
    std::vector<float> positions(750'000, 1.0F);
    json file = document(5);
    const auto bytes = std::as_bytes(std::span(positions));
    file["buffers"][0] = {{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}};
    file["bufferViews"][0]["byteLength"] = bytes.size();
    file["accessors"][0]["count"] = positions.size() / 3;
    const json primitive = file["meshes"][0]["primitives"][0];
    for (int i = 0; i < 4000; ++i) file["meshes"][0]["primitives"].push_back(primitive);
    EXPECT_THAT(error_of(file), HasSubstr("bytes in the whole scene"));
}

TEST(GltfImport, CyclesAndSharedChildrenAreRefused) {
    json file = document(5);
    file["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
    EXPECT_THAT(error_of(file), HasSubstr("two parents"));
    file["nodes"] = {{{"children", {0}}}};
    EXPECT_THAT(error_of(file), HasSubstr("two parents"));
    file["nodes"] = {{{"children", {1, 2}}}, {{"children", {2}}}, {{"mesh", 0}}};
    EXPECT_THAT(error_of(file), HasSubstr("two parents"));
}

TEST(GltfImport, LongChainOfNodesLoads) {
    json file = document(5);
    file["nodes"] = json::array();
    constexpr int kLength = 50'000;
    for (int i = 0; i < kLength; ++i) file["nodes"].push_back({{"children", {i + 1}}});
    file["nodes"].push_back({{"mesh", 0}});
    EXPECT_EQ(load(file).instances.size(), 1U);
}

TEST(GltfImport, IndicesBeyondTheVerticesAreRefused) {
    EXPECT_THAT(error_of(indexed(4, {0, 1, 5})), HasSubstr("vertex index 5"));
    EXPECT_THAT(error_of(indexed(4, {0, 1})), HasSubstr("a multiple of 3"));
}

TEST(GltfImport, OnlyVersionTwoIsRead) {
    json file = document(5);
    for (const char* other : {"1.0", "3.0", "20.0", "2", "2.x", ""}) {
        file["asset"]["version"] = other;
        EXPECT_THAT(error_of(file),
                    HasSubstr("/asset/version: \"" + std::string(other) + "\"; expected glTF version 2"));
    }
    file["asset"]["version"] = "2.1";
    EXPECT_EQ(error_of(file), "no error");
}

TEST(GltfImport, FilesThatNeedALaterVersionAreRefused) {
    json file = document(5);
    file["asset"]["minVersion"] = "2.0";
    EXPECT_EQ(error_of(file), "no error");
    for (const char* later : {"2.1", "3.0", "1.0", "new"}) {
        file["asset"]["minVersion"] = later;
        EXPECT_THAT(error_of(file), HasSubstr("/asset/minVersion: \"" + std::string(later) + "\"; expected 2.0"));
    }
}

TEST(GltfImport, AccessorWithoutBufferViewReadsAsZeros) {
    json file = document(4);
    for (const auto& [name, type] :
         {std::pair("POSITION", "VEC3"), {"NORMAL", "VEC3"}, {"COLOR_0", "VEC4"}, {"TEXCOORD_1", "VEC2"}}) {
        set_attribute(file, name, file["accessors"].size());
        file["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", type}});
    }
    file["meshes"][0]["primitives"][0]["indices"] = file["accessors"].size();
    file["accessors"].push_back({{"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}});
    const Mesh mesh = load(file).meshes.at(0);
    EXPECT_EQ(mesh.positions, std::vector(4, glm::vec3(0.0F)));
    EXPECT_EQ(mesh.colours, std::vector(4, glm::vec4(0.0F)));
    EXPECT_EQ(mesh.uvs1, std::vector(4, glm::vec2(0.0F)));
    EXPECT_THAT(mesh.indices, testing::ElementsAre(0, 0, 0));
    EXPECT_TRUE(test::is_sane(mesh));
}

TEST(GltfImport, SparseElementsReplaceZeros) {
    json file = document(5);
    file["bufferViews"][0]["byteLength"] = 60;
    const std::uint16_t target = 3;
    const std::size_t index_view = test::add_view(file, std::as_bytes(std::span(&target, 1)));
    file["accessors"][0] = {{"componentType", 5126}, {"count", 5}, {"type", "VEC3"}};
    // The second vertex of the document, (1, 0, 0).
    file["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", index_view}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", 0}, {"byteOffset", 12}}}};
    const Mesh mesh = load(file).meshes.at(0);
    std::vector<glm::vec3> expected(5, glm::vec3(0.0F));
    expected[3] = glm::vec3(1.0F, 0.0F, 0.0F);
    EXPECT_EQ(mesh.positions, expected);
}

TEST(GltfImport, PrimitivesWithoutPositionsAreLeftOutWithOneWarning) {
    json file = document(5);
    const json whole = file["meshes"][0]["primitives"][0];
    json without = whole;
    without["attributes"] = {{"NORMAL", 0}};
    file["meshes"][0]["primitives"] = {without, whole, without};
    const ImportedScene scene = load(file);
    EXPECT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.instances.size(), 1U);
    EXPECT_THAT(scene.warnings, testing::ElementsAre("primitives without POSITION are ignored"));
}

TEST(GltfImport, OnlyABufferThatIsUsedNeedsData) {
    json file = document(5);
    file["buffers"].push_back({{"byteLength", 100}});
    EXPECT_EQ(load(file).meshes.at(0).positions.size(), 5U);
    file["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 100}});
    EXPECT_THAT(error_of(file), HasSubstr("/buffers/1: 0 bytes of data"));
}

std::string error_of_text(std::string_view text) {
    return rowland::test::message_of([&] { load_glb(std::as_bytes(std::span(text)), "f.gltf"); });
}

TEST(GltfImport, RepeatedKeysAreRefused) {
    EXPECT_THAT(error_of_text(R"({"asset": {"version": "2.0"}, "nodes": [{}, {"name": "a", "name": "b"}]})"),
                HasSubstr("f.gltf: /nodes/1/name: a repeated key"));
}

TEST(GltfImport, WithoutScenesTheRootNodesAreShown) {
    json file = document(5);
    file.erase("scene");
    file.erase("scenes");
    file["nodes"] = {{{"mesh", 0}, {"name", "child"}}, {{"children", {0}}, {"translation", {1, 0, 0}}}};
    const ImportedScene scene = load(file);
    ASSERT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.instances[0].transform[3].x, 1.0F);
}

TEST(GltfImport, SyntaxErrorsSayWhere) {
    EXPECT_THAT(error_of_text("{\n  \"asset\": oops\n}"), HasSubstr("f.gltf: line 2"));
}

TEST(GltfImport, SaysHowTheTangentsOfAMeshWereMade) {
    nlohmann::json file = test::document(5);
    EXPECT_EQ(load(file).tangents, (std::vector{TangentSource::Arbitrary}));
    test::set_attribute(file, "TEXCOORD_0", test::add_floats(file, "VEC2", std::vector<float>(10, 0.5F)));
    EXPECT_EQ(load(file).tangents, (std::vector{TangentSource::Uvs}));
    std::vector<float> tangents;
    for (int i = 0; i < 5; ++i) tangents.insert(tangents.end(), {1.0F, 0.0F, 0.0F, 1.0F});
    test::set_attribute(file, "TANGENT", test::add_floats(file, "VEC4", tangents));
    EXPECT_EQ(load(file).tangents, (std::vector{TangentSource::File}));
}

ImportedScene sphere_with(const glm::mat4& transform) {
    ImportedScene scene;
    scene.meshes.push_back(build_mesh(SphereRecipe{.radius = 1.0, .rings = 32, .segments = 64}));
    scene.instances.push_back({"sphere", transform, 0, std::nullopt, 0, std::nullopt});
    return scene;
}

/// The direction in which v grows, as mesh.h defines the tangent's sign.
glm::vec3 bitangent(const Mesh& mesh, std::size_t i) {
    return glm::cross(mesh.normals[i], glm::vec3(mesh.tangents[i])) * mesh.tangents[i].w;
}

TEST(MergeInstances, MirroredBitangentIsTheMirrorImage) {
    const ImportedScene scene = sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, 1.0F, -1.0F)));
    const Mesh merged = merge_instances(scene);
    for (std::size_t i = 0; i < merged.positions.size(); ++i) {
        const glm::vec3 expected = bitangent(scene.meshes[0], i) * glm::vec3(1.0F, 1.0F, -1.0F);
        EXPECT_LT(glm::distance(bitangent(merged, i), expected), 1e-6F) << i;  // rounding
    }
}

TEST(MergeInstances, NormalsStayPerpendicularAndOutwardUnderUnevenAndMirroringScale) {
    // An ellipsoid x²/16 + y² + z²/0.25 = 1 has the normal (x/16, y, z/0.25).
    const Mesh merged = merge_instances(sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(-4.0F, 1.0F, 0.5F))));
    EXPECT_TRUE(test::is_sane(merged));
    EXPECT_GT(test::signed_volume(merged), 8.0);
    for (std::size_t i = 0; i < merged.positions.size(); ++i) {
        const glm::vec3 p = merged.positions[i];
        const glm::vec3 expected = glm::normalize(glm::vec3(p.x / 16.0F, p.y, p.z / 0.25F));
        EXPECT_LT(glm::distance(merged.normals[i], expected), 2e-6F) << i;  // rounding, stretched by the scale
    }
}

TEST(MergeInstances, TwoInstancesStandApart) {
    ImportedScene scene = sphere_with(glm::mat4(1.0F));
    scene.instances.push_back(
        {"moved", glm::translate(glm::mat4(1.0F), glm::vec3(10.0F, 0.0F, 0.0F)), 0, std::nullopt, 0, std::nullopt});
    const Mesh merged = merge_instances(scene);
    EXPECT_EQ(merged.positions.size(), 2 * scene.meshes[0].positions.size());
    EXPECT_FLOAT_EQ(bounds(merged).minimum.x, -1.0F);
    EXPECT_FLOAT_EQ(bounds(merged).maximum.x, 11.0F);
    EXPECT_NEAR(test::signed_volume(merged), 2.0 * test::signed_volume(scene.meshes[0]), 1e-4);  // float rounding at 10
}

TEST(MergeInstances, FlattenedInstanceStaysSane) {
    EXPECT_TRUE(test::is_sane(merge_instances(sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, 0.0F, 1.0F))))));
    EXPECT_TRUE(test::is_sane(merge_instances(sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(0.0F))))));
}

TEST(MergeInstances, OverflowingInstanceIsRefused) {
    ImportedScene scene = sphere_with(glm::scale(glm::mat4(1.0F), glm::vec3(3e38F)));
    for (glm::vec3& position : scene.meshes[0].positions) position *= 10.0F;
    EXPECT_THROW(merge_instances(scene), Error);
}

TEST(MergeInstances, ManyCopiesOfALargeMeshAreRefusedBeforeTheyAreMade) {
    ImportedScene scene = sphere_with(glm::mat4(1.0F));
    scene.instances.resize(100'000, scene.instances[0]);
    EXPECT_THROW(merge_instances(scene), Error);
}

TEST(MergeInstances, EmptySceneIsAnEmptyMesh) {
    const Mesh merged = merge_instances({});
    EXPECT_TRUE(merged.positions.empty());
    EXPECT_EQ(bounds(merged).maximum, glm::vec3(0.0F));
}

}  // namespace
}  // namespace rowland::scene
