// The comments of what is installed, as Doxygen reads them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/program.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace rowland {
namespace {

TEST(ApiReference, IsMadeWithoutAWarning) {
    if (test::run({"/bin/sh", "-c", "command -v doxygen"}).code != 0) GTEST_SKIP() << "no doxygen";
    const test::TemporaryFolder folder;
    const std::string command = "cd '" + test::source_path("").string() +
                                "' && (cat content/api/Doxyfile; echo 'OUTPUT_DIRECTORY = " + folder.path().string() +
                                "') | doxygen -";
    const test::Ended result = test::run({"/bin/sh", "-c", command});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "html" / "index.html"));
}

}  // namespace
}  // namespace rowland
