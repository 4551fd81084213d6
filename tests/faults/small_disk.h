#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/temporary_folder.h"

namespace rowland::test {

/// A file system of its own in memory, that is soon full; unmounted with all that is in it at the end of the scope.
class SmallDisk {
 public:
    /// Mounts nothing, and says so by mounted(), where mounting is not allowed.
    explicit SmallDisk(std::size_t kilobytes);
    ~SmallDisk();
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    bool mounted() const { return mounted_; }
    const std::filesystem::path& path() const { return folder_.path(); }
    /// Leaves about so many kilobytes free.
    void fill_but(std::size_t kilobytes) const;
    void free_again() const;
    void make_read_only() const;

 private:
    TemporaryFolder folder_;
    bool mounted_ = false;
};

}  // namespace rowland::test

/// Only the superuser may mount; for others the test is skipped by name. A full disk is also tested without
/// it, by a limit on the size of files (tests/unit/engine/core/file_test.cpp).
#define ROWLAND_NEEDS_MOUNTED(disk) \
    if (!(disk).mounted()) GTEST_SKIP() << "mounting a file system is not allowed here"
