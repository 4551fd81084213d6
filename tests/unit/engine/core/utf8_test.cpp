#include "engine/core/utf8.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/message_of.h"

namespace rowland {
namespace {

TEST(Utf8, WhatIsValidStaysAndTheRestIsReplaced) {
    for (const char* text : {"", "cd", "Größe \"1\"\\n\t", "\xf0\x9f\x92\xbf"}) EXPECT_EQ(valid_utf8(text), text);
    EXPECT_EQ(valid_utf8("b\xff.json"), "b\xef\xbf\xbd.json");
    EXPECT_EQ(valid_utf8("cut \xf0\x9f"), "cut \xef\xbf\xbd");
    EXPECT_EQ(valid_utf8(std::string_view("a\0b", 3)), std::string("a\0b", 3));
}

TEST(Utf8, APathThatIsNoTextIsRefusedWithTheRemedy) {
    EXPECT_EQ(require_utf8("Größe.json", "rename it"), "Größe.json");
    EXPECT_THAT(test::message_of([] { require_utf8("b\xff.json", "rename it"); }), testing::HasSubstr("rename it"));
}

}  // namespace
}  // namespace rowland
