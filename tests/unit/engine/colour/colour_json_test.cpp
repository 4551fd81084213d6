#include "engine/colour/colour_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/support/message_of.h"

namespace rowland::colour {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The message of what `read` refuses in this text.
std::string refusal(const std::string& text, const std::function<void(JsonReader&)>& read) {
    const nlohmann::json json = parse_json(text, "m.json");
    JsonReader reader(json, "m.json");
    return test::message_of([&] { read(reader); });
}

TEST(ColourJson, ReadsEveryMetal) {
    for (const Metal metal : {Metal::Al, Metal::Ag, Metal::Au, Metal::Cu}) {
        const nlohmann::json json = {{"metal", metal_name(metal)}};
        JsonReader reader(json, "m.json");
        EXPECT_EQ(read_metal(reader), metal);
        EXPECT_NO_THROW(reader.finish());
    }
}

TEST(ColourJson, UnknownMetalsListTheKnownOnes) {
    EXPECT_THAT(refusal(R"({"metal": "Fe"})", read_metal),
                AllOf(HasSubstr("m.json: /metal"), HasSubstr("\"Fe\""), HasSubstr("one of Al, Ag, Au, Cu")));
    EXPECT_THAT(refusal(R"({"metal": 3})", read_metal), HasSubstr("/metal"));
    EXPECT_THAT(refusal("{}", read_metal), HasSubstr("/metal: missing"));
}

TEST(ColourJson, ReadsEveryBuiltInIlluminant) {
    for (const std::string& name : illuminant_names()) {
        const nlohmann::json json = {{"illuminant", name}};
        JsonReader reader(json, "m.json");
        EXPECT_EQ(read_builtin_illuminant(reader).name, name);
        EXPECT_EQ(std::get<Illuminant>(read_illuminant(reader, "the material")).name, name);
        EXPECT_NO_THROW(reader.finish());
    }
}

TEST(ColourJson, IlluminantIsD65WithoutTheKey) {
    const nlohmann::json json = nlohmann::json::object();
    JsonReader reader(json, "m.json");
    EXPECT_EQ(read_builtin_illuminant(reader).name, "D65");
    EXPECT_EQ(std::get<Illuminant>(read_illuminant(reader, "the material")).name, "D65");
}

TEST(ColourJson, IlluminantMayBeAFilesName) {
    const nlohmann::json json = {{"illuminant", "lamps/sodium.csv"}};
    JsonReader reader(json, "m.json");
    EXPECT_EQ(std::get<std::string>(read_illuminant(reader, "the material")), "lamps/sodium.csv");
}

TEST(ColourJson, UnknownIlluminantsListTheKnownOnes) {
    const auto from_file = [](JsonReader& reader) { read_illuminant(reader, "the recipe"); };
    EXPECT_THAT(refusal(R"({"illuminant": "F12"})", from_file),
                AllOf(HasSubstr("m.json: /illuminant"), HasSubstr("\"F12\""), HasSubstr("one of A, D65, E, F11"),
                      HasSubstr(".csv file beside the recipe"), HasSubstr("meant?")));
    EXPECT_THAT(refusal(R"({"illuminant": 5})", from_file), HasSubstr("/illuminant"));
    EXPECT_THAT(
        refusal(R"({"illuminant": "lamp.csv"})", read_builtin_illuminant),
        AllOf(HasSubstr("m.json: /illuminant"), HasSubstr("one of A, D65, E, F11"), Not(HasSubstr(".csv file"))));
}

}  // namespace
}  // namespace rowland::colour
