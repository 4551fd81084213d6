#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland {

namespace {

using testing::HasSubstr;

class File : public testing::Test {
 protected:
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

    std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            result.push_back(entry.path().filename().string());
        return result;
    }

    test::TemporaryFolder folder_;
};

template <typename Action>
Error thrown_by(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return Error({});
}

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

TEST_F(File, HugeSparseFileIsRefusedBeforeAnythingIsAllocated) {
    std::ofstream(path("sparse")).put('x');
    // 8 EiB where the file system allows it, else less; allocating even the least of these would fail or be noticed.
    for (off_t size = off_t{1} << 62; ::truncate(path("sparse").c_str(), size) != 0; size /= 2)
        ASSERT_GT(size, off_t{1} << 40);
    EXPECT_THAT(thrown_by([&] { read_file(path("sparse"), 1 << 20); }).what(), HasSubstr("expected at most"));
}

TEST_F(File, WhatIsNoRegularFileIsRefusedAtOnce) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    // A pipe without a writer must not be waited for; this test would hang.
    EXPECT_THAT(thrown_by([&] { read_file(path("pipe"), 10); }).what(), HasSubstr("not a regular file"));
    EXPECT_THAT(thrown_by([&] { read_file(folder_.path(), 10); }).what(), HasSubstr("not a regular file"));
    EXPECT_THAT(thrown_by([&] { read_file("/dev/zero", 10); }).what(), HasSubstr("not a regular file"));
    const Error missing = thrown_by([&] { read_file(path("missing"), 10); });
    EXPECT_THAT(missing.what(), HasSubstr("No such file"));
    EXPECT_EQ(missing.info().fault, Fault::Input);
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
    ASSERT_EQ(::truncate(path("a").c_str(), off_t{1} << 40), 0);
    EXPECT_EQ(hash_file(path("a")), std::nullopt);
}

TEST_F(File, UnreadableFileIsRefused) {
    write_file_atomic(path("secret"), std::string_view("x"));
    ASSERT_EQ(::chmod(path("secret").c_str(), 0), 0);
    ASSERT_EQ(::chmod(folder_.path().c_str(), 0755), 0);
    // Permissions do not bind the superuser, so the test reads as somebody else.
    const bool superuser = ::geteuid() == 0;
    if (superuser && ::seteuid(65534) != 0) GTEST_SKIP() << "cannot become another user";
    const Error error = thrown_by([&] { read_file(path("secret"), 10); });
    if (superuser) {
        ASSERT_EQ(::seteuid(0), 0);
    }
    EXPECT_THAT(error.what(), HasSubstr("Permission denied"));
    EXPECT_EQ(error.info().fault, Fault::Input);
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

TEST_F(File, OldContentSurvivesAFullDiskAndNothingElseIsLeft) {
    write_file_atomic(path("a"), std::string_view("old"));
    // A limit on file sizes fails a write half-way, as a full disk does.
    rlimit old_limit = {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small = {.rlim_cur = 1000, .rlim_max = old_limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Error error = thrown_by([&] { write_file_atomic(path("a"), std::string(5000, 'x')); });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
    std::signal(SIGXFSZ, old_handler);

    EXPECT_THAT(error.what(), HasSubstr("writing failed: File too large"));
    EXPECT_EQ(error.info().fault, Fault::System);
    EXPECT_EQ(read_text_file(path("a"), 10), "old");
    EXPECT_THAT(names(), testing::ElementsAre("a"));
}

TEST_F(File, FolderThatIsAFileFailsAndStays) {
    write_file_atomic(path("a"), std::string_view("old"));
    EXPECT_EQ(thrown_by([&] { write_file_atomic(path("a/b"), std::string_view("x")); }).info().fault, Fault::System);
    EXPECT_EQ(read_text_file(path("a"), 10), "old");
    EXPECT_THAT(names(), testing::ElementsAre("a"));
}

TEST_F(File, FoldersPipesAndDevicesAreNotReplaced) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    std::filesystem::create_directory(path("folder"));
    std::filesystem::create_symlink("/dev/null", path("link"));
    for (const char* name : {"pipe", "folder", "link"}) {
        const Error error = thrown_by([&] { write_file_atomic(path(name), std::string_view("x")); });
        EXPECT_THAT(error.what(), HasSubstr("not a regular file")) << name;
    }
    EXPECT_THAT(names(), testing::UnorderedElementsAre("pipe", "folder", "link"));
    EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
    EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
}

TEST_F(File, NewFilesHaveThePermissionsTheMaskGrants) {
    const mode_t mask = ::umask(027);
    write_file_atomic(path("a"), std::string_view("x"));
    EXPECT_EQ(::umask(mask), mode_t{027}) << "the mask was changed";
    struct stat status = {};
    ASSERT_EQ(::stat(path("a").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, mode_t{0640});
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

class Outputs : public testing::Test {
 protected:
    Outputs() { write_file_atomic(path("source.json"), "{}"); }
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    std::string refusal(const std::vector<Output>& outputs) const {
        const std::vector<std::filesystem::path> inputs{path("source.json")};
        return test::message_of([&] { check_outputs(inputs, outputs); });
    }

    test::TemporaryFolder folder_;
};

TEST_F(Outputs, FilesOfTheirOwnPassAndNothingIsWritten) {
    const std::vector<std::filesystem::path> inputs{path("source.json"), path("source.json"), path("missing.json")};
    const std::vector<Output> outputs{{"--capture", path("a.PNG"), ".png"},
                                      {"--benchmark", path("new/folder/a.json")},
                                      {"--record", "relative.jsonl"}};
    EXPECT_NO_THROW(check_outputs(inputs, outputs));
    EXPECT_FALSE(std::filesystem::exists(path("new")));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(Outputs, AnInputIsRefusedByWhateverName) {
    std::filesystem::create_symlink("source.json", path("link.json"));
    std::filesystem::create_hard_link(path("source.json"), path("hard.json"));
    std::filesystem::create_directory_symlink(folder_.path(), path("folder"));
    for (const char* name : {"source.json", "./source.json", "new/../source.json", "link.json", "hard.json",
                             "folder/source.json", "folder/folder/link.json"})
        EXPECT_THAT(refusal({{"--output", path(name)}}), HasSubstr("--output")) << name;
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

TEST_F(Outputs, WhatCannotBeWrittenIsRefused) {
    std::filesystem::create_symlink("loop", path("loop"));
    const std::string long_name(256, 'n');
    const std::vector<std::filesystem::path> names{"/dev/full",
                                                   "/proc/nowhere/a.png",
                                                   "/dev/null/a.png",
                                                   path("source.json/a"),
                                                   folder_.path(),
                                                   path("new/"),
                                                   "",
                                                   path("loop"),
                                                   path("loop/a"),
                                                   path(long_name),
                                                   path("new") / long_name,
                                                   path(std::string(5000, '/') + "a")};
    for (const std::filesystem::path& name : names)
        EXPECT_THAT(refusal({{"--capture", name}}), HasSubstr("--capture")) << name;
}

}  // namespace

}  // namespace rowland
