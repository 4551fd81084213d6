#include "engine/scene/editable_gltf.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

#include "engine/scene/gltf_import.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::scene {
namespace {

namespace fs = std::filesystem;
using rowland::test::bytes_of;
using rowland::test::message_of;
using rowland::test::TemporaryFolder;
using testing::HasSubstr;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* kName = "TEST_grating";
constexpr std::uint64_t kMost = 1 << 24;

std::string json_text_of(std::vector<std::byte> file) {
    const GltfSource source = split_gltf(std::move(file), "file", std::nullopt);
    return {reinterpret_cast<const char*>(source.json_text().data()), source.json_text().size()};
}

OrderedJson json_of(const EditableGltf& gltf) {
    return OrderedJson::parse(json_text_of(gltf.bytes()));
}

std::vector<std::byte> binary_of(std::vector<std::byte> file) {
    const GltfSource source = split_gltf(std::move(file), "file", std::nullopt);
    return {source.binary().begin(), source.binary().end()};
}

/// Chunks by hand: type and data, padded as they are given.
std::vector<std::byte> glb_of(const std::vector<std::pair<std::string, std::string>>& chunks,
                              const std::string& after = "") {
    std::string file = "glTF";
    const auto put = [&](std::size_t number) {
        for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(number >> shift);
    };
    put(2);
    std::size_t size = 12;
    for (const auto& [type, data] : chunks) size += 8 + data.size();
    put(size);
    for (const auto& [type, data] : chunks) {
        put(data.size());
        file += type;
        file += data;
    }
    return bytes_of(file + after);
}

const std::string kBin("BIN\0", 4);

/// A PNG of one texel, written by hand; `shade` tells one from another.
std::vector<std::byte> picture(int shade) {
    static constexpr unsigned char kDot[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
        0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00,
        0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x00, 0x00, 0x00, 0x02, 0x00, 0x01,
        0x48, 0xaf, 0xa4, 0x71, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    const auto bytes = std::as_bytes(std::span(kDot));
    std::vector<std::byte> png(bytes.begin(), bytes.end());
    png.insert(png.end(), static_cast<std::size_t>(shade), std::byte{0});  // readers ignore what follows the end
    return png;
}

OrderedJson grating() {
    return OrderedJson::parse(R"({"grating": {"pitch_nm": 740, "orders": [-1, 1]}, "grooveTexture":
        {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}})");
}

/// What set_material_extension() means, on a parsed file.
void set_slowly(OrderedJson& gltf, std::size_t material, const OrderedJson& value) {
    gltf["materials"][material]["extensions"][kName] = value;
    for (const char* name : {"KHR_texture_transform", kName}) {
        OrderedJson& used = gltf["extensionsUsed"];
        if (std::ranges::find(used, name) == used.end()) used.push_back(name);
    }
}

std::vector<fs::path> sound_files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const char* kind : {"valid", "draco"})
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder / kind))
            if (const auto extension = entry.path().extension(); extension == ".gltf" || extension == ".glb")
                files.push_back(entry.path());
    return files;
}

TEST(EditableGltf, OnlyTheNamedMaterialDiffersInEveryValidFile) {
    ROWLAND_TEST_DATA(folder, "gltf");
    for (const fs::path& file : sound_files_below(folder)) {
        const std::vector<std::byte> before = read_file(file, kMost);
        const EditableGltf opened = EditableGltf::open(file);
        EXPECT_EQ(json_of(opened), OrderedJson::parse(json_text_of(before))) << file;
        EXPECT_EQ(binary_of(opened.bytes()), binary_of(before)) << file;
        for (std::size_t i = 0; i < std::min<std::size_t>(opened.outline().materials.size(), 3); ++i) {
            EditableGltf edited = opened;
            edited.set_material_extension(i, kName, grating());
            EXPECT_EQ(edited.material_extension(i, kName), grating());
            OrderedJson expected = json_of(opened);
            set_slowly(expected, i, grating());
            // Members are added at the end, wherever the slow way has them.
            EXPECT_EQ(nlohmann::json::parse(json_of(edited).dump()), nlohmann::json::parse(expected.dump())) << file;
            EXPECT_EQ(binary_of(edited.bytes()), binary_of(before)) << file;
            EXPECT_FALSE(edited == opened);
            edited.set_material_extension(i, kName, nullptr);
            EXPECT_EQ(edited.bytes(), opened.bytes()) << file << ", material " << i;
            EXPECT_TRUE(edited == opened);
        }
    }
}

TEST(EditableGltf, RemovingAfterSavingGivesTheFirstContentInEveryValidFile) {
    ROWLAND_TEST_DATA(folder, "gltf");
    const TemporaryFolder to;
    for (const fs::path& file : sound_files_below(folder)) {
        const std::vector<std::byte> before = read_file(file, kMost);
        if (EditableGltf::open(file).outline().materials.empty()) continue;
        const fs::path copy = to.path() / file.filename();
        write_file_atomic(copy, before);
        for (const OrderedJson& value : {grating(), OrderedJson(), OrderedJson("x"), OrderedJson()}) {
            EditableGltf gltf = EditableGltf::open(copy);
            gltf.set_material_extension(0, kName, value);
            gltf.save();
            if (value.is_null()) {
                EXPECT_EQ(OrderedJson::parse(json_text_of(read_file(copy, kMost))),
                          OrderedJson::parse(json_text_of(before)))
                    << file;
                EXPECT_EQ(binary_of(read_file(copy, kMost)), binary_of(before)) << file;
            }
        }
    }
}

TEST(EditableGltf, ChunksOfOtherKindsStay) {
    const std::string json = R"({"asset":{"version":"2.0"},"materials":[{"name":"a","extras":{"x":1.5}}]}   )";
    EditableGltf gltf(glb_of({{"JSON", json}, {kBin, "12345678"}, {"MORE", "unknown!"}}, "behind"), "a.glb");
    gltf.set_material_extension(0, kName, {{"n", 1}});
    const std::string now = R"({"asset":{"version":"2.0"},"materials":[{"name":"a","extras":{"x":1.5},"extensions":)"
                            R"({"TEST_grating":{"n":1}}}],"extensionsUsed":["TEST_grating"]}   )";
    EXPECT_EQ(gltf.bytes(), glb_of({{"JSON", now}, {kBin, "12345678"}, {"MORE", "unknown!"}}));
}

TEST(EditableGltf, WhatWeDoNotReadSurvivesInItsOrder) {
    const std::string before = R"({"unknown":[null,{"z":1,"a":{}}],"asset":{"version":"2.0","extras":{"b":1e-3}},
        "meshes":[{"weights":[0.5],"primitives":[{"targets":[{"POSITION":1}],"material":0,"attributes":{"POSITION":0},
            "extensions":{"X_lines":{"width":12345678901234}}}]}],
        "accessors":[{"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}],
        "skins":[{"extensions":{"X_bones":{}},"joints":[0]}],
        "materials":[{"extensions":{"X_first":{"b":1,"a":[2]},"TEST_grating":{"z":1,"y":2}},"name":"m"}]})";
    EditableGltf gltf(bytes_of(before), "a.gltf");
    gltf.set_material_extension(0, kName, {{"x", 3}, {"y", 4}, {"z", 1}});
    OrderedJson expected = OrderedJson::parse(before);
    expected["materials"][0]["extensions"][kName] = OrderedJson::parse(R"({"z":1,"y":4,"x":3})");
    expected["extensionsUsed"] = {kName};
    EXPECT_EQ(json_of(gltf).dump(), expected.dump());
}

TEST(EditableGltf, ExtensionsUsedStaysRight) {
    EditableGltf gltf(bytes_of(R"({"asset":{"version":"2.0"},"extensionsUsed":["A"],"extensionsRequired":["A"],
        "materials":[{"extensions":{"A":{}}},{"extras":{"extensions":{"A":{}}}}]})"),
                      "a.gltf");
    gltf.set_material_extension(1, kName, grating());
    EXPECT_EQ(json_of(gltf)["extensionsUsed"], OrderedJson({"A", "KHR_texture_transform", kName}));
    gltf.set_material_extension(0, kName, {{"n", 1}});
    gltf.set_material_extension(1, kName, nullptr);
    EXPECT_EQ(json_of(gltf)["extensionsUsed"], OrderedJson({"A", kName})) << "the first material still has it";
    gltf.set_material_extension(0, kName, nullptr);
    gltf.set_material_extension(0, "A", nullptr);
    EXPECT_FALSE(json_of(gltf).contains("extensionsUsed")) << "extras are no use";
    EXPECT_FALSE(json_of(gltf).contains("extensionsRequired"));
}

const char* const kShared = R"({
  "asset": { "version": "2.0" },
  "materials": [
    { "name": "gold", "extras": 1.50 },
    { "name": "gold.001" }
  ],
  "meshes": [
    { "name": "ring", "primitives": [ { "attributes": {}, "material": 0 }, { "attributes": {}, "material": 0 } ] },
    { "name": "bare", "primitives": [ { "attributes": {} } ] }
  ]
})";

TEST(EditableGltf, OwnMaterialCopiesAShared) {
    EditableGltf gltf(bytes_of(kShared), "a.gltf");
    EXPECT_EQ(gltf.own_material({0, 1}), 2U);
    EXPECT_EQ(gltf.own_material({0, 1}), 2U) << "it has one for itself already";
    EXPECT_EQ(gltf.own_material({0, 0}), 0U) << "and so has the other now";
    EXPECT_EQ(gltf.own_material({1, 0}), 3U);
    EXPECT_THAT(gltf.outline().materials, testing::ElementsAre("gold", "gold.001", "gold.002", "bare"));
    OrderedJson expected = OrderedJson::parse(kShared);
    expected["materials"].push_back({{"name", "gold.002"}, {"extras", 1.5}});
    expected["materials"].push_back({{"name", "bare"}});
    expected["meshes"][0]["primitives"][1]["material"] = 2;
    expected["meshes"][1]["primitives"][0]["material"] = 3;
    EXPECT_EQ(json_text_of(gltf.bytes()), expected.dump(2) + "\n") << "in lines, as it was";
}

TEST(EditableGltf, AGlbTakesImagesIntoItsBinaryChunk) {
    for (const bool has_chunk : {true, false}) {
        const std::string json =
            has_chunk
                ? R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":5}],"bufferViews":[{"buffer":0,"byteLength":5}]})"
                : R"({"asset":{"version":"2.0"}})";
        const std::string padded = json + std::string((4 - json.size() % 4) % 4, ' ');
        std::vector<std::pair<std::string, std::string>> chunks = {{"JSON", padded}};
        if (has_chunk) chunks.emplace_back(kBin, "12345678");
        EditableGltf gltf(glb_of(chunks), "a.glb");
        EXPECT_EQ(gltf.add_texture(picture(0), "grooves", {{"wrapS", 33071}}), 0U);
        EXPECT_EQ(gltf.add_texture(picture(3), "others"), 1U);
        EXPECT_EQ(gltf.add_texture(picture(0), "grooves", {{"wrapS", 33071}}), 0U) << "it is there";
        const EditableGltf again(gltf.bytes(), "a.glb");
        EXPECT_EQ(EditableGltf(again).add_texture(picture(3), "others"), 1U) << "also in a file that was saved";
        const ImportedScene scene = load_glb(gltf.bytes(), "a.glb");
        ASSERT_EQ(scene.textures.size(), 2U);
        EXPECT_EQ(scene.textures[0].wrap_s, TextureWrap::Clamp);
        EXPECT_EQ(scene.images[0]->rgba, std::vector<std::uint8_t>({0, 0, 0, 255}));
        const std::vector<std::byte> binary = binary_of(gltf.bytes());
        if (has_chunk) {
            EXPECT_EQ(std::memcmp(binary.data(), "12345678", 8), 0);
        }
        const OrderedJson document = json_of(gltf);
        for (const OrderedJson& view : document["bufferViews"])
            EXPECT_LE(view.value("byteOffset", std::size_t{0}) + view["byteLength"].get<std::size_t>(),
                      document["buffers"][0]["byteLength"].get<std::size_t>());
        EXPECT_LE(document["buffers"][0]["byteLength"], binary.size());
    }
}

TEST(EditableGltf, AGltfGetsImagesAsFilesBesideIt) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "scene.gltf";
    write_file_atomic(file, std::string_view(R"({"asset":{"version":"2.0"}})"));
    write_file_atomic(folder.path() / "my_grooves.png", std::string_view("taken"));
    EditableGltf gltf = EditableGltf::open(file);
    EXPECT_EQ(gltf.add_texture(picture(0), "my grooves"), 0U);
    EXPECT_EQ(gltf.add_texture(picture(0), "my grooves", {{"wrapS", 33071}}), 1U) << "the image with another sampler";
    EXPECT_FALSE(fs::exists(folder.path() / "my_grooves_2.png")) << "save() writes it";
    gltf.save();
    EXPECT_EQ(read_file(folder.path() / "my_grooves_2.png", kMost), picture(0));
    EXPECT_EQ(read_text_file(folder.path() / "my_grooves.png", kMost), "taken");
    EXPECT_EQ(EditableGltf::open(file).add_texture(picture(0), "my grooves"), 0U);
    EXPECT_EQ(load_gltf(file).textures.size(), 2U);
    EXPECT_THAT(message_of([&] { gltf.add_texture(bytes_of("text"), "picture.txt"); }), HasSubstr("picture.txt"));
}

TEST(EditableGltf, SavesOverTheOpenedFileUnlessItChanged) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "scene.gltf";
    write_file_atomic(file, std::string_view(kShared));
    const fs::path link = folder.path() / "link.gltf";
    const bool linked = rowland::test::make_link("scene.gltf", link);
    EditableGltf gltf = EditableGltf::open(linked ? link : file);
    const EditableGltf before = gltf;
    gltf.set_material_extension(0, kName, 1);
    gltf.save();
    EXPECT_EQ(fs::is_symlink(link), linked) << "the link is followed";
    EXPECT_EQ(read_file(file, kMost), gltf.bytes());
    EditableGltf undone = before;
    undone.save();
    EXPECT_EQ(OrderedJson::parse(read_text_file(file, kMost)), OrderedJson::parse(kShared))
        << "a copy from before knows of the first save";

    write_file_atomic(file, std::string_view("by another program"));
    EXPECT_TRUE(gltf.changed_on_disk());
    EXPECT_THAT(message_of([&] { gltf.save(); }, Fault::System), HasSubstr("changed since it was opened"));
    EXPECT_EQ(read_text_file(file, kMost), "by another program");
    gltf.save(gltf.path(), EditableGltf::IfChanged::Overwrite);
    EXPECT_EQ(read_file(file, kMost), gltf.bytes());
    EXPECT_FALSE(gltf.changed_on_disk());
}

TEST(EditableGltf, StaysInTheFolderOfTheFilesThatItNames) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "scene.gltf";
    write_file_atomic(file, std::string_view(R"({"asset":{"version":"2.0"},"images":[{"uri":"wood.png"}]})"));
    EditableGltf gltf = EditableGltf::open(file);
    gltf.save(folder.path() / "beside.gltf");
    const std::string message = message_of([&] { gltf.save(folder.path() / "other" / "scene.gltf"); });
    EXPECT_THAT(message, HasSubstr("wood.png"));
    EXPECT_FALSE(fs::exists(folder.path() / "other"));
}

/// One node by its parts, one by a matrix, and one without the extension.
constexpr const char* kNodes = R"({"asset":{"version":"2.0"},"extensionsUsed":["TEST_grating","OTHER"],
    "scene":1,"scenes":[{"nodes":[0]},{"nodes":[1,2]}],
    "nodes":[{"name":"hall","translation":[1,2.5,3],"extras":7,"extensions":{"TEST_grating":{"a":1,"b":2},"OTHER":{}}},
        {"matrix":[0,0,-2,0, 0,1,0,0, 3,0,0,0, 5,6,7,1],"extensions":{"TEST_grating":{"a":3}}},
        {"name":"plain","extensions":{"OTHER":{}}}]})";

TEST(EditableGltf, NodesWithAnExtensionAreMovedAddedAndFreedOfIt) {
    EditableGltf gltf(bytes_of(kNodes), "a.gltf");
    const OrderedJson before = json_of(gltf);
    std::vector<ExtendedNode> nodes = gltf.nodes_with(kName);
    ASSERT_EQ(nodes.size(), 2U);
    EXPECT_EQ(nodes[0].name, "hall");
    EXPECT_EQ(nodes[0].translation, glm::dvec3(1.0, 2.5, 3.0));
    EXPECT_EQ(nodes[0].extension, (OrderedJson{{"a", 1}, {"b", 2}}));
    EXPECT_EQ(nodes[1].translation, glm::dvec3(5.0, 6.0, 7.0));
    EXPECT_EQ(nodes[1].scale, glm::dvec3(2.0, 1.0, 3.0));
    EXPECT_LT(glm::distance(nodes[1].rotation * glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, -1.0)), 1e-6);
    gltf.set_nodes_with(kName, nodes);
    EXPECT_EQ(json_of(gltf), before);

    nodes[0].extension = {{"b", 4}};
    nodes[1].translation.y = 0.1;
    nodes.push_back({.name = "new", .translation = {9.0, 0.0, 0.0}, .extension = {{"a", 5}}});
    gltf.set_nodes_with(kName, nodes);
    const OrderedJson after = json_of(gltf);
    EXPECT_EQ(after["nodes"][0]["extras"], 7);
    EXPECT_EQ(after["nodes"][0]["extensions"], OrderedJson::parse(R"({"TEST_grating":{"b":4},"OTHER":{}})"));
    EXPECT_FALSE(after["nodes"][0].contains("rotation"));
    EXPECT_FALSE(after["nodes"][1].contains("matrix"));
    EXPECT_EQ(after["nodes"][1]["scale"], OrderedJson({2.0, 1.0, 3.0}));
    EXPECT_EQ(after["nodes"][2], before["nodes"][2]);
    EXPECT_EQ(after["nodes"][3]["name"], "new");
    EXPECT_EQ(after["scenes"], OrderedJson::parse(R"([{"nodes":[0]},{"nodes":[1,2,3]}])"));
    nodes[2].index = 3;
    EXPECT_EQ(gltf.nodes_with(kName), nodes);

    gltf.set_nodes_with(kName, {});
    const OrderedJson freed = json_of(gltf);
    EXPECT_EQ(freed["nodes"].size(), 4U);
    EXPECT_FALSE(freed["nodes"][1].contains("extensions"));
    EXPECT_EQ(freed["nodes"][0]["extensions"], OrderedJson::parse(R"({"OTHER":{}})"));
    EXPECT_EQ(freed["extensionsUsed"], OrderedJson({"OTHER"}));
}

TEST(EditableGltf, ANodeIsAddedToAFileWithoutScenes) {
    EditableGltf gltf(bytes_of(R"({"asset":{"version":"2.0"}})"), "a.gltf");
    gltf.set_nodes_with(kName, std::vector<ExtendedNode>{{.name = "new", .extension = {{"a", 5}}}});
    EXPECT_EQ(json_of(gltf),
              OrderedJson::parse(R"({"asset":{"version":"2.0"},"nodes":[{"name":"new","translation":[0.0,0.0,0.0],
                  "rotation":[0.0,0.0,0.0,1.0],"extensions":{"TEST_grating":{"a":5}}}],
                  "extensionsUsed":["TEST_grating"]})"));
}

TEST(EditableGltf, RefusesWhatIsNoGltf) {
    const auto refusal = [](const std::string& text) {
        return message_of([&] { EditableGltf(bytes_of(text), "a.gltf"); });
    };
    EXPECT_THAT(refusal("{"), HasSubstr("a.gltf: line 1"));
    EXPECT_THAT(refusal("{}"), HasSubstr("/asset"));
    EXPECT_THAT(refusal(R"({"asset":{"version":"1.0"}})"), HasSubstr("/asset/version"));
    EXPECT_THAT(refusal(R"({"asset":{"version":"2.0"},"asset":1})"), HasSubstr("repeated key"));
    const auto with = [&](const std::string& member) {
        return refusal(R"({"asset":{"version":"2.0"},)" + member + "}");
    };
    EXPECT_THAT(with(R"("materials":{})"), HasSubstr("/materials"));
    EXPECT_THAT(with(R"("materials":[{"extensions":[]}])"), HasSubstr("/materials/0/extensions"));
    EXPECT_THAT(with(R"("meshes":[{"primitives":[{"material":0}]}])"), HasSubstr("/meshes/0/primitives/0/material"));
    EXPECT_THAT(with(R"("extensionsUsed":[1])"), HasSubstr("/extensionsUsed"));
    EXPECT_THAT(with(R"("images":[{"uri":1}])"), HasSubstr("/images/0/uri"));
    EXPECT_THAT(with(R"("buffers":3)"), HasSubstr("/buffers"));
    EXPECT_THAT(with(R"("nodes":[{"translation":[1,2]}])"), HasSubstr("/nodes/0/translation"));
    EXPECT_THAT(with(R"("nodes":[{"extensions":[]}])"), HasSubstr("/nodes/0/extensions"));
    EXPECT_THAT(with(R"("scenes":[{"nodes":0}])"), HasSubstr("/scenes/0/nodes"));
    EXPECT_THAT(with(R"("scenes":[{}],"scene":1)"), HasSubstr("/scene"));
}

}  // namespace
}  // namespace rowland::scene
