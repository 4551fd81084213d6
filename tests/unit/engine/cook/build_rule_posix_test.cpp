#include <gmock/gmock.h>

#include "tests/support/folder_test.h"
#include "tests/support/program.h"

// RowlandCook.cmake in a small project of its own, which cooks two assets with the test's cooker.

namespace rowland::cook {
namespace {

using testing::HasSubstr;
using testing::Not;

class BuildRuleTest : public test::FolderTest {
 protected:
    BuildRuleTest() {
        write("one.tiles", "include shared part.txt\nsize 10\n");
        write("two.tiles", "size 10\n");
        write("unlisted.tiles", "size 10\n");
        write("shared part.txt", "x");
        std::filesystem::copy_file(ROWLAND_TEST_COOKER, path("cooker"));
    }

    /// Makes a file newer than anything built so far, whatever the file system's clock.
    void touch(const std::string& name) const {
        std::filesystem::last_write_time(path(name),
                                         std::filesystem::file_time_type::clock::now() + std::chrono::seconds(2));
    }

    test::Ended configure(const std::string& assets) const {
        const std::string cooker = path("cooker").string();
        std::string project = "cmake_minimum_required(VERSION 3.25)\nproject(Tiles LANGUAGES NONE)\n";
        project += "set(ROWLAND_COOKED_DIR ${CMAKE_BINARY_DIR}/cooked)\n";
        project += "add_executable(rowland-cook IMPORTED GLOBAL)\n";
        project += "set_target_properties(rowland-cook PROPERTIES IMPORTED_LOCATION " + cooker + ")\n";
        project += std::string("include(") + ROWLAND_TEST_COOK_RULE + ")\n" + assets + "\n";
        write("CMakeLists.txt", project);
        return test::run({ROWLAND_TEST_CMAKE, "-S", folder_.path(), "-B", path("build"), "-G", ROWLAND_TEST_GENERATOR,
                          std::string("-DCMAKE_MAKE_PROGRAM=") + ROWLAND_TEST_BUILD_TOOL});
    }

    /// What the build prints: a line "Cooking NAME" for each asset cooked.
    std::string build() const {
        const auto result = test::run({ROWLAND_TEST_CMAKE, "--build", path("build")});
        EXPECT_EQ(result.code, 0) << result.out << result.err;
        return result.out;
    }
};

TEST_F(BuildRuleTest, ExactlyWhatDependsOnAChangeIsCookedAgain) {
    const auto configured =
        configure("rowland_cook_assets(tiles ASSETS one.tiles one.cooked  two.tiles sub/two.cooked)");
    ASSERT_EQ(configured.code, 0) << configured.err;
    const auto one = HasSubstr("Cooking one.cooked");
    const auto two = HasSubstr("Cooking sub/two.cooked");

    EXPECT_THAT(build(), testing::AllOf(one, two));
    EXPECT_TRUE(std::filesystem::exists(path("build/cooked/one.cooked")));
    EXPECT_TRUE(std::filesystem::exists(path("build/cooked/sub/two.cooked")));
    EXPECT_THAT(build(), testing::AllOf(Not(one), Not(two))) << "nothing changed";

    touch("unlisted.tiles");
    EXPECT_THAT(build(), testing::AllOf(Not(one), Not(two)));

    write("two.tiles", "size 11\n");
    touch("two.tiles");
    EXPECT_THAT(build(), testing::AllOf(Not(one), two)) << "its source";
}

TEST_F(BuildRuleTest, TransitiveSourceIsFollowed) {
    ASSERT_EQ(configure("rowland_cook_assets(tiles ASSETS one.tiles one.cooked  two.tiles two.cooked)").code, 0);
    build();
    const std::string before = read_text_file(path("build/cooked/one.cooked"), 10'000);
    write("shared part.txt", "y");
    touch("shared part.txt");
    EXPECT_THAT(build(), testing::AllOf(HasSubstr("Cooking one.cooked"), Not(HasSubstr("two.cooked"))));
    EXPECT_NE(read_text_file(path("build/cooked/one.cooked"), 10'000), before);
}

TEST_F(BuildRuleTest, NinjaFollowsOddNamesInTheDepfileItself) {
    if (std::string(ROWLAND_TEST_GENERATOR) != "Ninja") GTEST_SKIP() << "not built with ninja";
    write("three.tiles", "include a #$b.txt\nsize 10\n");
    write("a #$b.txt", "x");
    write("build.ninja",
          "rule cook\n  command = ./cooker cook $in -o $out --depfile $out.d && echo cooked\n  depfile = $out.d\n"
          "build three.cooked: cook three.tiles\n");
    const auto ninja = [&] { return test::run({ROWLAND_TEST_BUILD_TOOL, "-C", folder_.path()}).out; };
    EXPECT_THAT(ninja(), HasSubstr("cooked\n"));
    EXPECT_THAT(ninja(), HasSubstr("no work to do"));
    touch("a #$b.txt");
    EXPECT_THAT(ninja(), HasSubstr("cooked\n"));
}

TEST_F(BuildRuleTest, NewCookerCooksEverythingAgain) {
    ASSERT_EQ(configure("rowland_cook_assets(tiles ASSETS one.tiles one.cooked  two.tiles two.cooked)").code, 0);
    build();
    touch("cooker");
    EXPECT_THAT(build(), testing::AllOf(HasSubstr("Cooking one.cooked"), HasSubstr("Cooking two.cooked")));
}

TEST_F(BuildRuleTest, RefusedSourceFailsTheBuildAndKeepsTheOldAsset) {
    ASSERT_EQ(configure("rowland_cook_assets(tiles ASSETS two.tiles two.cooked)").code, 0);
    build();
    const std::string before = read_text_file(path("build/cooked/two.cooked"), 10'000);
    write("two.tiles", "refuse");
    touch("two.tiles");
    const auto result = test::run({ROWLAND_TEST_CMAKE, "--build", path("build")});
    EXPECT_NE(result.code, 0);
    EXPECT_THAT(result.out + result.err, HasSubstr("two.tiles: refuse; expected size, include"));
    EXPECT_EQ(read_text_file(path("build/cooked/two.cooked"), 10'000), before);
}

TEST_F(BuildRuleTest, AssetListedTwiceOrWithoutOutputFailsToConfigure) {
    EXPECT_THAT(configure("rowland_cook_assets(a ASSETS one.tiles x)\nrowland_cook_assets(b ASSETS two.tiles x)").err,
                HasSubstr("x is cooked by a"));
    EXPECT_THAT(configure("rowland_cook_assets(a ASSETS one.tiles x two.tiles)").err, HasSubstr("has no output"));
    EXPECT_THAT(configure("rowland_cook_assets(a one.tiles)").err, HasSubstr("expected ASSETS"));
}

TEST_F(BuildRuleTest, AttachesAgainWhatChanged) {
    write("scene.gltf", R"({"asset":{"version":"2.0"},"materials":[{"name":"a b"},{"name":"c"}]})");
    const auto configured = configure(
        "rowland_attach(scene SCENE scene.gltf OUTPUT sub/scene.gltf GRATINGS \"a b\" one.tiles \"#1\" two.tiles)");
    ASSERT_EQ(configured.code, 0) << configured.err;
    const auto attaching = HasSubstr("Attaching gratings to sub/scene.gltf");
    EXPECT_THAT(build(), attaching);
    const auto built = [&] { return read_text_file(path("build/cooked/sub/scene.gltf"), 10'000); };
    EXPECT_THAT(built(), testing::AllOf(HasSubstr(R"(size 10\nx)"), HasSubstr(R"("text":"size 10\n")")));
    EXPECT_THAT(build(), Not(attaching)) << "nothing changed";
    write("shared part.txt", "y");
    touch("shared part.txt");
    EXPECT_THAT(build(), attaching) << "a file that a grating names";
    EXPECT_THAT(built(), HasSubstr(R"(size 10\ny)"));
    write("scene.gltf", R"({"asset":{"version":"2.0"},"materials":[{"name":"a b"},{"name":"new"}]})");
    touch("scene.gltf");
    EXPECT_THAT(build(), attaching) << "the scene was exported again";
    EXPECT_THAT(built(), testing::AllOf(HasSubstr("new"), HasSubstr(R"(size 10\ny)")));
}

TEST_F(BuildRuleTest, AttachWithoutPairsFailsToConfigure) {
    for (const std::string arguments : {"SCENE a.glb OUTPUT a.glb", "SCENE a.glb GRATINGS m g.json",
                                        "SCENE a.glb OUTPUT a.glb GRATINGS m", "a.glb OUTPUT a.glb GRATINGS m g.json"})
        EXPECT_THAT(configure("rowland_attach(a " + arguments + ")").err, HasSubstr("expected SCENE"));
    EXPECT_THAT(configure("rowland_cook_assets(a ASSETS one.tiles x)\n"
                          "rowland_attach(b SCENE a.glb OUTPUT x GRATINGS m g.json)")
                    .err,
                HasSubstr("x is cooked by a"));
}

}  // namespace
}  // namespace rowland::cook
