#include <gtest/gtest.h>

#include <string>

#include "engine/core/check.h"
#include "engine/core/error.h"

namespace rowland {

namespace {

std::string message(ErrorInfo info) {
    return Error(std::move(info)).what();
}

TEST(Error, MessageNamesFilePlaceFoundExpectedAndRemedyInThisOrder) {
    EXPECT_EQ(message({.file = "cd.json",
                       .location = "/grating/pitch_nm",
                       .found = "-3",
                       .expected = "a number > 0",
                       .remedy = "give the pitch in nm"}),
              "cd.json: /grating/pitch_nm: -3; expected a number > 0; give the pitch in nm");
}

TEST(Error, EmptyFieldsLeaveNoSeparators) {
    EXPECT_EQ(message({.file = "a", .location = {}, .found = "b", .expected = {}, .remedy = {}}), "a: b");
    EXPECT_EQ(message({.file = {}, .location = {}, .found = "b", .expected = {}, .remedy = {}}), "b");
    EXPECT_EQ(message({.file = "a", .location = {}, .found = {}, .expected = {}, .remedy = "c"}), "a; c");
}

TEST(Error, MessageStaysOneLineWhateverTheFieldsHold) {
    EXPECT_EQ(message({.file = "a\nb", .location = {}, .found = "\x1b[2J\t\x7f", .expected = {}, .remedy = "c\r"}),
              "a\\x0ab: \\x1b[2J\\x09\\x7f; c\\x0d");
}

TEST(Error, BytesThatAreNotUtf8SurviveInFileNames) {
    EXPECT_EQ(message({.file = "\xff\xfe.hdr", .location = {}, .found = "x", .expected = {}, .remedy = {}}),
              "\xff\xfe.hdr: x");
}

TEST(Error, OverlongFieldsAreShortenedBetweenCharacters) {
    std::string key(399, 'k');
    EXPECT_EQ(message({.file = {}, .location = {}, .found = key, .expected = {}, .remedy = {}}), key);

    // Two-byte characters after one single byte, so that half of the limit falls inside one.
    std::string long_key = "k";
    for (int i = 0; i < 1000000; ++i) long_key += "\u00e9";
    const std::string shown = message({.file = {}, .location = {}, .found = long_key, .expected = {}, .remedy = {}});
    EXPECT_LT(shown.size(), 420u);
    const std::size_t dots = shown.find("...");
    ASSERT_NE(dots, std::string::npos);
    EXPECT_EQ(shown.substr(dots - 2, 2), "\u00e9");
    EXPECT_EQ(shown.substr(dots + 3, 2), "\u00e9");
}

TEST(CheckDeathTest, FailedComparisonPrintsBothOperands) {
    const int bands = 3;
    EXPECT_DEATH(ROWLAND_CHECK_OP(bands, >=, 5), "error_test.cpp:.*: contract violated: bands >= 5 with 3 and 5");
}

TEST(CheckDeathTest, FailedConditionPrintsItsMessage) {
    EXPECT_DEATH(ROWLAND_CHECK(1 > 2, "one is not above two"), "contract violated: one is not above two");
}

TEST(Check, OperandsAreEvaluatedOnce) {
    int evaluations = 0;
    ROWLAND_CHECK_OP(++evaluations, ==, 1);
    ROWLAND_CHECK(++evaluations == 2, "evaluated twice");
    EXPECT_EQ(evaluations, 2);
}

}  // namespace

}  // namespace rowland
