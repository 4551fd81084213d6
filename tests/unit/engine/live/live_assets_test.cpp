#include "engine/live/live_assets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "engine/cook/cook_source.h"
#include "engine/core/file.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace rowland::live {
namespace {

using testing::HasSubstr;

/// A module's own type: {"number": 7}, cooked to "7".
cook::AssetType number_type(std::uint32_t version) {
    cook::AssetType type;
    type.name = "number";
    type.version = version;
    type.extension = ".number";
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && json->contains("number");
    };
    type.cook = [](cook::Context& context) {
        const std::string text = context.read_json(context.source())["number"].dump();
        std::vector<std::byte> bytes;
        for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
        return bytes;
    };
    type.check = [](cook::Context&) {};
    type.describe = [](std::span<const std::byte>, const std::string&) { return std::string(); };
    return type;
}

std::shared_ptr<const cook::Registry> registry_of(std::uint32_t version) {
    auto registry = std::make_shared<cook::Registry>();
    registry->add(number_type(version));
    return registry;
}

int read_number(std::span<const std::byte> payload, const std::string& /*file*/) {
    return std::stoi(std::string(reinterpret_cast<const char*>(payload.data()), payload.size()));
}

class LiveAssetsTest : public testing::Test {
 protected:
    LiveAssetsTest() { write_file_atomic(source_, std::string_view(R"({"number": 7})")); }

    asset::Handle<int> load(LiveAssets& assets, const std::filesystem::path& path) const {
        return assets.load<int>(path, "number", read_number);
    }

    test::TemporaryFolder folder_;
    std::filesystem::path source_ = folder_.path() / "seven.json";
    std::filesystem::path cooked_ = folder_.path() / "seven.number";
};

TEST_F(LiveAssetsTest, ATypeOfAModuleIsLoadedFromItsSourceAndCooked) {
    cook::cook_source(*registry_of(1), source_, cooked_);
    LiveAssets assets(registry_of(1), {.watch = false});
    EXPECT_EQ(*load(assets, source_), 7);
    EXPECT_EQ(*load(assets, cooked_), 7);
}

TEST_F(LiveAssetsTest, ACookedFileOfAnotherVersionIsRefusedByTheRegistrysVersion) {
    cook::cook_source(*registry_of(1), source_, cooked_);
    LiveAssets assets(registry_of(2), {.watch = false});
    EXPECT_THAT(test::message_of([&] { load(assets, cooked_); }), HasSubstr("version 1"));
}

TEST_F(LiveAssetsTest, AnAssetFollowsItsSource) {
    LiveAssets assets(registry_of(1), {});
    const asset::Handle<int> number = load(assets, source_);
    write_file_atomic(source_, std::string_view(R"({"number": 12345})"));
    for (int i = 0; i < 1000 && *number == 7; ++i) {
        assets.poll();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(*number, 12345);
    EXPECT_TRUE(assets.failures().empty());
}

}  // namespace
}  // namespace rowland::live
