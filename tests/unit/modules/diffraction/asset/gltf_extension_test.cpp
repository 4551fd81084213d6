#include "modules/diffraction/asset/gltf_extension.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace rowland::diffraction {
namespace {

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

}  // namespace
}  // namespace rowland::diffraction
