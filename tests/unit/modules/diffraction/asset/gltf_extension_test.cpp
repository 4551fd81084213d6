#include "modules/diffraction/asset/gltf_extension.h"

#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kSlitMembers = R"("grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}})";

GltfGrating parse_extension(const std::string& members, const std::filesystem::path& folder = "") {
    return parse_gltf_extension(parse_json("{" + members + "}", "disc.gltf"), "disc.gltf", folder,
                                "/materials/3/extensions/ROWLAND_materials_diffraction");
}

std::string extension_refusal(const std::string& members) {
    return rowland::test::message_of([&] { parse_extension(members); });
}

TEST(GltfExtension, OnlyTheGratingIsRequired) {
    const GltfGrating plain = parse_extension(kSlitMembers);
    EXPECT_EQ(plain.material.grating.pitch_nm, 1600.0);
    EXPECT_FALSE(plain.has_base);
    EXPECT_EQ(plain.groove_rotation, 0.0);
    EXPECT_FALSE(plain.groove_texture.has_value());
}

TEST(GltfExtension, EveryMemberReachesTheResult) {
    const GltfGrating full =
        parse_extension(kSlitMembers + R"(, "metal": "Ag", "base": {"roughness": 0.6}, "grooveRotation": -0.5,
        "grooveTexture": {"index": 4, "texCoord": 1, "sparkle": true, "extras": {"a": 1}, "extensions": {"KHR_texture_transform": {}}},
        "quality": {"max_error": 0.2}, "extras": 7, "extensions": {"VENDOR_x": {}})");
    EXPECT_EQ(full.material.grating.metal, colour::Metal::Ag);
    EXPECT_TRUE(full.has_base);
    EXPECT_EQ(full.material.base.roughness, 0.6F);
    EXPECT_EQ(full.material.quality.max_error, 0.2);
    EXPECT_EQ(full.groove_rotation, -0.5);
    ASSERT_TRUE(full.groove_texture.has_value());
    EXPECT_EQ(full.groove_texture->index, 4);
    EXPECT_EQ(full.groove_texture->tex_coord, 1);
    EXPECT_TRUE(full.groove_texture->sparkle);
}

TEST(GltfExtension, ATableIsFoundBesideTheGltf) {
    const rowland::test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "sub" / "t.csv", "wavelength_nm,R+1\n500,0.25\n");
    const GltfGrating found = parse_extension(
        R"("grating": {"pitch_nm": 1600, "profile": {"type": "table", "file": "sub/t.csv"}})", folder.path());
    EXPECT_EQ(profile_efficiency(found.material.grating.profile, 1600.0, 1, 500.0), 0.25);
}

TEST(GltfExtension, FailuresNameThePlaceInTheGltf) {
    const std::string pointer = "/materials/3/extensions/ROWLAND_materials_diffraction";
    EXPECT_THAT(extension_refusal(R"("metal": "Al")"), AllOf(HasSubstr("disc.gltf"), HasSubstr(pointer + "/grating")));
    EXPECT_THAT(extension_refusal(kSlitMembers + R"(, "grooveRotatoin": 1)"),
                AllOf(HasSubstr(pointer), HasSubstr("grooveRotation")));
    EXPECT_THAT(extension_refusal(kSlitMembers + R"(, "grooveRotation": "90deg")"),
                HasSubstr(pointer + "/grooveRotation"));
    EXPECT_THAT(extension_refusal(kSlitMembers + R"(, "grooveTexture": {})"),
                HasSubstr(pointer + "/grooveTexture/index"));
    EXPECT_THAT(extension_refusal(kSlitMembers + R"(, "grooveTexture": {"index": -1})"),
                HasSubstr("/grooveTexture/index"));
    EXPECT_THAT(extension_refusal(kSlitMembers + R"(, "grooveTexture": {"index": 0, "texcoord": 1})"),
                HasSubstr("texCoord"));
}

TEST(GltfExtension, AGrooveTextureOnALatticeIsRefused) {
    const std::string cell = R"("grating": {"lattice": {"a_nm": [50000, 0], "b_nm": [0, 40000]},
        "profile": {"type": "aperture", "width_nm": 15000, "height_nm": 40000}})";
    EXPECT_NO_THROW(parse_extension(cell + R"(, "grooveRotation": 0.5)"));
    EXPECT_THAT(extension_refusal(cell + R"(, "grooveTexture": {"index": 2})"),
                AllOf(HasSubstr("/grooveTexture"), HasSubstr("lattice")));
}

TEST(GltfObject, LeavesOutTheBaseAlone) {
    OrderedJson material = OrderedJson::parse(R"({"grating": {"pitch_nm": 740}, "base": {"roughness": 0.3},
        "quality": {"max_error": 0.1, "surface": "curved", "illuminant": "A"}})");
    const OrderedJson object = gltf_object(material, "", "");
    material.erase("base");
    EXPECT_EQ(object, material);
}

TEST(GltfObject, IsAcceptedForEveryShippedMaterial) {
    for (const fs::directory_entry& entry : fs::directory_iterator(rowland::test::content_path("materials"))) {
        if (entry.path().extension() != ".json") continue;
        const OrderedJson source = OrderedJson::parse(read_text_file(entry.path(), 1 << 20));
        if (!source.contains("grating")) continue;
        const fs::path elsewhere = fs::temp_directory_path();
        const OrderedJson object = gltf_object(source, entry.path().parent_path(), elsewhere);
        const GltfGrating grating = parse_gltf_extension(nlohmann::json::parse(object.dump()), "scene.glb", elsewhere);
        EXPECT_FALSE(grating.has_base);
        const Grating expected = load_material(entry.path()).grating;
        EXPECT_EQ(grating.material.grating.pitch_nm, expected.pitch_nm) << entry.path();
        EXPECT_EQ(grating.material.grating.profile.index(), expected.profile.index()) << entry.path();
    }
}

TEST(GltfObject, NamesOfFilesMoveAndComeBack) {
    const OrderedJson object = OrderedJson::parse(R"({"grating": {"profile": {"type": "table", "file": "t/a b.csv"}},
        "quality": {"illuminant": "lamp.csv", "probes": ["a.json", {"image": "b.hdr"}]}})");
    OrderedJson moved = object;
    move_named_files(moved, "/x/y", "/x/z/w");
    EXPECT_EQ(moved["grating"]["profile"]["file"], "../../y/t/a b.csv");
    EXPECT_EQ(moved["quality"]["illuminant"], "../../y/lamp.csv");
    EXPECT_EQ(moved["quality"]["probes"][0], "../../y/a.json");
    EXPECT_EQ(moved["quality"]["probes"][1]["image"], "../../y/b.hdr");
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
