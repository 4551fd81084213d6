#include <gmock/gmock.h>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"
#include "tests/unit/engine/cook/tile_type.h"

namespace rowland::cook {
namespace {

using test::message_of;
using testing::HasSubstr;

class CheckFileTest : public test::FolderTest {
 protected:
    CheckFileTest() { test::register_tile_types(registry_); }

    std::filesystem::path write_cooked(const asset::Header& header, std::size_t payload_size) const {
        write_file_atomic(path("a.cooked"), asset::pack({header, std::vector<std::byte>(payload_size)}));
        return path("a.cooked");
    }

    std::string refusal(const std::filesystem::path& file) const {
        return message_of([&] { check_file(registry_, file); });
    }

    Registry registry_;
};

TEST_F(CheckFileTest, SaneSourcesAndAssetsAreNamedByTheirKind) {
    const auto source = write("a.tiles", "size 3");
    EXPECT_EQ(check_file(registry_, source), "tiles source");
    EXPECT_EQ(check_file(registry_, write("a.notes", "x")), "notes source");
    cook_source(registry_, source, path("no_extension"));
    EXPECT_EQ(check_file(registry_, path("no_extension")), "cooked tiles");
}

TEST_F(CheckFileTest, RefusedSourceSaysWhy) {
    EXPECT_THAT(refusal(write("a.tiles", "size 3 sise")), HasSubstr("a.tiles: sise; expected size, include"));
    EXPECT_THAT(refusal(write("a.tiles", "include b")), HasSubstr(path("b").string() + ": cannot be opened"));
    EXPECT_THAT(refusal(write("a.txt", "x")), HasSubstr("no known type"));
}

TEST_F(CheckFileTest, LibraryFailuresAreRefusals) {
    EXPECT_EQ(refusal(write("a.tiles", "crash")), path("a.tiles").string() + ": library failed; expected a sane file");
    EXPECT_THAT(refusal(write("a.tiles", "exhaust")), HasSubstr("more memory than there is"));
}

TEST_F(CheckFileTest, CookedPayloadIsParsedByItsType) {
    EXPECT_NO_THROW(check_file(registry_, write_cooked({.type = "tiles", .type_version = 2, .content_hash = {}}, 12)));
    EXPECT_THAT(refusal(write_cooked({.type = "tiles", .type_version = 2, .content_hash = {}}, 13)),
                HasSubstr("13 tiles"));
}

TEST_F(CheckFileTest, CookedAssetOfAnotherVersionNamesTheCommand) {
    EXPECT_THAT(refusal(write_cooked({.type = "tiles", .type_version = 1, .content_hash = {}}, 1)),
                HasSubstr("tiles version 1, older than this program's; expected version 2; "
                          "cook it again: ./rowland cook"));
}

TEST_F(CheckFileTest, CookedAssetOfUnknownTypeIsRefused) {
    for (const char* name : {"tapestry", "notes"})
        EXPECT_THAT(refusal(write_cooked({.type = name, .type_version = 1, .content_hash = {}}, 1)),
                    HasSubstr("unknown type \"" + std::string(name) + "\""));
}

TEST_F(CheckFileTest, WhatIsNoFileIsRefusedAtOnce) {
    EXPECT_THAT(refusal(write("empty.notes", "")), HasSubstr("an empty file"));
    EXPECT_THAT(refusal(path("missing.notes")),
                HasSubstr(test::has_posix_files() ? "No such file" : "cannot be opened"));
    std::filesystem::create_directory(path("folder.notes"));
    EXPECT_THAT(refusal(path("folder.notes")), HasSubstr("not a regular file"));
    if (test::make_pipe(path("pipe.notes"))) {
        EXPECT_THAT(refusal(path("pipe.notes")), HasSubstr("not a regular file"));
    }
}

TEST_F(CheckFileTest, NamesNeedNotBeUtf8) {
    if (!test::has_posix_files()) GTEST_SKIP() << "names of files are Unicode here";
    EXPECT_EQ(check_file(registry_, write("\xff\xfe \n.notes", "x")), "notes source");
    EXPECT_THAT(refusal(write("\xff\xfe.txt", "x")), HasSubstr("\xff\xfe.txt: a source of no known type"));
}

TEST_F(CheckFileTest, DescriptionShowsHeaderAndPayload) {
    const auto file =
        write_cooked({.type = "tiles", .type_version = 2, .content_hash = {.low = 0xab, .high = 0x12}}, 12);
    EXPECT_EQ(describe_file(registry_, file),
              "type: tiles\nversion: 2\ncontent hash: 000000000000001200000000000000ab\n"
              "payload: 12 bytes\ntiles: 12");
    EXPECT_EQ(describe_file(registry_, write("a.flat", "hello")), "type: plain\npayload: 5 bytes\nletters: 5\n");
}

TEST_F(CheckFileTest, SourceIsDescribedOnlyOnceCooked) {
    const auto file = write("a.tiles", "size 1");
    EXPECT_THAT(message_of([&] { describe_file(registry_, file); }),
                HasSubstr("a tiles source; expected a cooked asset; cook it first: rowland-cook cook"));
}

}  // namespace
}  // namespace rowland::cook
