#include "engine/core/json_reader.h"

#include <gmock/gmock.h>

#include "tests/support/expect.h"

namespace rowland {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

using test::message_of;

std::string parse_message(std::string_view text) {
    return message_of([&] { parse_json(text, "a.json"); });
}

/// The message of what `read` does with the object in `text`.
template <typename Read>
std::string read_message(std::string_view text, const Read& read) {
    const nlohmann::json value = parse_json(text, "a.json");
    JsonReader reader(value, "a.json");
    return message_of([&] { read(reader); });
}

std::string nested(int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
}

TEST(ParseJson, SyntaxErrorNamesLineAndColumn) {
    EXPECT_THAT(parse_message("{\n  \"a\": 1,\n  \"b\" 2\n}"), StartsWith("a.json: line 3, column 7: "));
    EXPECT_THAT(parse_message(""), StartsWith("a.json: line 1, column 1: "));
    EXPECT_THAT(parse_message("{} x"), StartsWith("a.json: line 1, column 4: "));
    EXPECT_THAT(parse_message("{}["), HasSubstr("; expected valid JSON"));
}

TEST(ParseJson, ANullCharacterIsNotTheEnd) {
    for (const std::string_view text : {std::string_view("{}\0", 3), std::string_view("{}\0x", 4)})
        EXPECT_EQ(parse_message(std::string(text)), "a.json: byte 2: a null character; expected valid JSON");
}

TEST(ParseJson, NestingIsLimitedTo64) {
    EXPECT_EQ(parse_json(nested(64), "a.json").size(), 1u);
    EXPECT_EQ(parse_message(nested(65)), "a.json: byte 64: JSON nested too deep; expected at most 64 levels");
    EXPECT_THAT(parse_message(std::string(1'000'000, '[')), HasSubstr("nested too deep"));
    std::string objects;
    for (int i = 0; i < 65; ++i) objects += "{\"a\":";
    EXPECT_THAT(parse_message(objects), HasSubstr("nested too deep"));
}

TEST(ParseJson, BracketsInStringsAreNoNesting) {
    const std::string text = "[\"" + std::string(100, '[') + "\\\"" + std::string(100, '{') + "\"]";
    EXPECT_EQ(parse_json(text, "a.json").at(0).get<std::string>().size(), 201u);
}

TEST(ParseJson, ClosingBracketsDoNotBuyDepth) {
    // Each "]" is one level too many, which a parser refuses at once; the count must not go below zero and allow more.
    EXPECT_THROW(parse_json(std::string(100, ']') + nested(100), "a.json"), Error);
}

TEST(ParseJson, RepeatedKeysAreRefusedWithTheirPointer) {
    EXPECT_EQ(parse_message(R"({"a": 1, "b": 2, "a": 1})"),
              "a.json: /a: a repeated key; expected each key once; remove one of the two");
    EXPECT_THAT(parse_message(R"({"list": [0, [], {"x/y": {"k": 1, "k": {}}}]})"),
                StartsWith("a.json: /list/2/x~1y/k: "));
    EXPECT_THAT(parse_message(R"([{"a": {}}, {"a": {}, "\u0061": {}}])"), StartsWith("a.json: /1/a: "));
    EXPECT_EQ(parse_json(R"([{"a": {"a": ":"}}, {"a": "\":\""}])", "a.json").size(), 2U);
}

TEST(ParseJson, InvalidUtf8IsRefused) {
    EXPECT_THAT(parse_message("{\"a\": \"\xff\"}"), HasSubstr("UTF-8"));
}

TEST(ParseJson, NumberBeyondDoubleIsRefusedAsInput) {
    EXPECT_EQ(parse_message("{\"a\": 1e999}"),
              "a.json: number overflow parsing '1e999'; expected numbers that fit a double");
}

TEST(JsonReader, ReadsEveryKind) {
    const nlohmann::json value = parse_json(
        R"({"n": 1.5, "i": -3, "t": "x", "b": true, "v": [1, 2], "c": "slit", "o": {"k": 1}, "l": [{"k": 2}], "r": null})",
        "a.json");
    JsonReader reader(value, "a.json");
    EXPECT_EQ(reader.number("n", {}), 1.5);
    EXPECT_EQ(reader.integer("i", -3, 0), -3);
    EXPECT_EQ(reader.text("t"), "x");
    EXPECT_TRUE(reader.boolean_or("b", false));
    EXPECT_EQ(reader.numbers("v", 2, {}), (std::vector{1.0, 2.0}));
    EXPECT_EQ(reader.choice("c", {"slit", "blazed"}), "slit");
    EXPECT_EQ(reader.choice<char>("c", {{"blazed", 'b'}, {"slit", 's'}}), 's');
    EXPECT_EQ(reader.text_or("t", "y"), "x");
    EXPECT_EQ(reader.text_or("none", "y"), "y");
    EXPECT_EQ(reader.object_if_there("o")->integer("k", 0, 9), 1);
    EXPECT_FALSE(reader.object_if_there("none"));
    EXPECT_TRUE(reader.objects_if_there("none").empty());
    EXPECT_EQ(reader.object("o").integer("k", 0, 9), 1);
    EXPECT_EQ(reader.objects("l").at(0).integer("k", 0, 9), 2);
    EXPECT_TRUE(reader.raw("r").is_null());
    reader.finish();
}

TEST(JsonReader, AbsentKeysGiveTheFallback) {
    const nlohmann::json value = parse_json("{}", "a.json");
    JsonReader reader(value, "a.json");
    EXPECT_EQ(reader.number_or("n", 2.5, {}), 2.5);
    EXPECT_EQ(reader.integer_or("i", 7, 0, 9), 7);
    EXPECT_TRUE(reader.boolean_or("b", true));
    EXPECT_EQ(reader.choice_or("c", "slit", {"slit"}), "slit");
    EXPECT_FALSE(reader.has("x"));
}

TEST(JsonReader, UnknownKeyIsRefusedNamingTheNearest) {
    const auto finish = [](JsonReader& reader) {
        reader.number_or("pitch_nm", 1, {});
        reader.integer_or("grooves", 1, 0, 9);
        reader.finish();
    };
    EXPECT_EQ(read_message(R"({"pitch_mn": 1600})", finish),
              "a.json: /pitch_mn: unknown key; expected one of grooves, pitch_nm; is \"pitch_nm\" meant?");
    EXPECT_THAT(read_message(R"({"entirely_else": 1})", finish), HasSubstr("; remove it"));
    EXPECT_THAT(read_message(R"({"a/b~c": 1})", finish), StartsWith("a.json: /a~1b~0c: "));
}

TEST(JsonReader, MissingKeyIsRefusedNamingItsMisspelling) {
    const auto read = [](JsonReader& reader) { reader.number("pitch_nm", {}); };
    EXPECT_EQ(read_message(R"({"pich_nm": 1})", read),
              "a.json: /pitch_nm: missing; expected a value; is \"pich_nm\" meant to be \"pitch_nm\"?");
    EXPECT_EQ(read_message("{}", read), "a.json: /pitch_nm: missing; expected a value; add it");
}

TEST(JsonReader, NumberRangesHoldAndAreShownAsIntervals) {
    const auto number = [](NumberRange range) { return [range](JsonReader& reader) { reader.number("a", range); }; };
    const NumberRange positive = {.minimum = 0, .exclusive_minimum = true};
    const NumberRange share = {.minimum = 0, .maximum = 1, .exclusive_maximum = true};
    EXPECT_EQ(read_message(R"({"a": 0})", number(positive)), "a.json: /a: 0; expected a number > 0");
    EXPECT_EQ(read_message(R"({"a": 1})", number(share)), "a.json: /a: 1; expected a number in [0, 1)");
    EXPECT_EQ(read_message(R"({"a": 3})", number({.maximum = 2})), "a.json: /a: 3; expected a number <= 2");
    EXPECT_EQ(read_message(R"({"a": "3"})", number({})), "a.json: /a: \"3\"; expected a number");
    const nlohmann::json value = parse_json(R"({"a": 0})", "a.json");
    EXPECT_EQ(JsonReader(value, "a.json").number("a", share), 0.0);
}

TEST(JsonReader, IntegersAreWholeAndInRange) {
    const auto integer = [](JsonReader& reader) { reader.integer("a", -5, 5); };
    for (const char* text : {"6", "-6", "1.5", "\"1\"", "18446744073709551615", "1e3", "true", "null"})
        EXPECT_THAT(read_message(std::string("{\"a\": ") + text + "}", integer),
                    HasSubstr("expected a whole number in [-5, 5]"))
            << text;
}

TEST(JsonReader, ArraysHaveTheirExactLengthAndNumbersInRange) {
    const auto numbers = [](JsonReader& reader) { reader.numbers("a", 3, {.minimum = 0}); };
    EXPECT_THAT(read_message(R"({"a": [1, 2]})", numbers), HasSubstr("/a: [1,2]; expected 3 numbers"));
    EXPECT_THAT(read_message(R"({"a": [1, 2, -1]})", numbers), HasSubstr("/a/2: -1; expected a number >= 0"));
    EXPECT_THAT(read_message(R"({"a": 1})", numbers), HasSubstr("expected 3 numbers"));
}

TEST(JsonReader, ChoicesNameTheNearest) {
    EXPECT_EQ(read_message(R"({"a": "lamelar"})",
                           [](JsonReader& reader) {
                               reader.choice("a", {"slit", "lamellar", "blazed"});
                           }),
              "a.json: /a: \"lamelar\"; expected one of slit, lamellar, blazed; is \"lamellar\" meant?");
}

TEST(JsonReader, PlacesInsideObjectsAndArraysAreFullPointers) {
    EXPECT_THAT(read_message(R"({"a": {"b": "x"}})", [](JsonReader& r) { r.object("a").number("b", {}); }),
                StartsWith("a.json: /a/b: "));
    EXPECT_THAT(read_message(R"({"a": [{"b": 1}, {"b": "x"}]})",
                             [](JsonReader& r) {
                                 for (JsonReader& element : r.objects("a")) element.number("b", {});
                             }),
                StartsWith("a.json: /a/1/b: "));
    EXPECT_EQ(read_message(R"({"a": 3})", [](JsonReader& r) { r.object("a"); }), "a.json: /a: 3; expected an object");
    EXPECT_EQ(message_of([] { JsonReader(nlohmann::json(3), "a.json"); }), "a.json: /: 3; expected an object");
}

TEST(JsonReader, HugeValuesAreShortenedInMessages) {
    const std::string text = "{\"a\": \"" + std::string(100'000, 'x') + "\"}";
    EXPECT_LT(read_message(text, [](JsonReader& reader) { reader.number("a", {}); }).size(), 100u);
}

TEST(NearestWord, OnlySlipsOfTheFingersAreNear) {
    EXPECT_EQ(nearest_word("blased", {"slit", "blazed"}), "blazed");
    EXPECT_EQ(nearest_word("sinusiodal", {"slit", "sinusoidal"}), "sinusoidal");
    EXPECT_EQ(nearest_word("quantum", {"slit", "blazed"}), std::nullopt);
    EXPECT_EQ(nearest_word("slit", {}), std::nullopt);
}

TEST(NearestWord, MegabyteWordsCostNothing) {
    // Comparing these letter by letter would take 10^14 steps.
    std::string word = "x";
    while (word.size() < 10'000'000) word += word;
    EXPECT_EQ(nearest_word(word, {word.substr(0, word.size() / 2), "slit"}), std::nullopt);
}

}  // namespace
}  // namespace rowland
