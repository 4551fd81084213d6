// `./rowland gpu` as a user runs it, at tiny sizes where the processor draws.
#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::gpu_report {
namespace {

const std::filesystem::path& script() {
    static const std::filesystem::path path = ROWLAND_SCRIPT;
    return path;
}

class GpuCommand : public testing::Test {
 protected:
    void SetUp() override {
        const std::filesystem::path build = ROWLAND_BUILD_FOLDER;
        if (build.parent_path() != script().parent_path() / "build")
            GTEST_SKIP() << "the script knows build folders in build/ alone";
        surroundings_.environment = {{"ROWLAND_PRESET", build.filename().string()},
                                     {"ROWLAND_SKIP_INSTALL", "1"},
                                     {"GTEST_FILTER", "Buffer*:Arc.*"}};
    }

    test::Surroundings surroundings_{.limit = std::chrono::minutes(20)};
};

// One test, as two would build in one folder at the same time.
TEST_F(GpuCommand, WritesAReportAndWithoutTheOptionRefusesASoftwareRenderer) {
    const test::Ended ended = test::run({script(), "gpu", "--software"}, surroundings_);
    EXPECT_EQ(ended.code, 0) << ended.err;
    const std::string text = read_text_file(script().parent_path() / "build/gpu-software/report.md", 1 << 20);
    for (const char* part : {"# Rowland on ", "| test_gpu |", "| test_gpu_diffraction |", "| opaque |", "| arc |"})
        EXPECT_THAT(text, testing::HasSubstr(part));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("ended without results")));

    if (text.find("llvmpipe") == std::string::npos) return;  // a GPU
    const test::Ended refused = test::run({script(), "gpu"}, surroundings_);
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, testing::HasSubstr("--software"));
}

TEST_F(GpuCommand, RefusesAnotherOption) {
    const test::Ended ended = test::run({script(), "gpu", "--fast"}, surroundings_);
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, testing::HasSubstr("--fast"));
}

TEST(Script, ABuildFolderOfAnotherPlaceIsRefusedWithTheRemedy) {
    const test::TemporaryFolder folder;
    std::filesystem::copy_file(script(), folder.path() / "rowland");
    write_file_atomic(folder.path() / "build/release/CMakeCache.txt",
                      std::string_view("CMAKE_HOME_DIRECTORY:INTERNAL=/nowhere\n"));
    const test::Ended ended =
        test::run({folder.path() / "rowland", "cook"},
                  {.environment = {{"ROWLAND_PRESET", "release"}, {"ROWLAND_SKIP_INSTALL", "1"}}});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, testing::AllOf(testing::HasSubstr("/nowhere"), testing::HasSubstr("remove")));
}

}  // namespace
}  // namespace rowland::gpu_report
