#include "editor/cooker/cooker_program.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "tests/support/environment.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::editor {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class CookerProgramTest : public testing::Test {
 protected:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    std::string write(const std::string& name, std::string_view text) const {
        write_file_atomic(path(name), text);
        return path(name);
    }

    static test::Ended run(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), ROWLAND_TEST_COOKER);
        return test::run(arguments);
    }

    test::TemporaryFolder folder_;
};

std::ptrdiff_t lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

TEST_F(CookerProgramTest, CooksSilentlyWithDepfile) {
    const auto source = write("a.tiles", "size 10");
    const auto result =
        run({"cook", source, "-o", path("out/a.cooked"), "--depfile", path("out/a.d"), "--threads", "1"});
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out + result.err, "");
    EXPECT_TRUE(std::filesystem::exists(path("out/a.cooked")));
    EXPECT_THAT(read_text_file(path("out/a.d"), 1000), HasSubstr("a.tiles"));
}

TEST_F(CookerProgramTest, RefusedSourceIsCodeTwo) {
    const auto result = run({"cook", write("a.tiles", "refuse"), "-o", path("a.cooked")});
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "error: " + path("a.tiles") + ": refuse; expected size, include\n");
    EXPECT_FALSE(std::filesystem::exists(path("a.cooked")));
}

TEST_F(CookerProgramTest, SourceThatChangesWhileCookingIsCodeOne) {
    EXPECT_EQ(run({"cook", write("a.tiles", "change a.tiles"), "-o", path("a.cooked")}).code, 1);
}

TEST_F(CookerProgramTest, CheckPrintsALineForEachSaneFile) {
    const auto a = write("a.tiles", "size 1");
    const auto b = write("b.notes", "x");
    const auto result = run({"check", a, b});
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out, a + ": tiles source\n" + b + ": notes source\n");
    EXPECT_EQ(result.err, "");
}

TEST_F(CookerProgramTest, CheckGoesOnAfterRefusals) {
    const auto bad = write("a.tiles", "refuse");
    const auto crash = write("b.tiles", "crash");
    const auto odd_name = write(test::has_posix_files() ? "\xff\n.txt" : "\xc3\xbf.txt", "x");
    const auto sane = write("c.tiles", "size 1");
    std::vector<std::string> arguments{"check", bad, crash, path("missing"), odd_name, folder_.path().string(), sane};
    if (test::make_pipe(path("pipe.tiles"))) arguments.push_back(path("pipe.tiles"));
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.out, sane + ": tiles source\n");
    EXPECT_EQ(lines(result.err), static_cast<std::ptrdiff_t>(arguments.size()) - 2) << result.err;
    EXPECT_THAT(result.err, StartsWith("error: " + bad + ": refuse"));
}

TEST_F(CookerProgramTest, CheckTakesNamesThatLookLikeOptionsAfterTwoDashes) {
    EXPECT_THAT(run({"check", "--", "-x.notes"}).err, HasSubstr("-x.notes: cannot be opened"));
}

TEST_F(CookerProgramTest, InfoPrintsWhatAnAssetHolds) {
    ASSERT_EQ(run({"cook", write("a.tiles", "size 7"), "-o", path("a.cooked")}).code, 0);
    const auto result = run({"info", path("a.cooked")});
    EXPECT_EQ(result.code, 0);
    EXPECT_THAT(result.out, StartsWith("type: tiles\nversion: 2\ncontent hash: "));
    EXPECT_THAT(result.out, testing::EndsWith("\npayload: 7 bytes\ntiles: 7\n"));
    EXPECT_EQ(run({"info", path("a.tiles")}).code, 2);
}

TEST_F(CookerProgramTest, WrongUsageIsCodeTwoOnStandardError) {
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {"bake"},
        {"cook", "a.tiles"},
        {"cook", "-o", "x"},
        {"check"},
        {"info", "a", "b"},
        {"cook", "a", "-o", "b", "--threads", "-1"},
        {"check", "--fast", "x"},
    };
    for (const auto& arguments : wrong) {
        const auto result = run(arguments);
        EXPECT_EQ(result.code, 2) << testing::PrintToString(arguments);
        EXPECT_EQ(result.out, "") << testing::PrintToString(arguments);
        const std::regex form("error: rowland-cook[^\n]+; see rowland-cook[^\n]*\n");
        EXPECT_TRUE(std::regex_match(result.err, form)) << testing::PrintToString(arguments) << result.err;
    }
}

TEST_F(CookerProgramTest, HelpOfEveryCommandShowsAnExample) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"cook", "--help"}, {"check", "--help"}, {"info", "--help"}}) {
        const auto result = run(arguments);
        EXPECT_EQ(result.code, 0);
        EXPECT_THAT(result.out, HasSubstr("Example: rowland-cook " + (arguments.size() == 2 ? arguments[0] : "")));
    }
}

TEST_F(CookerProgramTest, VersionIsPrinted) {
    const auto result = run({"--version"});
    EXPECT_EQ(result.code, 0);
    const std::regex form("rowland-cook [0-9]+\\.[0-9]+\\.[0-9]+, commit [0-9a-z-]+, [A-Z].*\n");
    EXPECT_TRUE(std::regex_match(result.out, form)) << result.out;
}

}  // namespace
}  // namespace rowland::editor
