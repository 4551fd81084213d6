#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "engine/asset/container.h"
#include "engine/core/file.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/light_probe.h"
#include "tests/support/files.h"
#include "tests/support/folder_test.h"
#include "tests/support/program.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const glm::dvec3 kHalf(3.0, 1.5, 2.0);  ///< of the room
const glm::dvec3 kProbe(1.0, -0.4, 0.5);

/// Of the wall toward which an axis points.
glm::dvec3 colour_of(int axis, bool positive) {
    glm::dvec3 colour(0.1, 0.2, 0.3);
    colour[axis] = positive ? 0.9 : 0.6;
    return colour;
}

/// The wall that a ray from the probe meets.
glm::dvec3 seen(const glm::dvec3& direction) {
    const glm::dvec3 steps = (kHalf * glm::sign(direction) - kProbe) / direction;
    const int axis = steps.x < steps.y ? (steps.x < steps.z ? 0 : 2) : (steps.y < steps.z ? 1 : 2);
    return colour_of(axis, direction[axis] > 0.0);
}

/// A room of six unlit walls that face inward, with a probe in it, and one outside.
json room() {
    json file = {{"asset", {{"version", "2.0"}}},
                 {"extensionsUsed", {"ROWLAND_light_probe", "KHR_materials_unlit"}},
                 {"nodes", json::array()},
                 {"meshes", json::array()},
                 {"materials", json::array()}};
    for (int axis = 0; axis < 3; ++axis)
        for (const bool positive : {false, true}) {
            scene::Mesh wall;
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            for (const auto& [along_u, along_v] :
                 {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
                glm::vec3 corner(kHalf);
                corner[axis] *= positive ? 1.0F : -1.0F;
                corner[u] *= static_cast<float>(along_u);
                corner[v] *= static_cast<float>(along_v);
                wall.positions.push_back(corner);
                glm::vec3 normal(0.0F);
                normal[axis] = positive ? -1.0F : 1.0F;
                wall.normals.push_back(normal);
                glm::vec4 tangent(0.0F, 0.0F, 0.0F, 1.0F);
                tangent[u] = 1.0F;
                wall.tangents.push_back(tangent);
                wall.uvs.emplace_back(0.0F);
            }
            wall.indices = {0, 1, 2, 0, 2, 3};
            const glm::dvec3 colour = colour_of(axis, positive);
            file["materials"].push_back(
                {{"pbrMetallicRoughness", {{"baseColorFactor", {colour.r, colour.g, colour.b, 1.0}}}},
                 {"doubleSided", true},
                 {"extensions", {{"KHR_materials_unlit", json::object()}}}});
            json primitive = scene::test::primitive_of(file, wall);
            primitive["material"] = file["materials"].size() - 1;
            file["meshes"].push_back({{"primitives", {primitive}}});
            file["nodes"].push_back({{"mesh", file["meshes"].size() - 1}});
        }
    const auto add_probe = [&](const char* name, const glm::dvec3& at, const char* probe) {
        file["nodes"].push_back({{"name", name},
                                 {"translation", {at.x, at.y, at.z}},
                                 {"extensions", {{"ROWLAND_light_probe", {{"size_m", {6, 3, 4}}, {"probe", probe}}}}}});
    };
    add_probe("inside", kProbe, "inside.probe");
    add_probe("outside", {20.0, 0.0, 0.0}, "outside.probe");
    return file;
}

class Capture : public test::FolderTest {
 protected:
    Capture() { write("room.gltf", room().dump()); }
    test::Ended capture(const test::Command& more) {
        test::Command command{ROWLAND_COOK, "capture", path("room.gltf").string(), "--probe",
                              test::content_path("probes/clear_sky.json").string()};
        command.insert(command.end(), more.begin(), more.end());
        return test::run(command, {.environment = {{"XDG_CACHE_HOME", path("cache").string()}}});
    }
};

TEST_F(Capture, AProbeHoldsTheWallsThatAreSeenFromIt) {
    const test::Ended ended = capture({"--face", "32", "--only", "inside"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(path("outside.probe")));
    const std::vector<std::byte> bytes = read_file(path("inside.probe"), 1 << 26);
    const asset::CookedAsset cooked = asset::unpack(bytes, "inside.probe");
    const lighting::LightProbe probe = lighting::deserialise(cooked.payload, "inside.probe");
    // The mean radiance, and that of single directions away from the edges.
    glm::dvec3 expected(0.0);
    constexpr int kRows = 200;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < 2 * kRows; ++column) {
            const double z = -1.0 + 2.0 * (row + 0.5) / kRows;
            const double azimuth = std::numbers::pi * (column + 0.5) / kRows;
            const double r = std::sqrt(1.0 - z * z);
            expected += seen({r * std::cos(azimuth), r * std::sin(azimuth), z}) / (2.0 * kRows * kRows);
        }
    const glm::dvec3 mean = probe.sh.coefficients[0] / (2.0 * std::sqrt(std::numbers::pi));
    EXPECT_LT(glm::length(mean - expected), 0.01) << mean.r << " for " << expected.r;
    const lighting::CubeLayout& layout = probe.environment.layout;
    int wrong = 0;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < layout.face_size; ++row)
            for (int column = 0; column < layout.face_size; ++column) {
                const std::size_t texel = 3 * layout.index(0, face, column, row);
                glm::dvec3 radiance;
                for (std::size_t c = 0; c < 3; ++c)
                    radiance[static_cast<int>(c)] = static_cast<double>(
                        glm::unpackHalf1x16(probe.environment.halves[texel + c]) * probe.environment.scale);
                const glm::dvec3 direction = lighting::cube_direction(
                    face, (2.0 * column + 1.0) / layout.face_size - 1.0, (2.0 * row + 1.0) / layout.face_size - 1.0);
                wrong += glm::length(radiance - seen(direction)) > 0.05 ? 1 : 0;
            }
    EXPECT_LT(wrong, 6 * layout.face_size * layout.face_size / 6);  // along the edges
    // Twice the same, and cooked into the scene.
    ASSERT_EQ(capture({"--face", "32", "--only", "inside"}).code, 0);
    EXPECT_EQ(read_file(path("inside.probe"), 1 << 26), bytes);
    ASSERT_EQ(test::run({ROWLAND_COOK, "cook", path("room.gltf").string(), "-o", path("room.scene").string()}).code, 0);
    const test::Ended info = test::run({ROWLAND_COOK, "info", path("room.scene").string()});
    EXPECT_THAT(info.out, HasSubstr("probe: \"inside\"\nfile: inside.probe\nsize: 6 3 4\nfade: 1\n"));
    EXPECT_THAT(info.out, HasSubstr("file: outside.probe\nsize: 6 3 4\nfade: 1\nbytes: 0\n"));
}

TEST_F(Capture, RefusesWhatItCannotCapture) {
    const auto expect_refused = [&](const test::Command& more, const char* message) {
        const test::Ended ended = capture(more);
        EXPECT_EQ(ended.code, 2);
        EXPECT_THAT(ended.err, HasSubstr(message));
    };
    expect_refused({"--only", "nowhere"}, "\"nowhere\"; expected one of \"inside\", \"outside\"");
    expect_refused({"--face", "31"}, "--face");
    json same = room();
    same["nodes"].back()["extensions"]["ROWLAND_light_probe"]["probe"] = "inside.probe";
    write("room.gltf", same.dump());
    expect_refused({}, "the file inside.probe for \"inside\" and \"outside\"");
    json none = room();
    none["nodes"].erase(7);
    none["nodes"].erase(6);
    write("room.gltf", none.dump());
    expect_refused({}, "no node with ROWLAND_light_probe");
    write("room.gltf", "{}");
    expect_refused({}, "room.gltf");
    EXPECT_FALSE(std::filesystem::exists(path("inside.probe")));
}

}  // namespace
}  // namespace rowland
