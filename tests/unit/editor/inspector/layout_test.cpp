#include "editor/inspector/layout.h"

#include <gtest/gtest.h>

#include "engine/core/file.h"
#include "tests/support/temporary_folder.h"

namespace rowland::inspector {
namespace {

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
    EXPECT_EQ(recent[0], "/a/5.json");
    EXPECT_EQ(recent[1], "/a/11.json");
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

}  // namespace
}  // namespace rowland::inspector
