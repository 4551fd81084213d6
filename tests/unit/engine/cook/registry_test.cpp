#include "engine/cook/registry.h"

#include <gmock/gmock.h>

#include "tests/support/expect.h"
#include "tests/support/folder_test.h"
#include "tests/unit/engine/cook/tile_type.h"

namespace rowland::cook {
namespace {

using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

AssetType json_type(const std::string& name, const std::string& key) {
    return {.name = name,
            .extension = {},
            .recognises = [key](const std::filesystem::path&,
                                const nlohmann::json* json) { return json != nullptr && json->contains(key); },
            .cook = {},
            .check = [](Context&) {},
            .describe = {}};
}

class RegistryTest : public test::FolderTest {
 protected:
    RegistryTest() {
        test::register_tile_types(registry_);
        registry_.add(json_type("material", "grating"));
        registry_.add(json_type("probe", "sun"));
    }

    Registry registry_;
};

TEST_F(RegistryTest, SourcesAreKnownByNameOrByTheirJson) {
    EXPECT_EQ(registry_.type_of_source("a.tiles").name, "tiles");
    EXPECT_EQ(registry_.type_of_source(write("a.json", R"({"sun": 1})")).name, "probe");
    EXPECT_EQ(registry_.type_of_source(write("b.JSON", R"({"grating": 1})")).name, "material");
}

TEST_F(RegistryTest, UnknownSourceListsWhatIsKnown) {
    EXPECT_EQ(message_of([&] { registry_.type_of_source("a.txt"); }),
              "a.txt: a source of no known type; expected one of tiles, notes, plain, material, probe");
    const auto path = write("a.json", "{}");
    EXPECT_THAT(message_of([&] { registry_.type_of_source(path); }), HasSubstr("no known type"));
}

TEST_F(RegistryTest, SourceThatTwoTypesClaimIsRefused) {
    const auto path = write("a.json", R"({"sun": 1, "grating": 2})");
    EXPECT_THAT(message_of([&] { registry_.type_of_source(path); }), HasSubstr("claimed by material and probe"));
}

TEST_F(RegistryTest, BadJsonIsRefusedWithItsPlace) {
    const auto path = write("a.json", "{\n!");
    EXPECT_THAT(message_of([&] { registry_.type_of_source(path); }), HasSubstr("line 2, column 1"));
}

using RegistryDeathTest = RegistryTest;

TEST_F(RegistryDeathTest, NamesAreUnique) {
    EXPECT_DEATH(registry_.add(json_type("probe", "x")), "asset type names are unique: probe");
}

TEST_F(RegistryDeathTest, TypeThatCooksMustDescribe) {
    AssetType type = json_type("mesh", "x");
    type.cook = [](Context&) { return std::vector<std::byte>(); };
    EXPECT_DEATH(registry_.add(type), "describes what it cooks: mesh");
}

TEST_F(RegistryTest, ContextListsEachFileOnceInTheOrderOfMention) {
    const auto a = write("a", "1");
    const auto b = write("b", "2");
    Context context(a);
    context.read(b, 10);
    context.depend_on(a);
    context.depend_on(folder_.path() / "missing");
    context.read(b, 10);
    EXPECT_THAT(context.dependencies(), ElementsAre(a, b, folder_.path() / "missing"));
    ASSERT_EQ(context.fingerprints().size(), 3u);
    EXPECT_NE(context.fingerprints()[0], context.fingerprints()[1]);
    EXPECT_EQ(context.fingerprints()[2], Hash128{});  // it may be missing
}

TEST_F(RegistryTest, ContextReadsJsonWithPlacesInItsErrors) {
    Context context(write("a.json", "[1,"));
    EXPECT_THAT(message_of([&] { context.read_json(context.source()); }), HasSubstr("a.json: line 1"));
    EXPECT_EQ(context.read_json(write("b.json", "[1]")).at(0), 1);
    EXPECT_EQ(context.dependencies().size(), 2u);
}

}  // namespace
}  // namespace rowland::cook
