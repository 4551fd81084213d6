// Every file of the test data through the program that a user has.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace rowland::fuzz {
namespace {

namespace fs = std::filesystem;

struct Check {
    int exit_code = -1;  ///< −1: ended by a signal
    std::string output;
    std::string messages;
};

Check check(const fs::path& file, const fs::path& folder) {
    const std::string out = (folder / "out").string();
    const std::string err = (folder / "err").string();
    const std::string command =
        std::string("timeout -s KILL 60 '") + ROWLAND_COOK + "' check '" + file.string() + "' >" + out + " 2>" + err;
    const int status = std::system(command.c_str());
    constexpr std::uint64_t kLongest = 1 << 20;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text_file(out, kLongest), read_text_file(err, kLongest)};
}

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
    const test::TemporaryFolder results;
    int sane = 0;
    int refused = 0;
    for (const fs::path& file : files_under(folder)) {
        SCOPED_TRACE(file.string());
        const Check checked = check(file, results.path());
        if (checked.exit_code == 0) {
            ++sane;
            EXPECT_EQ(std::count(checked.output.begin(), checked.output.end(), '\n'), 1) << checked.output;
            EXPECT_EQ(error_lines(checked.messages), 0U) << checked.messages;
        } else {
            ++refused;
            EXPECT_EQ(checked.exit_code, 2) << checked.messages;
            EXPECT_EQ(error_lines(checked.messages), 1U) << checked.messages;
            EXPECT_EQ(std::count(checked.messages.begin(), checked.messages.end(), '\n'), 1) << checked.messages;
            EXPECT_NE(checked.messages.find(file.string()), std::string::npos) << checked.messages;
        }
    }
    std::printf("%s: %d files, %d sane, %d refused\n", folder.c_str(), sane + refused, sane, refused);
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
    expect_handled(ROWLAND_CORPUS_FOLDER);
}

}  // namespace
}  // namespace rowland::fuzz
