#include "tests/unit/engine/core/file_fixtures.h"

#include <fstream>
#include <thread>

namespace rowland {

namespace {

using testing::HasSubstr;

TEST_F(File, ReadsBackWhatWasWritten) {
    const std::string text("a\0b\n\xff", 5);
    write_file_atomic(path("a"), text);
    EXPECT_EQ(read_text_file(path("a"), 5), text);
    const std::vector<std::byte> bytes = read_file(path("a"), 5);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), text);
    write_file_atomic(path("a"), std::string_view());
    EXPECT_EQ(read_text_file(path("a"), 0), "");
}

TEST_F(File, OneByteOverTheLimitIsRefused) {
    write_file_atomic(path("a"), std::string_view("12345"));
    const Error error = thrown_by([&] { read_file(path("a"), 4); });
    EXPECT_EQ(std::string(error.what()), path("a").string() + ": 5 bytes; expected at most 4 bytes");
    EXPECT_EQ(error.info().fault, Fault::Input);
}

TEST_F(File, BeginningIsAtMostWhatIsThereAndNeverNothing) {
    write_file_atomic(path("a"), std::string_view("12345"));
    EXPECT_EQ(read_beginning(path("a"), 3).size(), 3U);
    EXPECT_EQ(read_beginning(path("a"), 30).size(), 5U);
    write_file_atomic(path("empty"), std::string_view());
    EXPECT_THAT(thrown_by([&] { read_beginning(path("empty"), 3); }).what(), HasSubstr("an empty file"));
}

TEST_F(File, HashOfAFileIsThatOfItsBytes) {
    std::string text(3'000'001, 'x');  // longer than one read
    text[2'500'000] = 'y';
    write_file_atomic(path("a"), text);
    EXPECT_EQ(hash_file(path("a")), Hasher().bytes(std::as_bytes(std::span(text))).digest());
    EXPECT_EQ(hash_file(folder_.path()), std::nullopt);
}

TEST_F(File, WritingCreatesFoldersAndReplacesTheOldContent) {
    write_file_atomic(path("x/y/z"), std::string_view("old"));
    write_file_atomic(path("x/y/z"), std::string_view("new"));
    EXPECT_EQ(read_text_file(path("x/y/z"), 10), "new");
    EXPECT_THAT(names(), testing::ElementsAre("x"));
}

TEST_F(File, LongestPossibleNameCanBeWritten) {
    const std::string name(255, 'n');
    write_file_atomic(path(name), std::string_view("x"));
    EXPECT_THAT(names(), testing::ElementsAre(name));
}

TEST_F(File, FolderThatIsAFileFailsAndStays) {
    write_file_atomic(path("a"), std::string_view("old"));
    EXPECT_EQ(thrown_by([&] { write_file_atomic(path("a/b"), std::string_view("x")); }).info().fault, Fault::System);
    EXPECT_EQ(read_text_file(path("a"), 10), "old");
    EXPECT_THAT(names(), testing::ElementsAre("a"));
}

TEST_F(File, ReadersSeeOldOrNewContentWhole) {
    constexpr std::size_t kSize = 100'000;
    write_file_atomic(path("a"), std::string(kSize, '0'));
    std::vector<std::jthread> writers;
    for (const char content : {'1', '2'})
        writers.emplace_back([&, content] {
            for (int i = 0; i < 20; ++i) write_file_atomic(path("a"), std::string(kSize, content));
        });
    for (int i = 0; i < 100; ++i) {
        const std::string text = read_text_file(path("a"), kSize);
        ASSERT_EQ(text, std::string(kSize, text.at(0)));
    }
    writers.clear();  // joins
    EXPECT_THAT(names(), testing::ElementsAre("a"));
}

TEST(Hash, EmptyInputHasThePublishedXxh3Digest) {
    // XXH3_128bits of no bytes with seed 0, from xxHash's own sanity checks.
    EXPECT_EQ(Hasher().digest().hex(), "99aa06d3014798d86001c324468d497f");
}

TEST(Hash, HexPrintsHighHalfFirstWithLeadingZeros) {
    EXPECT_EQ((Hash128{.low = 0xab, .high = 0x1}).hex(), "000000000000000100000000000000ab");
}

TEST(Hash, TextsAreHashedWithTheirLengths) {
    EXPECT_NE(Hasher().text("ab").text("c").digest(), Hasher().text("a").text("bc").digest());
    EXPECT_NE(Hasher().text("").digest(), Hasher().digest());
    EXPECT_NE(Hasher().text("a").digest(), Hasher().bytes(test::bytes_of("a")).digest());
}

TEST_F(Outputs, FilesOfTheirOwnPassAndNothingIsWritten) {
    const std::vector<std::filesystem::path> inputs{path("source.json"), path("source.json"), path("missing.json")};
    const std::vector<Output> outputs{{"--capture", path("a.PNG"), ".png"},
                                      {"--benchmark", path("new/folder/a.json")},
                                      {"--record", "relative.jsonl"}};
    EXPECT_NO_THROW(check_outputs(inputs, outputs));
    EXPECT_FALSE(std::filesystem::exists(path("new")));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(Outputs, AnotherOutputIsRefusedWhetherOrNotItExists) {
    write_file_atomic(path("old.png"), "");
    for (const char* name : {"new.png", "old.png"})
        EXPECT_THAT(refusal({{"--capture", path(name)}, {"--capture-linear", folder_.path() / "." / name}}),
                    HasSubstr("the same file as the output of --capture"));
}

TEST_F(Outputs, AnExtensionOfAnotherFormatIsRefused) {
    for (const char* name : {"a.jpg", "a", "a.png.exr", ".png"})
        EXPECT_THAT(refusal({{"--capture", path(name), ".png"}}), HasSubstr("expected .png")) << name;
}

}  // namespace

}  // namespace rowland
