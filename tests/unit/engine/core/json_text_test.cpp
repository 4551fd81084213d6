#include "engine/core/json_text.h"

#include <gtest/gtest.h>

#include <string>

namespace rowland {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string after(const std::string& text, const JsonPath& path, const OrderedJson& value) {
    JsonText edited(text);
    edited.set(path, value);
    return edited.text();
}

TEST(JsonText, FindsValuesByKeysAndPositions) {
    const JsonText text(R"({"a" : [1.50, {"b\u002fc":"}\"]\\"}], "d":[ ], "e": null})");
    EXPECT_EQ(text.find({"a", "0"}), "1.50");
    EXPECT_EQ(text.find({"a", "1", "b/c"}), R"("}\"]\\")");
    EXPECT_EQ(text.find({"d"}), "[ ]");
    EXPECT_EQ(text.find({"e"}), "null");
    EXPECT_EQ(text.find({"a", "2"}), std::nullopt);
    EXPECT_EQ(text.find({"a", "0", "x"}), std::nullopt);
    EXPECT_EQ(text.find({"b"}), std::nullopt);
}

TEST(JsonText, ReplacesOneValueAndNothingElse) {
    EXPECT_EQ(after(R"({ "a":1e3,"b" :  2.0 ,"c":[0,1] })", {"b"}, 7), R"({ "a":1e3,"b" :  7 ,"c":[0,1] })");
    EXPECT_EQ(after(R"({"c":[0, 1,2]})", {"c", "1"}, "x"), R"({"c":[0, "x",2]})");
}

TEST(JsonText, AddsInTheLayoutOfTheSurroundings) {
    EXPECT_EQ(after(R"({"a":1})", {"b"}, {{"c", {1, 2}}}), R"({"a":1,"b":{"c":[1,2]}})");
    EXPECT_EQ(after("{\n  \"a\": 1\n}\n", {"b"}, {{"c", {1, 2}}}),
              "{\n  \"a\": 1,\n  \"b\": {\n    \"c\": [1, 2]\n  }\n}\n");
    EXPECT_EQ(after("{\r\n\t\"a\" : {}\r\n}", {"a", "b"}, true), "{\r\n\t\"a\" : {\r\n\t\t\"b\" : true\r\n\t}\r\n}");
    EXPECT_EQ(after("{\n  \"m\": [ { \"a\": 1 }, { \"a\": 2 } ]\n}", {"m", "1", "b"}, {{"c", 3}}),
              "{\n  \"m\": [ { \"a\": 1 }, { \"a\": 2, \"b\": { \"c\": 3 } } ]\n}");
}

TEST(JsonText, MakesTheObjectsAroundAValue) {
    EXPECT_EQ(after("{}", {"a", "b"}, 1), R"({"a": { "b": 1 }})");
    EXPECT_EQ(after("\xEF\xBB\xBF{\"x\":0}", {"a", "b"}, 1), "\xEF\xBB\xBF{\"x\":0,\"a\":{\"b\":1}}");
}

TEST(JsonText, OfAnObjectOnlyWhatDiffersIsWritten) {
    const std::string text = R"({"a":{"same":1.000, "other": 2,"lost":3, "list":[1.0]}})";
    EXPECT_EQ(after(text, {"a"}, {{"same", 1}, {"other", 5}, {"list", {1}}, {"new", "n"}}),
              R"({"a":{"same":1.000, "other": 5,"list":[1.0],"new":"n"}})");
}

TEST(JsonText, RemovingWhatWasAddedGivesTheFirstText) {
    for (const std::string text :
         {R"({"a":{"x":1}})", "{\n  \"a\": {\n    \"x\": 1\n  }\n}\n", R"({ "a" : { "x" : 1 } } )", R"({"a":{}})"}) {
        JsonText edited(text);
        edited.set({"a", "b"}, {{"c", 1}});
        EXPECT_NE(edited.text(), text);
        edited.remove({"a", "b"});
        EXPECT_EQ(edited.text(), text);
    }
}

TEST(JsonText, RemovesTheFirstTheMiddleTheLastAndTheOnly) {
    const auto without = [](const std::string& text, const JsonPath& path) {
        JsonText edited(text);
        edited.remove(path);
        return edited.text();
    };
    EXPECT_EQ(without(R"({"a": 1, "b": 2, "c": 3})", {"a"}), R"({"b": 2, "c": 3})");
    EXPECT_EQ(without(R"({"a": 1, "b": 2, "c": 3})", {"b"}), R"({"a": 1, "c": 3})");
    EXPECT_EQ(without(R"({"a": 1, "b": 2, "c": 3})", {"c"}), R"({"a": 1, "b": 2})");
    EXPECT_EQ(without(R"({"a": [ 1 ]})", {"a", "0"}), R"({"a": []})");
    EXPECT_EQ(without(R"({"a": 1})", {"x", "y"}), R"({"a": 1})");
}

TEST(JsonText, AppendsToArraysAndMakesThem) {
    JsonText text("{\n  \"names\": [\n    \"a\"\n  ]\n}");
    text.append("names", "b");
    text.append("things", {{"n", 1}});
    EXPECT_EQ(text.text(),
              "{\n  \"names\": [\n    \"a\",\n    \"b\"\n  ],\n  \"things\": [\n    {\n      \"n\": 1\n    }\n  ]\n}");
}

}  // namespace
}  // namespace rowland
