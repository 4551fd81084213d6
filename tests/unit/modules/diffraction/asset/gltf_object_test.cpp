#include "modules/diffraction/asset/gltf_object.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/core/file.h"
#include "modules/diffraction/asset/material_json.h"
#include "tests/support/source_tree.h"

namespace rowland::diffraction {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

TEST(GltfObject, LeavesOutTheBaseAndWhatACookMeasures) {
    const OrderedJson material = OrderedJson::parse(R"({"grating": {"pitch_nm": 740}, "base": {"roughness": 0.3},
        "quality": {"max_error": 0.1, "probes": ["a.json"], "surface": "curved", "illuminant": "A"}})");
    EXPECT_EQ(gltf_object(material, "", ""),
              OrderedJson::parse(R"({"grating": {"pitch_nm": 740}, "quality": {"illuminant": "A"}})"));
    EXPECT_FALSE(gltf_object(OrderedJson::parse(R"({"quality": {"max_error": 0.1}})"), "", "").contains("quality"));
    const OrderedJson pinned = OrderedJson::parse(R"({"quality": {"representation": "arc", "max_error": 0.1}})");
    EXPECT_EQ(gltf_object(pinned, "", ""), pinned);
}

TEST(GltfObject, IsAcceptedForEveryShippedMaterial) {
    for (const fs::directory_entry& entry : fs::directory_iterator(test::content_path("materials"))) {
        if (entry.path().extension() != ".json") continue;
        const fs::path elsewhere = fs::temp_directory_path();
        const OrderedJson object = gltf_object(OrderedJson::parse(read_text_file(entry.path(), 1 << 20)),
                                               entry.path().parent_path(), elsewhere);
        const GltfGrating grating = parse_gltf_extension(nlohmann::json::parse(object.dump()), "scene.glb", elsewhere);
        EXPECT_FALSE(grating.has_base);
        const Grating expected = load_material(entry.path()).grating;
        EXPECT_EQ(grating.material.grating.pitch_nm, expected.pitch_nm) << entry.path();
        EXPECT_EQ(grating.material.grating.profile.index(), expected.profile.index()) << entry.path();
    }
}

TEST(GltfObject, NamesOfFilesMoveAndComeBack) {
    const OrderedJson object = OrderedJson::parse(R"({"grating": {"profile": {"type": "table", "file": "t/a b.csv"}},
        "quality": {"illuminant": "lamp.csv"}})");
    OrderedJson moved = object;
    move_named_files(moved, "/x/y", "/x/z/w");
    EXPECT_EQ(moved["grating"]["profile"]["file"], "../../y/t/a b.csv");
    EXPECT_EQ(moved["quality"]["illuminant"], "../../y/lamp.csv");
    move_named_files(moved, "/x/z/w", "/x/y");
    EXPECT_EQ(moved, object);
    for (const char* other : {R"({"quality": {"illuminant": "D65"}})", R"({"grating": 3, "quality": []})",
                              R"({"grating": {"profile": {"file": "/whole/path.csv"}}})", "7"}) {
        OrderedJson same = OrderedJson::parse(other);
        move_named_files(same, "/x", "/y");
        EXPECT_EQ(same, OrderedJson::parse(other));
    }
}

TEST(GltfObject, IsDescribedInOneLine) {
    const auto parsed = nlohmann::json::parse(R"({"grating": {"pitch_nm": 833.333, "profile":
        {"type": "blazed", "depth_nm": 250}}, "grooveRotation": 0.7853981634, "grooveTexture": {"index": 2}})");
    EXPECT_EQ(describe(parse_gltf_extension(parsed, "scene.glb", "")),
              "833.333 nm blazed, grooves turned by 45 degrees, groove texture 2");
}

}  // namespace
}  // namespace rowland::diffraction
