#include "editor/inspector/workbench.h"

#include <gmock/gmock.h>

#include <glm/common.hpp>

#include "engine/colour/colour_space.h"
#include "tests/support/environment.h"
#include "tests/support/files.h"

namespace rowland::inspector {
namespace {

class FileListTest : public testing::Test {
 protected:
    FileListTest() {
        for (const char* name : {"b.json", "A.JSON", "disc.glb", "sky.hdr", "notes.txt", ".hidden.json"})
            write_file_atomic(folder_.path() / name, "x");
        std::filesystem::create_directory(folder_.path() / "models");
    }
    std::vector<std::string> names(const std::string& typed, FileKind kind) const {
        std::vector<std::string> result;
        for (const ListedFile& file : list_files(typed, folder_.path(), kind).files) result.push_back(file.name);
        return result;
    }

    test::TemporaryFolder folder_;
};

TEST_F(FileListTest, FoldersComeFirstThenFilesByName) {
    EXPECT_THAT(names("", FileKind::All), testing::ElementsAre("models", "A.JSON", "b.json", "disc.glb", "sky.hdr"));
    EXPECT_THAT(names("", FileKind::Materials), testing::ElementsAre("models", "A.JSON", "b.json"));
    EXPECT_THAT(names("", FileKind::Models), testing::ElementsAre("models", "disc.glb"));
    EXPECT_THAT(names(".h", FileKind::All), testing::ElementsAre(".hidden.json"));
}

TEST_F(FileListTest, TypedLettersSelectAndAreCompleted) {
    EXPECT_THAT(names("a", FileKind::All), testing::ElementsAre("A.JSON"));
    EXPECT_EQ(list_files("a", folder_.path(), FileKind::All).completed, "A.JSON");
    EXPECT_EQ(list_files("mo", folder_.path(), FileKind::All).completed, "models/");
    EXPECT_EQ(list_files("nothing", folder_.path(), FileKind::All).completed, "nothing");
    const std::string typed = (folder_.path() / "d").string();
    EXPECT_EQ(list_files(typed, "/", FileKind::All).completed, (folder_.path() / "disc.glb").string());
}

TEST_F(FileListTest, ATypedPathIsRelativeToTheFolderOrTheHome) {
    EXPECT_EQ(resolved("b.json", folder_.path()), folder_.path() / "b.json");
    const std::filesystem::path elsewhere = folder_.path().parent_path() / "b.json";
    EXPECT_EQ(resolved(elsewhere.string(), folder_.path()), elsewhere);
    const char* home = std::getenv(test::has_posix_files() ? "HOME" : "USERPROFILE");
    const std::filesystem::path expected = home == nullptr ? folder_.path() / "~" : std::filesystem::path(home);
    EXPECT_EQ(resolved("~/b.json", folder_.path()), expected / "b.json");
}

TEST_F(FileListTest, AFolderThatIsMissingHasNoFiles) {
    EXPECT_TRUE(names("missing/x", FileKind::All).empty());
}

TEST(InspectorLayout, IsReadAsItWasWritten) {
    const test::TemporaryFolder folder;
    Layout layout{
        .width = 1000, .height = 700, .scale = 1.5F, .material_width = 20.0F, .shape = "card", .light = "a.hdr"};
    layout.stage.lamp = true;
    layout.stage.rotation_deg = -30.0F;
    save_layout(layout, folder.path() / "layout.json");
    const Layout again = load_layout(folder.path() / "layout.json");
    EXPECT_EQ(again.width, 1000);
    EXPECT_EQ(again.scale, 1.5F);
    EXPECT_EQ(again.material_width, 20.0F);
    EXPECT_EQ(again.shape, "card");
    EXPECT_EQ(again.light, "a.hdr");
    EXPECT_EQ(again.stage, layout.stage);
}

TEST(InspectorLayout, TheLastTenFilesAreRemembered) {
    const test::TemporaryFolder folder;
    Layout layout;
    for (int i = 0; i < 12; ++i) remember(layout, "/a/" + std::to_string(i) + ".json");
    remember(layout, "/a/x/../5.json");
    save_layout(layout, folder.path() / "layout.json");
    const std::vector<std::string> recent = load_layout(folder.path() / "layout.json").recent;
    EXPECT_EQ(recent, layout.recent);
    ASSERT_EQ(recent.size(), 10U);
    EXPECT_EQ(recent[0], std::filesystem::absolute("/a/5.json").make_preferred().string());
    EXPECT_EQ(recent[1], std::filesystem::absolute("/a/11.json").make_preferred().string());
}

TEST(InspectorLayout, NonsenseGivesTheDefault) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "layout.json";
    for (const char* text : {"{", "[]", "{\"width\": \"wide\", \"shape\": 3}", "{\"width\": -5, \"scale\": 1e9}"}) {
        write_file_atomic(file, text);
        const Layout layout = load_layout(file);
        EXPECT_GE(layout.width, 640) << text;
        EXPECT_LE(layout.scale, 4.0F) << text;
        EXPECT_EQ(layout.shape, "disc") << text;
    }
    EXPECT_EQ(load_layout(folder.path() / "none.json").width, Layout().width);
}

TEST(InspectorLayout, APathNeedNotBeUtf8) {
    const test::TemporaryFolder folder;
    EXPECT_NO_THROW(save_layout({.light = "caf\xe9.hdr"}, folder.path() / "layout.json"));
    EXPECT_EQ(load_layout(folder.path() / "layout.json").shape, "disc");
}

TEST(InspectorLayout, ASmallWindowShowsThePreviewAndALargerOneAfterwardsTheLayoutAsItWas) {
    const Layout layout;
    for (const float font : {16.0F, 32.0F})
        for (const glm::vec2 size : {glm::vec2(800.0F, 450.0F), glm::vec2(1280.0F, 700.0F)}) {
            const TileSizes sizes = tile_sizes(layout, size, font);
            EXPECT_GE(size.x - sizes.left - sizes.right, std::min(0.4F * size.x, 28.0F * font));
            EXPECT_GE(size.y - sizes.below, 0.5F * size.y);
            EXPECT_GT(std::min(sizes.left, sizes.right), 0.2F * size.x);
        }
    const TileSizes large = tile_sizes(layout, {1280.0F, 700.0F}, 16.0F);
    EXPECT_EQ(large.left, 16.0F * layout.material_width);
    EXPECT_EQ(large.right, 16.0F * layout.physics_width);
    EXPECT_EQ(large.below, 16.0F * layout.price_height);
}

TEST(Presets, AreTheShippedMaterials) {
    std::set<std::string> shipped;
    for (const auto& entry : std::filesystem::directory_iterator(test::content_path("materials")))
        if (entry.path().extension() == ".json") shipped.insert(entry.path().stem().string());
    std::set<std::string> presets;
    for (const Preset& preset : OpenDocument::presets()) presets.insert(preset.file);
    EXPECT_EQ(presets, shipped);
}

TEST(LightChoice, CapturesAreListedBesideTheRecipes) {
    const test::TemporaryFolder folder;
    const auto path = [&](const char* name) { return folder.path() / name; };
    std::filesystem::create_directories(path("captures"));
    for (const char* name : {"captures/captured_city.json", "studio.json", "night.json", "sky.txt"})
        write_file_atomic(path(name), "{}");
    Messages messages;
    const LightChoice light({path("captures"), folder.path(), path("missing")}, "auto", messages);
    EXPECT_THAT(light.shipped(),
                testing::ElementsAre(path("captures/captured_city.json"), path("night.json"), path("studio.json")));
}

TEST(Plot, TicksAreRoundAndWithinTheAxis) {
    EXPECT_EQ(ticks({380.0, 780.0, ""}, 4), (std::vector<double>{400.0, 500.0, 600.0, 700.0}));
    EXPECT_EQ(ticks({-0.1, 0.1, ""}, 2), (std::vector<double>{-0.1, 0.0, 0.1}));
    EXPECT_EQ(ticks({0.5, 200.0, "", true}, 4), (std::vector<double>{1.0, 10.0, 100.0}));
    EXPECT_TRUE(ticks({1.0, 1.0, ""}, 4).empty());
}

TEST(ScreenColour, WhiteIsWhiteAndNothingLeavesTheScreen) {
    const glm::vec3 white = screen_colour(colour::white_d65());
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1.0F, 1e-5F);
    for (const glm::dvec3 xyz : {glm::dvec3(0.0), glm::dvec3(5.0, 1.0, 0.0), glm::dvec3(0.0, 0.3, 0.0)}) {
        const glm::vec3 rgb = screen_colour(xyz);
        EXPECT_EQ(rgb, glm::clamp(rgb, 0.0F, 1.0F));
    }
    const glm::vec3 grey = screen_colour(0.2140 * colour::white_d65());  // sRGB's half
    EXPECT_NEAR(grey.g, 0.5F, 1e-3F);
}

using std::chrono_literals::operator""ms;

TEST(Redraw, DrawsAWhileAfterAChangeThenRests) {
    Redraw redraw;
    Redraw::Clock::time_point now{};
    EXPECT_EQ(redraw.next(false, false, now += 1000ms), app::Next::Wait);
    EXPECT_EQ(redraw.next(true, false, now += 1000ms), app::Next::Frame);
    // Slow frames: several are drawn though the time is over.
    for (int frame = 0; frame < 5; ++frame) EXPECT_EQ(redraw.next(false, false, now += 1000ms), app::Next::Frame);
    EXPECT_EQ(redraw.next(false, false, now += 1000ms), app::Next::Wait);
    // Fast frames: the time counts.
    EXPECT_EQ(redraw.next(true, false, now += 1ms), app::Next::Frame);
    for (int frame = 0; frame < 200; ++frame) EXPECT_EQ(redraw.next(false, false, now += 1ms), app::Next::Frame);
    EXPECT_EQ(redraw.next(false, false, now += 100ms), app::Next::Wait);
}

TEST(Redraw, LooksForResultsWhileSomethingIsComputed) {
    Redraw redraw;
    EXPECT_EQ(redraw.next(false, true, Redraw::Clock::time_point(1000ms)), app::Next::Watch);
}

}  // namespace
}  // namespace rowland::inspector
