#include "engine/command_line/command_line.h"

#include <gmock/gmock.h>

#include <regex>

#include "tests/support/expect.h"

namespace rowland {
namespace {

struct Parsed {
    bool goes_on = false;
    float number = 0.0F;
};

Parsed parse(const char* option, const char* value) {
    CLI::App app("A program.", "program");
    Parsed parsed;
    app.add_option("--number", parsed.number)->check(finite(-2.5, 4.0));
    const char* const arguments[] = {"program", option, value};
    parsed.goes_on = parse_command_line(app, value == nullptr ? 2 : 3, arguments);
    return parsed;
}

TEST(CommandLine, NumbersWithinTheRangeAreTaken) {
    for (const char* text : {"-2.5", "0", "1e-3", "4"}) {
        EXPECT_TRUE(parse("--number", text).goes_on);
        EXPECT_EQ(parse("--number", text).number, std::stof(text));
    }
}

TEST(CommandLine, AllOtherNumbersAreRefused) {
    for (const char* text : {"nan", "-nan", "NaN", "inf", "-inf", "1e300", "-1e300", "4.001", "-2.6", "", "one", "1 2"})
        EXPECT_THAT(test::message_of([&] { parse("--number", text); }),
                    testing::AllOf(testing::HasSubstr("--number"), testing::HasSubstr("see program --help")))
            << text;
}

TEST(CommandLine, EmptyArgumentsAreRefusedByTheirOption) {
    for (const auto& [option, value] : {std::pair("--number", ""), {"--number=", static_cast<const char*>(nullptr)}})
        EXPECT_EQ(test::message_of([&] { parse(option, value); }),
                  "--number: an empty argument; expected a name or a value; see program --help");
    EXPECT_EQ(test::message_of([&] { parse("", nullptr); }),
              "program: an empty argument; expected a name or a value; see program --help");
}

TEST(CommandLine, VersionSaysFromWhichSourcesAndBy) {
    testing::internal::CaptureStdout();
    EXPECT_FALSE(parse("--version", nullptr).goes_on);
    const std::string version = testing::internal::GetCapturedStdout();
    const std::regex form("program [0-9.]+, commit [0-9a-z-]+, [A-Z].* [0-9.]+ .*\n");
    EXPECT_TRUE(std::regex_match(version, form)) << version;
}

TEST(CommandLine, HelpIsPrintedAndEndsTheProgram) {
    testing::internal::CaptureStdout();
    EXPECT_FALSE(parse("--help", nullptr).goes_on);
    EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("-2.5 to 4"));
}

}  // namespace
}  // namespace rowland
