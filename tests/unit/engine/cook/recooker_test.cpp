#include <gmock/gmock.h>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "engine/cook/recooker.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"
#include "tests/unit/engine/cook/tile_type.h"

namespace rowland::cook {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RecookerTest : public test::FolderTest {
 protected:
    RecookerTest() { test::register_tile_types(registry_); }

    void write(const std::string& name, std::string_view text) {
        write_file_atomic(path(name), text);
        // Two writes within one tick of the file system's clock must also differ.
        std::filesystem::last_write_time(path(name), std::filesystem::last_write_time(path(name)) -
                                                         std::chrono::hours(1) + std::chrono::seconds(++writes_));
    }
    std::size_t cooked_size() const { return asset::load_any(path("a.cooked")).payload.size(); }
    static void settle(Recooker& recooker) {
        for (int i = 0; i < 3; ++i) {
            recooker.poll();
            recooker.wait();
        }
        recooker.poll();
    }
    Recooker make() {
        return Recooker(registry_, {{path("a.tiles"), path("a.cooked")}}, {}, std::chrono::milliseconds(0));
    }
    Registry registry_;
    int writes_ = 0;
};

TEST_F(RecookerTest, CooksNothingThatHasNotChanged) {
    write("a.tiles", "size 10");
    Recooker recooker = make();
    settle(recooker);
    EXPECT_FALSE(std::filesystem::exists(path("a.cooked")));
}

TEST_F(RecookerTest, CooksAChangedSourceAndEveryFileItNames) {
    write("a.tiles", "size 10\ninclude b.txt");
    write("b.txt", "x");
    Recooker recooker = make();
    settle(recooker);
    write("b.txt", "y");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 10U);
    write("a.tiles", "size 20\ninclude c.txt");
    write("c.txt", "x");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 20U);
    std::filesystem::remove(path("a.cooked"));
    write("c.txt", "y");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 20U);
}

TEST_F(RecookerTest, ARefusedSourceLeavesTheCookedFileAndSaysWhyUntilItIsMended) {
    write("a.tiles", "size 10");
    Recooker recooker = make();
    settle(recooker);
    write("a.tiles", "size 11");
    settle(recooker);
    write("a.tiles", "refuse");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 11U);
    EXPECT_THAT(recooker.failures(), ElementsAre(HasSubstr("a.tiles")));
    write("a.tiles", "size 12");
    settle(recooker);
    EXPECT_EQ(cooked_size(), 12U);
    EXPECT_THAT(recooker.failures(), IsEmpty());
}

class CookOnce : public test::FolderTest {
 protected:
    CookOnce() {
        test::register_tile_types(registry_);
        write("a/s.tiles", "size 3 include more.txt");
        write("a/more.txt", "size 4 ");
    }

    /// The cooked file, and how many sources were baked for it.
    std::pair<std::filesystem::path, std::uint64_t> once(const std::string& name) {
        const std::uint64_t before = sources_baked();
        read_files_.clear();
        const auto file = cook_once(registry_, folder_.path() / name, folder_.path() / "cache", read_files_);
        return {file, sources_baked() - before};
    }

    Registry registry_;
    std::vector<std::filesystem::path> read_files_;
};

TEST_F(CookOnce, BakesAContentOnceWhereverItIs) {
    const auto [file, baked] = once("a/s.tiles");
    EXPECT_EQ(baked, 1U);
    const asset::CookedAsset asset = asset::load(file, "tiles", 2);
    EXPECT_EQ(asset.payload.size(), 3U);
    EXPECT_EQ(file.filename(), asset.header.content_hash.hex() + ".cooked");
    EXPECT_EQ(once("a/s.tiles"), std::pair(file, std::uint64_t{0}));
    EXPECT_THAT(read_files_, testing::ElementsAre(folder_.path() / "a/s.tiles", folder_.path() / "a/more.txt"));
    write("b/other.tiles", "size 3 include more.txt");
    write("b/more.txt", "size 4 ");
    EXPECT_EQ(once("b/other.tiles"), std::pair(file, std::uint64_t{0}));
}

TEST_F(CookOnce, BakesAgainWhenADependencyChangesAndKnowsTheOldContentStill) {
    const auto [file, baked] = once("a/s.tiles");
    write("a/more.txt", "size 5 ");
    const auto [changed, baked_again] = once("a/s.tiles");
    EXPECT_NE(changed, file);
    EXPECT_EQ(baked_again, 1U);
    std::filesystem::remove(changed);
    EXPECT_EQ(once("a/s.tiles"), std::pair(changed, std::uint64_t{1}));
}

TEST_F(CookOnce, ARefusedSourceLeavesNothingAndIsAnError) {
    write("a/s.tiles", "refuse");
    EXPECT_THAT(test::message_of([&] { once("a/s.tiles"); }), testing::HasSubstr("s.tiles: refuse"));
    EXPECT_THAT(test::message_of([&] { once("a/none.tiles"); }), testing::HasSubstr("none.tiles"));
    EXPECT_THAT(test::message_of([&] { once("a/none.notes"); }), testing::HasSubstr("none.notes"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "cache"));
    EXPECT_THAT(read_files_, testing::Contains(folder_.path() / "a/none.notes"));
}

}  // namespace

}  // namespace rowland::cook
