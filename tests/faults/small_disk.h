#pragma once

#include <sys/mount.h>
#include <sys/statvfs.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/files.h"

namespace rowland::test {

/// A file system of its own in memory, that is soon full; unmounted with all that is in it at the end of the scope.
class SmallDisk {
 public:
    /// Mounts nothing, and says so by mounted(), where mounting is not allowed.
    explicit SmallDisk(std::size_t kilobytes) {
        const std::string options = "size=" + std::to_string(kilobytes) + "k";
        mounted_ = ::mount("rowland-test", path().c_str(), "tmpfs", MS_NOSUID | MS_NODEV, options.c_str()) == 0;
    }
    ~SmallDisk() {
        if (mounted_) ::umount2(path().c_str(), MNT_DETACH);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    bool mounted() const { return mounted_; }
    const std::filesystem::path& path() const { return folder_.path(); }
    /// Leaves about so many kilobytes free.
    void fill_but(std::size_t kilobytes) const {
        struct statvfs state = {};
        if (::statvfs(path().c_str(), &state) != 0) throw std::runtime_error("cannot look at " + path().string());
        const std::size_t free = state.f_bavail * state.f_frsize;
        if (free < 1024 * kilobytes) throw std::runtime_error("there is less room than that");
        std::ofstream(path() / "filling") << std::string(free - 1024 * kilobytes, 'x');
    }
    void free_again() const { std::filesystem::remove(path() / "filling"); }
    void make_read_only() const {
        if (::mount(nullptr, path().c_str(), nullptr, MS_REMOUNT | MS_RDONLY | MS_NOSUID | MS_NODEV, nullptr) != 0)
            throw std::runtime_error("cannot remount " + path().string());
    }

 private:
    TemporaryFolder folder_;
    bool mounted_ = false;
};

}  // namespace rowland::test

/// Only the superuser may mount; for others the test is skipped by name. A full disk is also tested without
/// it, by a limit on the size of files (tests/unit/engine/core/file_test.cpp).
#define ROWLAND_NEEDS_MOUNTED(disk) \
    if (!(disk).mounted()) GTEST_SKIP() << "mounting a file system is not allowed here"
