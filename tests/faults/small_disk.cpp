#include "tests/faults/small_disk.h"

#include <sys/mount.h>
#include <sys/statvfs.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace rowland::test {

SmallDisk::SmallDisk(std::size_t kilobytes) {
    const std::string options = "size=" + std::to_string(kilobytes) + "k";
    mounted_ = ::mount("rowland-test", path().c_str(), "tmpfs", MS_NOSUID | MS_NODEV, options.c_str()) == 0;
}

SmallDisk::~SmallDisk() {
    if (mounted_) ::umount2(path().c_str(), MNT_DETACH);
}

void SmallDisk::fill_but(std::size_t kilobytes) const {
    struct statvfs state = {};
    if (::statvfs(path().c_str(), &state) != 0) throw std::runtime_error("cannot look at " + path().string());
    const std::size_t free = state.f_bavail * state.f_frsize;
    if (free < 1024 * kilobytes) throw std::runtime_error("there is less room than that");
    std::ofstream(path() / "filling") << std::string(free - 1024 * kilobytes, 'x');
}

void SmallDisk::free_again() const {
    std::filesystem::remove(path() / "filling");
}

void SmallDisk::make_read_only() const {
    if (::mount(nullptr, path().c_str(), nullptr, MS_REMOUNT | MS_RDONLY | MS_NOSUID | MS_NODEV, nullptr) != 0)
        throw std::runtime_error("cannot remount " + path().string());
}

}  // namespace rowland::test
