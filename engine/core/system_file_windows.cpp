#include <fmt/format.h>
#include <windows.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "engine/core/error.h"
#include "engine/core/system_file.h"
#include "engine/core/windows_text.h"

namespace rowland {

namespace {

constexpr DWORD kShareAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
constexpr std::size_t kLargestTransfer = std::size_t{1} << 30;  // Windows counts bytes in 32 bits

HANDLE handle_of(const OpenFile& file) {
    return reinterpret_cast<HANDLE>(file.handle());
}

OpenFile open_file(const std::filesystem::path& path, DWORD access, DWORD share, DWORD disposition) {
    // This flag also opens folders, which callers tell apart.
    return {path, reinterpret_cast<std::intptr_t>(CreateFileW(long_path(path).c_str(), access, share, nullptr,
                                                              disposition, FILE_FLAG_BACKUP_SEMANTICS, nullptr))};
}

bool is_regular(const OpenFile& file, BY_HANDLE_FILE_INFORMATION& information) {
    return GetFileType(handle_of(file)) == FILE_TYPE_DISK &&
           GetFileInformationByHandle(handle_of(file), &information) != 0 &&
           (information.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
}

DWORD transfer_size(std::size_t left) {
    return static_cast<DWORD>(std::min(left, kLargestTransfer));
}

}  // namespace

OpenFile OpenFile::for_reading(const std::filesystem::path& path) {
    OpenFile file = open_file(path, GENERIC_READ, kShareAll, OPEN_EXISTING);
    if (!file.is_open()) refuse_unreadable(path, last_windows_failure());
    return file;
}

OpenFile OpenFile::for_appending(const std::filesystem::path& path) {
    OpenFile file = open_file(path, GENERIC_READ | GENERIC_WRITE, kShareAll, OPEN_ALWAYS);
    if (!file.is_open()) fail_action(path, "opening", last_windows_failure());
    return file;
}

OpenFile::~OpenFile() {
    if (is_open()) CloseHandle(handle_of(*this));
}

std::optional<std::uint64_t> OpenFile::regular_size() const {
    BY_HANDLE_FILE_INFORMATION information{};
    if (!is_regular(*this, information)) return std::nullopt;
    return std::uint64_t{information.nFileSizeHigh} << 32 | information.nFileSizeLow;
}

std::size_t OpenFile::read(std::span<std::byte> buffer) const {
    std::size_t done = 0;
    while (done < buffer.size()) {
        DWORD count = 0;
        if (ReadFile(handle_of(*this), buffer.data() + done, transfer_size(buffer.size() - done), &count, nullptr) == 0)
            fail_action(path_, "reading", last_windows_failure());
        if (count == 0) break;
        done += count;
    }
    return done;
}

void OpenFile::write(std::span<const std::byte> data) const {
    SetFilePointerEx(handle_of(*this), {}, nullptr, FILE_END);
    while (!data.empty()) {
        DWORD count = 0;
        if (WriteFile(handle_of(*this), data.data(), transfer_size(data.size()), &count, nullptr) == 0)
            fail_action(path_, "writing", last_windows_failure());
        data = data.subspan(count);
    }
}

void OpenFile::cut(std::uint64_t size) const {
    LARGE_INTEGER end;
    end.QuadPart = static_cast<LONGLONG>(size);
    if (SetFilePointerEx(handle_of(*this), end, nullptr, FILE_BEGIN) == 0 || SetEndOfFile(handle_of(*this)) == 0)
        fail_action(path_, "shortening", last_windows_failure());
}

bool OpenFile::try_lock() const {
    // Windows keeps others from reading a locked byte, so the byte lies where no file has any.
    OVERLAPPED position{};
    position.OffsetHigh = 0x40000000;
    if (LockFileEx(handle_of(*this), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &position) != 0)
        return true;
    const DWORD code = GetLastError();
    return code != ERROR_LOCK_VIOLATION && code != ERROR_IO_PENDING;
}

namespace {

std::intptr_t create(const std::filesystem::path& target, std::filesystem::path& temporary) {
    for (int attempt = 0;; ++attempt) {
        temporary = temporary_name(target);
        HANDLE made = CreateFileW(long_path(temporary).c_str(), GENERIC_WRITE | DELETE,
                                  FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr, CREATE_NEW, 0, nullptr);
        if (made != INVALID_HANDLE_VALUE) return reinterpret_cast<std::intptr_t>(made);
        if (GetLastError() != ERROR_FILE_EXISTS || attempt == kMostTemporaryNames)
            fail_action(target, "creating a temporary file beside it", last_windows_failure());
    }
}

/// Does nothing on a file system that takes no marks.
void mark_for_deletion(const OpenFile& file, bool marked) {
    FILE_DISPOSITION_INFO disposition{static_cast<BOOLEAN>(marked)};
    SetFileInformationByHandle(handle_of(file), FileDispositionInfo, &disposition, sizeof disposition);
}

/// Renames the open file over the target. With `as_posix` that works while others read the target, from Windows 10 on.
bool rename(const OpenFile& file, const std::filesystem::path& target, bool as_posix) {
    const std::wstring name = long_path(std::filesystem::absolute(target));
    std::vector<std::byte> memory(sizeof(FILE_RENAME_INFO) + name.size() * sizeof(wchar_t));
    auto& information = *reinterpret_cast<FILE_RENAME_INFO*>(memory.data());
    constexpr DWORD kReplace = 1;         // FILE_RENAME_FLAG_REPLACE_IF_EXISTS
    constexpr DWORD kPosixSemantics = 2;  // FILE_RENAME_FLAG_POSIX_SEMANTICS
    constexpr int kFileRenameInfoEx = 22;
    const DWORD flags = as_posix ? kReplace | kPosixSemantics : kReplace;
    std::copy_n(reinterpret_cast<const std::byte*>(&flags), sizeof flags, memory.data());
    information.FileNameLength = static_cast<DWORD>(name.size() * sizeof(wchar_t));
    std::copy(name.begin(), name.end(), information.FileName);
    return SetFileInformationByHandle(
               handle_of(file), as_posix ? static_cast<FILE_INFO_BY_HANDLE_CLASS>(kFileRenameInfoEx) : FileRenameInfo,
               &information, static_cast<DWORD>(memory.size())) != 0;
}

}  // namespace

/// The new file is marked for deletion while it is written, so that the system removes it when the program is killed.
/// It has a name meanwhile, but nobody can open it.
Replacement::Replacement(const std::filesystem::path& target)
    : target_(target), file_(target, create(target, temporary_)) {
    mark_for_deletion(file_, true);
}

Replacement::~Replacement() {
    // Needed where renaming failed.
    if (!temporary_.empty()) mark_for_deletion(file_, true);
}

void Replacement::replace_target() {
    if (FlushFileBuffers(handle_of(file_)) == 0) fail_action(target_, "writing", last_windows_failure());
    mark_for_deletion(file_, false);
    // Virus scanners and indexers open new files for a moment, and no event tells when they are done.
    constexpr int kMostAttempts = 100;
    for (int attempt = 0; !rename(file_, target_, true) && !rename(file_, target_, false); ++attempt) {
        const std::error_code failure = last_windows_failure();
        const bool taken = failure.value() == ERROR_ACCESS_DENIED || failure.value() == ERROR_SHARING_VIOLATION;
        if (!taken || attempt == kMostAttempts) fail_action(target_, "renaming", failure);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    temporary_.clear();
}

void require_no_device(const std::filesystem::path& path) {
    if (!path.has_filename()) refuse_input(path.string(), "", "names a folder", "a file to write");
    constexpr DWORD kNoAccess = 0;
    const OpenFile old = open_file(path, kNoAccess, kShareAll, OPEN_EXISTING);
    const std::error_code reason = last_windows_failure();
    BY_HANDLE_FILE_INFORMATION information{};
    if (old.is_open()) {
        if (!is_regular(old, information))
            refuse_input(path.string(), "", "exists and is not a regular file", "a file to write");
        return;
    }
    for (const DWORD code : {ERROR_INVALID_NAME, ERROR_BAD_PATHNAME, ERROR_FILENAME_EXCED_RANGE})
        if (reason.value() == static_cast<int>(code))
            refuse_input(path.string(), "", reason.message(), "a file to write");
}

std::optional<std::string> file_identity(const std::filesystem::path& path) {
    constexpr DWORD kNoAccess = 0;
    const OpenFile file = open_file(path, kNoAccess, kShareAll, OPEN_EXISTING);
    BY_HANDLE_FILE_INFORMATION information{};
    if (!file.is_open() || GetFileInformationByHandle(handle_of(file), &information) == 0) return std::nullopt;
    return fmt::format("{}:{}:{}", information.dwVolumeSerialNumber, information.nFileIndexHigh,
                       information.nFileIndexLow);
}

}  // namespace rowland
