// Also what the build makes only when asked, as the demo's three rooms.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace rowland::test {
namespace {

/// CMake replaces a target by its file where it is the first word of a command, and not behind `cmake -E env`.
TEST(BuildRules, RunTheirOwnProgramsByPath) {
    std::ifstream file(ROWLAND_BUILD_RULES);
    if (!file) GTEST_SKIP() << "not built by Ninja";
    const std::regex bare(R"(^ *COMMAND = .*[ "]rowland-[a-z]+ )");
    int commands = 0;
    for (std::string line; std::getline(file, line);) {
        if (line.find("bin/rowland-cook") != std::string::npos) ++commands;
        EXPECT_FALSE(std::regex_search(line, bare)) << line;
    }
    EXPECT_GT(commands, 0);
}

}  // namespace
}  // namespace rowland::test
