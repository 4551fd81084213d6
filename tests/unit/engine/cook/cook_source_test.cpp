#include <gmock/gmock.h>
#include <set>

#include "engine/cook/cook_source.h"
#include "engine/core/parallel.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"
#include "tests/unit/engine/cook/tile_type.h"

namespace rowland::cook {

namespace {

using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

class CookSourceTest : public test::FolderTest {
 protected:
    CookSourceTest() { test::register_tile_types(registry_); }

    Hash128 content_hash(const std::filesystem::path& source) const {
        return bake_source(registry_, source).asset.header.content_hash;
    }

    std::set<std::string> names() const {
        std::set<std::string> result;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            result.insert(entry.path().filename().string());
        return result;
    }

    Registry registry_;
};

TEST_F(CookSourceTest, WritesAContainerWithTheBakedPayload) {
    const auto source = write("a.tiles", "size 100");
    cook_source(registry_, source, path("out/a.cooked"));
    const asset::CookedAsset cooked = asset::load(path("out/a.cooked"), "tiles", 2);
    EXPECT_EQ(cooked.payload.size(), 100u);
    EXPECT_EQ(cooked.payload, bake_source(registry_, source).asset.payload);
    EXPECT_EQ(cooked.header.content_hash, content_hash(source));
}

TEST_F(CookSourceTest, TypeWithoutContainerIsWrittenAsItIs) {
    cook_source(registry_, write("a.plain", "hello"), path("a.flat"));
    EXPECT_EQ(text("a.flat"), "hello");
}

TEST_F(CookSourceTest, TwoCooksWithAnyNumberOfThreadsGiveTheSameBytes) {
    const auto source = write("a.tiles", "size 5000");
    cook_source(registry_, source, path("all.cooked"));
    cook_source(registry_, source, path("again.cooked"));
    for (const unsigned threads : {1u, 2u}) {
        const ThreadLimit limit(threads);
        cook_source(registry_, source, path(std::to_string(threads) + ".cooked"));
    }
    EXPECT_EQ(text("again.cooked"), text("all.cooked"));
    EXPECT_EQ(text("1.cooked"), text("all.cooked"));
    EXPECT_EQ(text("2.cooked"), text("all.cooked"));
}

TEST_F(CookSourceTest, BytesDoNotDependOnWhereTheSourceLies) {
    write("b.txt", "x");
    write("else/where/b.txt", "x");
    cook_source(registry_, write("a.tiles", "include b.txt\nsize 9"), path("1"));
    cook_source(registry_, write("else/where/other.tiles", "include b.txt\nsize 9"), path("2"));
    EXPECT_EQ(text("1"), text("2"));
}

TEST_F(CookSourceTest, ContentHashFollowsSourceDependenciesAndType) {
    write("b.txt", "1");
    write("c.txt", "2");
    const auto source = write("a.tiles", "include b.txt\ninclude c.txt\n");
    const Hash128 original = content_hash(source);
    EXPECT_EQ(content_hash(source), original);

    write("c.txt", "3");
    EXPECT_NE(content_hash(source), original);
    write("b.txt", "2");
    write("c.txt", "1");
    EXPECT_NE(content_hash(source), original) << "files are told apart by their order";
    write("b.txt", "1");
    write("c.txt", "2");
    EXPECT_EQ(content_hash(source), original);
    write("a.tiles", "include b.txt\ninclude c.txt\n\n");
    EXPECT_NE(content_hash(source), original);
    write("a.tiles", "include b.txt\ninclude c.txt\n");

    AssetType type = *registry_.find("tiles");
    ++type.version;
    Registry newer;
    newer.add(type);
    EXPECT_NE(bake_source(newer, source).asset.header.content_hash, original);
    --type.version;
    type.name = "tales";
    Registry renamed;
    renamed.add(type);
    EXPECT_NE(bake_source(renamed, source).asset.header.content_hash, original);
}

TEST_F(CookSourceTest, DepfileListsTransitiveSources) {
    write("b c#$.txt", "x");
    const auto source = write("a.tiles", "include b c#$.txt\n");
    const BakedAsset baked = cook_source(registry_, source, path("a.cooked"), {.depfile = path("a.d")});
    EXPECT_THAT(baked.dependencies, ElementsAre(source, path("b c#$.txt")));
    const std::string folder = folder_.path().generic_string();
    EXPECT_EQ(text("a.d"),
              path("a.cooked").string() + ": \\\n  " + folder + "/a.tiles \\\n  " + folder + "/b\\ c\\#$$.txt\n");
}

TEST_F(CookSourceTest, FailureLeavesOldOutputsAndNothingElse) {
    write("a.cooked", "old");
    write("a.d", "old");
    for (const char* content : {"refuse", "crash", "exhaust", "include missing.txt", "change a.tiles"}) {
        const auto source = write("a.tiles", content);
        EXPECT_THROW(cook_source(registry_, source, path("a.cooked"), {.depfile = path("a.d")}), Error) << content;
        EXPECT_EQ(text("a.cooked"), "old") << content;
        EXPECT_EQ(text("a.d"), "old") << content;
        EXPECT_EQ(names(), (std::set<std::string>{"a.cooked", "a.d", "a.tiles"})) << content;
    }
}

TEST_F(CookSourceTest, NameNoDepfileCanHoldFailsBeforeAnythingIsWritten) {
    if (!test::has_posix_files()) GTEST_SKIP() << "names of files hold no line break here";
    const auto source = write("a\nb.tiles", "size 1");
    EXPECT_THAT(message_of([&] { cook_source(registry_, source, path("o"), {.depfile = path("d")}); }),
                HasSubstr("a line break"));
    EXPECT_EQ(names(), (std::set<std::string>{"a\nb.tiles"}));
}

TEST_F(CookSourceTest, FileThatChangesDuringTheCookIsAnError) {
    write("b.txt", "x");
    write("c.txt", "x");
    for (const auto& [content, changed] :
         {std::pair("change a.tiles", "a.tiles"), std::pair("include b.txt\nchange b.txt", "b.txt")}) {
        const auto source = write("a.tiles", content);
        EXPECT_EQ(test::message_of([&] { bake_source(registry_, source); }, Fault::System),
                  path(changed).string() + ": changed while it was being cooked; cook again");
    }
    EXPECT_NO_THROW(bake_source(registry_, write("a.tiles", "change c.txt"))) << "what is not read may change";
}

TEST_F(CookSourceTest, OutputMustNotBeASource) {
    write("b.txt", "x");
    const auto source = write("a.tiles", "include b.txt\n");
    EXPECT_THAT(message_of([&] { cook_source(registry_, source, source); }), HasSubstr("the same file as an input"));
    EXPECT_THAT(message_of([&] { cook_source(registry_, source, path("b.txt")); }),
                HasSubstr("the same file as an input"));
    for (const char* file : {"a.tiles", "b.txt"})
        EXPECT_THAT(message_of([&] { cook_source(registry_, source, path("new"), {.depfile = path(file)}); }),
                    HasSubstr("the same file as an input"));
    EXPECT_THAT(message_of([&] { cook_source(registry_, source, path("new"), {.depfile = path("new")}); }),
                HasSubstr("the output of --output"));
    EXPECT_FALSE(std::filesystem::exists(path("new")));
    EXPECT_EQ(text("a.tiles"), "include b.txt\n");
    EXPECT_EQ(text("b.txt"), "x");
}

/// The bake would fail: the output is refused before it.
TEST_F(CookSourceTest, OutputThatCannotBeWrittenIsRefusedBeforeTheBake) {
    const auto source = write("a.tiles", "crash");
    EXPECT_THAT(message_of([&] { cook_source(registry_, source, "/dev/full"); }), HasSubstr("not a regular file"));
    EXPECT_THAT(message_of([&] { cook_source(registry_, source, path("new"), {.depfile = "/dev/full"}); }),
                HasSubstr("--depfile /dev/full"));
    EXPECT_THAT(message_of([&] { cook_source(registry_, source, path("a.tiles/under_a_file")); }),
                HasSubstr(test::has_posix_files() ? "Not a directory" : "a file that can be written"));
}

TEST_F(CookSourceTest, WhatIsNoSourceIsRefused) {
    const auto cook = [&](const std::filesystem::path& source) {
        return message_of([&] { cook_source(registry_, source, path("out")); });
    };
    EXPECT_THAT(cook(write("a.notes", "x")), HasSubstr("only checked, never cooked"));
    EXPECT_THAT(cook(write("a.txt", "x")), HasSubstr("no known type"));
    EXPECT_THAT(cook(write("b.tiles", "")), HasSubstr("an empty file"));
    EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST(Depfile, RelativeSourcesAreMadeAbsoluteAndTheOutputIsLeftAlone) {
    EXPECT_EQ(depfile_text("a.cooked", {"a.tiles"}),
              "a.cooked: \\\n  " + (std::filesystem::current_path() / "a.tiles").generic_string() + "\n");
}

TEST(Depfile, SpecialCharactersAreEscapedAsCompilersDo) {
    if (!test::has_posix_files()) GTEST_SKIP() << "names of files hold no backslash here";
    EXPECT_EQ(depfile_text("a b", {"/x y", "/a#b", "/$HOME", "/a\\b", "/a\\ b", "/a:b", "/\xff\u00e9"}),
              "a\\ b: \\\n  /x\\ y \\\n  /a\\#b \\\n  /$$HOME \\\n  /a\\b \\\n  /a\\\\\\ b \\\n  /a:b \\\n"
              "  /\xff\u00e9\n");
}

}  // namespace

}  // namespace rowland::cook
