#include "engine/live/live_assets.h"

#include <gmock/gmock.h>

#include <thread>

#include "engine/cook/cook_source.h"
#include "engine/image/exr.h"
#include "engine/scene/cook.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

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
        return test::bytes_of(context.read_json(context.source())["number"].dump());
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
    static void poll_until(LiveAssets& assets, const std::function<bool()>& done) {
        for (int i = 0; i < 1000 && !done(); ++i) {
            assets.poll();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
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

TEST_F(LiveAssetsTest, AnImageIsShownAsTheRoomOfTheSettings) {
    const std::filesystem::path image = source_.parent_path() / "light.exr";
    image::write_exr(image, {.width = 8, .height = 4, .texels = std::vector<glm::vec3>(32, glm::vec3(1.0F))});
    LiveAssets far_away(registry_of(1), {.probe_mapping = "equirect", .watch = false});
    EXPECT_FALSE(far_away.probe(image)->dome);
    LiveAssets room(registry_of(1), {.probe_mapping = "equirect", .dome = {{.radius_m = 6.0}}, .watch = false});
    EXPECT_EQ(room.probe(image)->dome.value().radius_m, 6.0);
}

TEST_F(LiveAssetsTest, AnAssetFollowsItsSource) {
    LiveAssets assets(registry_of(1), {});
    const asset::Handle<int> number = load(assets, source_);
    write_file_atomic(source_, std::string_view(R"({"number": 12345})"));
    poll_until(assets, [&] { return *number != 7; });
    EXPECT_EQ(*number, 12345);
    EXPECT_TRUE(assets.failures().empty());
}

/// A glTF scene whose material has tables.
class LiveScene : public LiveAssetsTest {
 protected:
    LiveScene() {
        cook::GltfExtension extension;
        extension.name = "TEST_number";
        extension.describe = [](const nlohmann::json& object, const std::string&, const std::string&) {
            return object.at("number").dump();
        };
        extension.cook = [](cook::Context&, const cook::SceneExtension& at) {
            return std::vector<std::byte>(at.object["number"].get<std::size_t>());
        };
        extension.describe_tables = [](std::span<const std::byte>, const std::string&) { return std::string(); };
        registry_->add_gltf_extension(std::move(extension));
        scene::register_scene_type(*registry_);
        write(7);
    }

    void write(int number) const {
        write_file_atomic(gltf_,
                          R"({"asset": {"version": "2.0"}, "materials": [{"extensions": {"TEST_number": {"number": )" +
                              std::to_string(number) + "}}}]}");
    }
    static std::size_t number(const scene::ImportedScene& scene) {
        return scene.materials.at(0).tables.at("TEST_number")->size();
    }

    std::shared_ptr<cook::Registry> registry_ = std::make_shared<cook::Registry>();
    std::filesystem::path gltf_ = folder_.path() / "room.gltf";
    LiveAssetSettings settings_{.watch = false, .cache_folder = folder_.path() / "cache"};
};

TEST_F(LiveScene, ASecondStartBakesNothing) {
    const std::uint64_t before = cook::sources_baked();
    EXPECT_EQ(number(*LiveAssets(registry_, settings_).scene(gltf_)), 7U);
    EXPECT_EQ(cook::sources_baked(), before + 1);
    EXPECT_EQ(number(*LiveAssets(registry_, settings_).scene(gltf_)), 7U);
    cook::cook_source(*registry_, gltf_, folder_.path() / "room.scene");
    const std::uint64_t cooked = cook::sources_baked();
    EXPECT_EQ(cooked, before + 2);
    EXPECT_EQ(number(*LiveAssets(registry_, settings_).scene(folder_.path() / "room.scene")), 7U);
    EXPECT_EQ(cook::sources_baked(), cooked);
}

TEST_F(LiveScene, FollowsItsSourceAndStaysWhileThatIsBroken) {
    LiveAssets assets(registry_, settings_);
    const asset::Handle<scene::ImportedScene> scene = assets.scene(gltf_);
    write_file_atomic(gltf_, R"({"asset": )");
    poll_until(assets, [&] { return !assets.failures().empty(); });
    ASSERT_THAT(assets.failures(), testing::ElementsAre(HasSubstr("room.gltf")));
    EXPECT_EQ(number(*scene), 7U);
    write(1234);
    poll_until(assets, [&] { return number(*scene) != 7U; });
    EXPECT_EQ(number(*scene), 1234U);
    EXPECT_TRUE(assets.failures().empty());
}

}  // namespace
}  // namespace rowland::live
