#include "engine/asset/store.h"

#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/support/folder_test.h"

namespace rowland::asset {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class StoreTest : public test::FolderTest {
 protected:
    /// Two writes within one tick of the file system's clock must also differ.
    void write(const std::string& name, std::string_view text) {
        write_file_atomic(path(name), text);
        std::filesystem::last_write_time(path(name), std::filesystem::last_write_time(path(name)) -
                                                         std::chrono::hours(1) + std::chrono::seconds(++writes_));
    }
    /// An asset that is a file's text; "include NAME" is replaced by that file's; "bad" is refused.
    Handle<std::string> load(const std::string& name) {
        return store_.load<std::string>(name, [this, name](std::vector<std::filesystem::path>& files) {
            ++loads_;
            files.push_back(path(name));
            std::string text = read_text_file(path(name), 100);
            if (text.starts_with("include ")) {
                files.push_back(path(text.substr(8)));
                text = read_text_file(path(text.substr(8)), 100);
            }
            if (text == "bad") refuse_input(name, "", "bad", "good");
            return text;
        });
    }
    bool settle() {
        bool news = store_.poll();
        store_.wait();
        return store_.poll() || news;
    }
    Store store_{std::chrono::milliseconds(0)};
    std::atomic<int> loads_ = 0;
    int writes_ = 0;
};

TEST_F(StoreTest, OneNameIsLoadedOnceAndShared) {
    write("a", "one");
    const auto first = load("a");
    const auto second = load("a");
    EXPECT_EQ(*first, "one");
    EXPECT_EQ(first.value(), second.value());
    EXPECT_EQ(loads_, 1);
}

TEST_F(StoreTest, WhatNobodyHoldsIsLetGo) {
    write("a", "one");
    load("a");
    load("a");
    EXPECT_EQ(loads_, 2);
}

TEST_F(StoreTest, AFirstLoadThatFailsThrows) {
    write("a", "bad");
    EXPECT_THROW(load("a"), Error);
    EXPECT_THROW(load("missing"), Error);
}

TEST_F(StoreTest, AChangedFileReplacesTheAssetAndRaisesItsVersion) {
    write("a", "one");
    const auto handle = load("a");
    const auto old = handle.value();
    EXPECT_FALSE(settle());
    EXPECT_EQ(handle.version(), 1U);
    write("a", "two");
    EXPECT_TRUE(settle());
    EXPECT_EQ(*handle, "two");
    EXPECT_EQ(handle.version(), 2U);
    EXPECT_EQ(*old, "one");
    EXPECT_FALSE(settle());
}

TEST_F(StoreTest, AFileThatAnAssetNamesCountsToo) {
    write("a", "include b");
    write("b", "one");
    const auto handle = load("a");
    write("b", "two");
    settle();
    EXPECT_EQ(*handle, "two");
}

TEST_F(StoreTest, ABrokenFileKeepsTheOldAssetAndAMendedOneIsTaken) {
    write("a", "one");
    const auto handle = load("a");
    write("a", "bad");
    EXPECT_TRUE(settle());
    EXPECT_EQ(*handle, "one");
    EXPECT_EQ(handle.version(), 1U);
    EXPECT_THAT(store_.failures(), ElementsAre(HasSubstr("expected good")));
    write("a", "three");
    settle();
    EXPECT_EQ(*handle, "three");
    EXPECT_THAT(store_.failures(), IsEmpty());
}

TEST_F(StoreTest, MendingOnlyTheFileThatWasNamedIsEnough) {
    write("a", "include b");
    write("b", "one");
    const auto handle = load("a");
    std::filesystem::remove(path("b"));
    settle();
    EXPECT_EQ(store_.failures().size(), 1U);
    write("b", "two");
    settle();
    EXPECT_EQ(*handle, "two");
}

TEST_F(StoreTest, ReloadAllNeedsNoChange) {
    write("a", "one");
    const auto handle = load("a");
    store_.reload_all();
    store_.wait();
    store_.poll();
    EXPECT_EQ(handle.version(), 2U);
}

TEST_F(StoreTest, FilesAreNotLookedAtMoreOftenThanTheInterval) {
    Store slow(std::chrono::hours(1));
    write("a", "one");
    const auto handle = slow.load<std::string>("a", [this](std::vector<std::filesystem::path>& files) {
        files.push_back(path("a"));
        return read_text_file(path("a"), 100);
    });
    slow.poll();
    write("a", "two");
    slow.poll();
    slow.wait();
    slow.poll();
    EXPECT_EQ(*handle, "one");
}

}  // namespace
}  // namespace rowland::asset
