// Pipes, devices, links, modes, sparse files and limits that Windows does not have, or has in another way.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/unit/engine/core/file_fixtures.h"

namespace rowland {

namespace {

using testing::HasSubstr;

TEST_F(File, HugeSparseFileIsRefusedBeforeAnythingIsAllocated) {
    std::ofstream(path("sparse")).put('x');
    // 4 EiB where the file system allows it, else less; allocating even the least of these would fail or be noticed.
    std::error_code refused = std::make_error_code(std::errc::file_too_large);
    for (std::uintmax_t size = std::uintmax_t{1} << 62; refused; size /= 2) {
        ASSERT_GT(size, std::uintmax_t{1} << 40);
        refused.clear();
        std::filesystem::resize_file(path("sparse"), size, refused);
    }
    EXPECT_THAT(thrown_by([&] { read_file(path("sparse"), 1 << 20); }).what(), HasSubstr("expected at most"));
}

TEST_F(File, HugeSparseFileHasNoHash) {
    write_file_atomic(path("a"), std::string_view("x"));
    std::filesystem::resize_file(path("a"), std::uintmax_t{1} << 40);
    EXPECT_EQ(hash_file(path("a")), std::nullopt);
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

TEST_F(Outputs, AnInputIsRefusedByWhateverName) {
    std::filesystem::create_symlink("source.json", path("link.json"));
    std::filesystem::create_hard_link(path("source.json"), path("hard.json"));
    std::filesystem::create_directory_symlink(folder_.path(), path("folder"));
    for (const char* name : {"source.json", "./source.json", "new/../source.json", "link.json", "hard.json",
                             "folder/source.json", "folder/folder/link.json"})
        EXPECT_THAT(refusal({{"--output", path(name)}}), HasSubstr("--output")) << name;
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
