#include "editor/inspector/ordered_json.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "engine/core/file.h"
#include "tests/support/message_of.h"
#include "tests/support/source_tree.h"

namespace rowland::inspector {
namespace {

TEST(OrderedJson, ShippedMaterialsAreWrittenAsTheyWereRead) {
    int files = 0;
    const std::filesystem::path folder = test::content_path("materials");
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        const std::string text = read_text_file(entry.path(), 1 << 20);
        EXPECT_EQ(format_json(parse_ordered(text, entry.path().string())), text) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 8);
}

TEST(OrderedJson, KeysKeepTheOrderOfTheFile) {
    EXPECT_EQ(format_json(parse_ordered(R"({"z":1,"a":{"y":2,"b":[3,4]}})", "m.json")),
              "{\n  \"z\": 1,\n  \"a\": { \"y\": 2, \"b\": [3, 4] }\n}\n");
}

TEST(OrderedJson, WhatWouldBeTooWideIsBroken) {
    Json wide;
    for (int i = 0; i < 40; ++i) wide["list"].push_back(1000 + i);
    const std::string text = format_json(wide);
    EXPECT_THAT(text, testing::HasSubstr("[\n    1000,\n    1001,"));
    EXPECT_EQ(Json::parse(text), wide);
}

TEST(OrderedJson, HostileTextIsRefusedWithItsPlace) {
    EXPECT_THAT(test::message_of([] { parse_ordered("{\"a\": 1,\n  b}", "m.json"); }),
                testing::AllOf(testing::HasSubstr("m.json"), testing::HasSubstr("line 2")));
    EXPECT_THAT(test::message_of([] { parse_ordered(std::string(20000, '['), "m.json"); }),
                testing::HasSubstr("nested too deep"));
    EXPECT_THAT(test::message_of([] { parse_ordered("{\"a\": \"\xff\"}", "m.json"); }), testing::HasSubstr("m.json"));
}

}  // namespace
}  // namespace rowland::inspector
