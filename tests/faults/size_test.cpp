// The smallest and the largest files of users: loaded in memory proportional to the file, or refused by their size.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

using test::Ended;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint64_t kMebibyte = 1 << 20;
#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t kMemoryFactor = 3;  ///< shadow and quarantine
#else
constexpr std::uint64_t kMemoryFactor = 1;
#endif

class SizeFaults : public testing::Test {
 protected:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    test::TemporaryFolder folder_;
};

constexpr std::array<std::uint8_t, 4> kTexel = {0x80, 0x70, 0x60, 0x81};  ///< RGBE of (1, 0.875, 0.75)

/// A probe of one radiance, with run lengths where Radiance has them.
void write_probe(const std::string& path, int width, int height) {
    std::string row;
    if (width < 8 || width > 0x7fff) {
        for (int x = 0; x < width; ++x) row.append(kTexel.begin(), kTexel.end());
    } else {
        row = {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 0xff)};
        for (const std::uint8_t channel : kTexel)
            for (int left = width; left > 0; left -= 127)
                row += {static_cast<char>(128 + std::min(left, 127)), static_cast<char>(channel)};
    }
    std::ofstream file(path, std::ios::binary);
    file << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " << height << " +X " << width << "\n";
    for (int y = 0; y < height; ++y) file << row;
}

/// Rows "l,m,r,g,b" of one band are those of this radiance from everywhere.
void expect_all_light(const std::string& rows) {
    const std::string row = rows.substr(rows.find('\n') + 1);
    std::array<double, 5> values{};
    ASSERT_EQ(
        std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf,%lf", &values[0], &values[1], &values[2], &values[3], &values[4]), 5)
        << rows;
    // The integral of Y_00 over the sphere; the weights of the texels are exact to rounding.
    const double even = 2.0 * std::sqrt(std::numbers::pi);
    EXPECT_NEAR(values[2], even * 1.0, 1e-6);
    EXPECT_NEAR(values[3], even * 0.875, 1e-6);
    EXPECT_NEAR(values[4], even * 0.75, 1e-6);
}

TEST_F(SizeFaults, ProbeOfOneTexelGivesAllItsLight) {
    write_probe(path("one.hdr"), 1, 1);
    for (const char* mapping : {"equirect", "angular"}) {
        const Ended projected = test::run(
            {ROWLAND_TRADE, "project", "--probe", path("one.hdr"), "--probe-mapping", mapping, "--bands", "1"});
        EXPECT_EQ(projected.code, 0) << projected.err;
        expect_all_light(projected.out);
    }
    const Ended shown =
        test::run({ROWLAND_DEMO, "--headless", "--disc", "--width", "64", "--height", "36", "--probe", path("one.hdr"),
                   "--probe-mapping", "angular", "--capture-linear", path("picture.exr")});
    EXPECT_EQ(shown.code, 0) << shown.err;
}

TEST_F(SizeFaults, ProbeOf16kIsLoadedInTheMemoryOfItsTexels) {
    constexpr std::uint64_t kTexels = std::uint64_t{16384} * 8192;
    write_probe(path("large.hdr"), 16384, 8192);
    const Ended projected = test::run({ROWLAND_TRADE, "project", "--probe", path("large.hdr"), "--bands", "1"},
                                      {.limit = std::chrono::seconds(240)});
    EXPECT_EQ(projected.code, 0) << projected.err;
    expect_all_light(projected.out);
    // Three floats per texel, once, and what a program takes anyway (measured: 60 MiB).
    EXPECT_LT(projected.peak_bytes, kMemoryFactor * (kTexels * 12 + 200 * kMebibyte));
}

TEST_F(SizeFaults, ProbeLargerThan16kIsRefusedBeforeItIsRead) {
    write_probe(path("larger.hdr"), 16386, 8193);
    const Ended checked = test::run({ROWLAND_COOK, "check", path("larger.hdr")});
    EXPECT_EQ(checked.code, 2) << checked.err;
    EXPECT_THAT(checked.err, AllOf(HasSubstr("larger.hdr"), HasSubstr("16386"), HasSubstr("expected")));
    EXPECT_LT(checked.peak_bytes, kMemoryFactor * 100 * kMebibyte);
}

template <typename T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A flat GLB of side × side vertices with all its triangles `layers` times, and 32-bit indices. Their number.
std::size_t write_sheet(const std::string& path, std::uint32_t side, int layers) {
    std::string positions;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::array<float, 3> at{static_cast<float>(x) / static_cast<float>(side - 1), 0.0F,
                                          static_cast<float>(y) / static_cast<float>(side - 1)};
            append(positions, at);
        }
    std::string indices;
    for (int layer = 0; layer < layers; ++layer)
        for (std::uint32_t y = 0; y + 1 < side; ++y)
            for (std::uint32_t x = 0; x + 1 < side; ++x) {
                const std::uint32_t at = y * side + x;
                append(indices, std::array{at, at + side, at + 1, at + 1, at + side, at + side + 1});
            }
    const std::size_t count = indices.size() / sizeof(std::uint32_t);
    const nlohmann::json gltf = {{"asset", {{"version", "2.0"}}},
                                 {"scene", 0},
                                 {"scenes", {{{"nodes", {0}}}}},
                                 {"nodes", {{{"mesh", 0}}}},
                                 {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
                                 {"accessors",
                                  {{{"bufferView", 0},
                                    {"componentType", 5126},
                                    {"count", std::size_t{side} * side},
                                    {"type", "VEC3"},
                                    {"min", {0, 0, 0}},
                                    {"max", {1, 0, 1}}},
                                   {{"bufferView", 1}, {"componentType", 5125}, {"count", count}, {"type", "SCALAR"}}}},
                                 {"bufferViews",
                                  {{{"buffer", 0}, {"byteLength", positions.size()}},
                                   {{"buffer", 0}, {"byteOffset", positions.size()}, {"byteLength", indices.size()}}}},
                                 {"buffers", {{{"byteLength", positions.size() + indices.size()}}}}};
    std::string json = gltf.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto size = [](std::size_t bytes) { return static_cast<std::uint32_t>(bytes); };
    std::string header = "glTF";
    append(header, std::array{std::uint32_t{2}, size(28 + json.size() + positions.size() + indices.size()),
                              size(json.size()), std::uint32_t{0x4e4f534a}});
    std::string chunk;
    append(chunk, std::array{size(positions.size() + indices.size()), std::uint32_t{0x004e4942}});
    std::ofstream(path, std::ios::binary) << header << json << chunk << positions << indices;
    return count / 3;
}

TEST_F(SizeFaults, MeshOfTenMillionTrianglesIsLoadedAndDrawn) {
    const std::size_t triangles = write_sheet(path("sheet.glb"), 1600, 2);
    ASSERT_GT(triangles, 10'000'000U);
    const std::uint64_t file = std::filesystem::file_size(path("sheet.glb"));
    const Ended checked = test::run({ROWLAND_COOK, "check", path("sheet.glb")});
    EXPECT_EQ(checked.code, 0) << checked.err;
    // The file, what is made of it (at most the importer's budget) and a copy to derive tangents from.
    EXPECT_LT(checked.peak_bytes, kMemoryFactor * (file + 2 * (512 * kMebibyte)));
    const Ended drawn = test::run({ROWLAND_DEMO, "--headless", "--scene", path("sheet.glb"), "--width", "64",
                                   "--height", "36", "--capture", path("picture.png")},
                                  {.limit = std::chrono::seconds(240)});
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_LT(drawn.peak_bytes, kMemoryFactor * 4096 * kMebibyte);
}

TEST_F(SizeFaults, MeshBeyondTheBudgetIsRefusedByWhatItAsksFor) {
    write_sheet(path("sheet.glb"), 2240, 1);
    const Ended checked = test::run({ROWLAND_COOK, "check", path("sheet.glb")});
    EXPECT_EQ(checked.code, 2) << checked.err;
    EXPECT_THAT(checked.err, AllOf(HasSubstr("sheet.glb: /meshes/0/primitives/0"), HasSubstr("5017600 elements"),
                                   HasSubstr("expected at most 536870912 bytes"), HasSubstr("ROWLAND_SCENE_MEMORY")));
    EXPECT_LT(checked.peak_bytes, kMemoryFactor * (std::filesystem::file_size(path("sheet.glb")) + 512 * kMebibyte));
    const Ended allowed =
        test::run({ROWLAND_COOK, "check", path("sheet.glb")}, {.environment = {{"ROWLAND_SCENE_MEMORY", "1024"}}});
    EXPECT_EQ(allowed.code, 0) << allowed.err;
}

}  // namespace
}  // namespace rowland
