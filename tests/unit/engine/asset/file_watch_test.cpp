#include "engine/asset/file_watch.h"

#include "tests/support/folder_test.h"

namespace rowland::asset {
namespace {

using std::filesystem::file_time_type;

class FileWatchTest : public test::FolderTest {
 protected:
};

TEST_F(FileWatchTest, AFileLeftAloneHasNotChanged) {
    FileWatch watch({write("a", "1")});
    EXPECT_FALSE(watch.changed());
    EXPECT_FALSE(watch.changed());
}

TEST_F(FileWatchTest, EveryChangeIsToldOnce) {
    const auto a = write("a", "1");
    FileWatch watch({a, write("b", "1")});
    write("b", "22");
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
    std::filesystem::last_write_time(a, file_time_type::clock::now() + std::chrono::seconds(5));
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
}

/// As of a file saved after the clock was set back.
TEST_F(FileWatchTest, AnEarlierDateIsAChange) {
    const auto a = write("a", "1");
    FileWatch watch({a});
    std::filesystem::last_write_time(a, file_time_type::clock::now() - std::chrono::hours(24));
    EXPECT_TRUE(watch.changed());
}

TEST_F(FileWatchTest, RemovingAndMakingAreChanges) {
    const auto a = write("a", "1");
    FileWatch watch({a, folder_.path() / "later"});
    std::filesystem::remove(a);
    EXPECT_TRUE(watch.changed());
    write("later", "1");
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
}

TEST_F(FileWatchTest, AFileWrittenWhileItWasReadHasChanged) {
    const auto a = write("a", "1");
    FileWatch late({a}, std::filesystem::last_write_time(a));
    EXPECT_TRUE(late.changed());
    EXPECT_FALSE(late.changed());
}

}  // namespace
}  // namespace rowland::asset
