#include <windows.h>

#include <algorithm>
#include <cstdlib>

#include "engine/core/helper_process.h"

namespace rowland {

namespace {

/// Calls `transfer`, which is ReadFile() or WriteFile(), until all bytes have passed.
template <typename Byte, typename Transfer>
bool exchange(Byte* data, std::size_t size, const Transfer& transfer) {
    // The pipe is the standard input, and works in both directions.
    const HANDLE pipe = GetStdHandle(STD_INPUT_HANDLE);
    for (std::size_t done = 0; done < size;) {
        DWORD count = 0;
        const auto part = static_cast<DWORD>(std::min<std::size_t>(size - done, 1 << 16));
        if (transfer(pipe, data + done, part, &count, nullptr) == 0 || count == 0) return false;
        done += count;
    }
    return true;
}

}  // namespace

void prepare_helper() {
    // The starter's job ends this process with the starter. A crash must not ask the user anything.
    SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);
}

bool receive_from_starter(void* data, std::size_t size) {
    return exchange(static_cast<char*>(data), size, ReadFile);
}

bool send_to_starter(const void* data, std::size_t size) {
    return exchange(static_cast<const char*>(data), size, WriteFile);
}

void limit_memory(std::uint64_t bytes) {
    // Within the starter's job, as Windows 8 and later nest jobs.
    static const HANDLE job = [] {
        const HANDLE own = CreateJobObjectW(nullptr, nullptr);
        if (own == nullptr || AssignProcessToJobObject(own, GetCurrentProcess()) == 0) std::_Exit(1);
        return own;
    }();
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_PROCESS_MEMORY;
    limits.ProcessMemoryLimit = bytes;
    if (SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits) == 0) std::_Exit(1);
}

}  // namespace rowland
