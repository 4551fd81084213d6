// The shipped sources through the cooker itself.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

std::vector<std::byte> cook(const std::string& source, const std::filesystem::path& output, int threads) {
    const test::Ended cooked = test::run(
        {ROWLAND_COOK, "cook", test::content_path(source), "-o", output, "--threads", std::to_string(threads)});
    EXPECT_EQ(cooked.code, 0) << cooked.err;
    return read_file(output, std::uint64_t{1} << 30);
}

void expect_same_bytes(const std::string& source) {
    const test::TemporaryFolder folder;
    const std::vector<std::byte> first = cook(source, folder.path() / "first", 1);
    EXPECT_GT(first.size(), 1000U);
    EXPECT_TRUE(first == cook(source, folder.path() / "again", 1)) << source << " cooked twice";
    EXPECT_TRUE(first == cook(source, folder.path() / "threads", 2)) << source << " with two threads";
}

TEST(CookedContent, MaterialHasTheSameBytesEveryTime) {
    expect_same_bytes("materials/cd_paper.json");
}
TEST(CookedContent, StudioProbeHasTheSameBytesEveryTime) {
    expect_same_bytes("probes/studio.json");
}
TEST(CookedContent, ClearSkyProbeHasTheSameBytesEveryTime) {
    expect_same_bytes("probes/clear_sky.json");
}
TEST(CookedContent, MeshHasTheSameBytesEveryTime) {
    expect_same_bytes("meshes/cd.json");
}

}  // namespace
}  // namespace rowland
