#include "engine/cook/source_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/unit/engine/cook/tile_type.h"

namespace rowland::cook {
namespace {

using test::refusal_of;
using testing::HasSubstr;

class SourceFileTest : public testing::Test {
 protected:
    std::filesystem::path write(const std::string& name, std::string_view text) const {
        std::filesystem::path path = folder_.path() / name;
        write_file_atomic(path, text);
        return path;
    }

    test::TemporaryFolder folder_;
};

TEST_F(SourceFileTest, HashOfAFileIsTheHashOfItsBytes) {
    // Longer than one read.
    std::string text(3'000'001, 'x');
    text[2'500'000] = 'y';
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    EXPECT_EQ(hash_file(write("a", text)), Hasher().bytes(bytes).digest());
    EXPECT_EQ(hash_file(write("empty", "")), Hasher().digest());
}

TEST_F(SourceFileTest, WhatCannotBeASourceHasNoHash) {
    EXPECT_EQ(hash_file(folder_.path()), std::nullopt);
    EXPECT_EQ(hash_file(folder_.path() / "missing"), std::nullopt);
    EXPECT_EQ(hash_file("/dev/zero"), std::nullopt);
    const auto pipe = folder_.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(hash_file(pipe), std::nullopt);
    const auto sparse = write("sparse", "x");
    ASSERT_EQ(::truncate(sparse.c_str(), off_t{1} << 40), 0);
    EXPECT_EQ(hash_file(sparse), std::nullopt);
}

TEST_F(SourceFileTest, BeginningIsAtMostWhatIsThere) {
    EXPECT_EQ(read_beginning(write("a", "12345"), 3).size(), 3u);
    EXPECT_EQ(read_beginning(write("a", "12345"), 30).size(), 5u);
}

TEST_F(SourceFileTest, BeginningOfWhatNoLoaderMayGetIsRefused) {
    EXPECT_THAT(refusal_of([&] { read_beginning(write("a", ""), 3); }), HasSubstr("an empty file"));
    EXPECT_THAT(refusal_of([&] { read_beginning(folder_.path(), 3); }), HasSubstr("not a regular file"));
    EXPECT_THAT(refusal_of([&] { read_beginning(folder_.path() / "b", 3); }), HasSubstr("No such file"));
    const auto pipe = folder_.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(refusal_of([&] { read_beginning(pipe, 3); }), HasSubstr("not a regular file"));
}

}  // namespace
}  // namespace rowland::cook
