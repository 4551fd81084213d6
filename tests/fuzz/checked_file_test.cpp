// Every file of the test data through the program that a user has.

#include <algorithm>
#include <cstdio>

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_under(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Errors are marked; repairs and what is ignored may be told before.
std::size_t error_lines(const std::string& messages) {
    std::size_t count = 0;
    for (std::size_t at = messages.find("error: "); at != std::string::npos; at = messages.find("error: ", at + 1))
        count += at == 0 || messages[at - 1] == '\n' ? 1 : 0;
    return count;
}

void expect_handled(const fs::path& folder) {
    int sane = 0;
    int refused = 0;
    for (const fs::path& file : files_under(folder)) {
        SCOPED_TRACE(file.string());
        const test::Ended checked =
            test::run({ROWLAND_COOK, "check", file.string()}, {.limit = std::chrono::seconds(60)});
        if (checked.code == 0) {
            ++sane;
            EXPECT_EQ(std::count(checked.out.begin(), checked.out.end(), '\n'), 1) << checked.out;
            EXPECT_EQ(error_lines(checked.err), 0U) << checked.err;
        } else {
            ++refused;
            EXPECT_EQ(checked.code, 2) << checked.err;
            EXPECT_EQ(error_lines(checked.err), 1U) << checked.err;
            EXPECT_EQ(std::count(checked.err.begin(), checked.err.end(), '\n'), 1) << checked.err;
            EXPECT_NE(checked.err.find(file.string()), std::string::npos) << checked.err;
        }
    }
    std::printf("%s: %d files, %d sane, %d refused\n", folder.string().c_str(), sane + refused, sane, refused);
    EXPECT_GT(sane + refused, 0);
}

TEST(CheckedFile, OfValidAndMalformedScenesIsSaneOrRefusedInOneLine) {
    ROWLAND_TEST_DATA(folder, "gltf");
    expect_handled(folder);
}
TEST(CheckedFile, OfProbesIsSaneOrRefusedInOneLine) {
    ROWLAND_TEST_DATA(folder, "probes");
    expect_handled(folder);
}
TEST(CheckedFile, OfColourConfigsIsSaneOrRefusedInOneLine) {
    ROWLAND_TEST_DATA(folder, "ocio");
    expect_handled(folder);
}
TEST(CheckedFile, OfTheCorpusIsSaneOrRefusedInOneLine) {
    expect_handled(test::source_path("tests/fuzz/corpus"));
}

}  // namespace
}  // namespace rowland::fuzz
