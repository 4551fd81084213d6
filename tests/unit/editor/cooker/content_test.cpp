// The shipped sources through the cooker itself.

#include <nlohmann/json.hpp>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

std::vector<std::byte> cook(const std::filesystem::path& source, const std::filesystem::path& output, int threads) {
    const test::Ended cooked =
        test::run({ROWLAND_COOK, "cook", source.string(), "-o", output.string(), "--threads", std::to_string(threads)});
    EXPECT_EQ(cooked.code, 0) << cooked.err;
    return read_file(output, std::uint64_t{1} << 30);
}

void expect_same_bytes(const std::filesystem::path& source) {
    const test::TemporaryFolder folder;
    const std::vector<std::byte> first = cook(source, folder.path() / "first", 1);
    EXPECT_GT(first.size(), 1000U);
    EXPECT_TRUE(first == cook(source, folder.path() / "again", 2)) << source << " cooked again, with two threads";
}

/// A shipped recipe of a probe, of fewer texels.
void expect_same_bytes_of_probe(const std::string& recipe) {
    const test::TemporaryFolder folder;
    nlohmann::json json = nlohmann::json::parse(read_text_file(test::content_path(recipe), 1 << 20));
    json["probe"]["width"] = 64;
    write_file_atomic(folder.path() / "probe.json", json.dump());
    expect_same_bytes(folder.path() / "probe.json");
}

TEST(CookedContent, MaterialHasTheSameBytesEveryTime) {
    expect_same_bytes(test::content_path("materials/cd_paper.json"));
}
TEST(CookedContent, ProbesHaveTheSameBytesEveryTime) {
    expect_same_bytes_of_probe("probes/studio.json");
    expect_same_bytes_of_probe("probes/clear_sky.json");
}
TEST(CookedContent, MeshHasTheSameBytesEveryTime) {
    expect_same_bytes(test::content_path("meshes/cd.json"));
}

}  // namespace
}  // namespace rowland
