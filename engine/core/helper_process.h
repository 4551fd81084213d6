#pragma once

#include <cstddef>
#include <cstdint>

// The other side of ChildProcess: helper_process_posix.cpp, helper_process_windows.cpp. A helper program compiles this
// source itself instead of linking the library, so that it may be built with other options.
namespace rowland {

/// To be called first. The helper ends when the program that started it is killed, leaves no core dump, and learns from
/// send_to_starter() that nobody reads.
void prepare_helper();

/// Fills `data`; false if the program that started this one has ended.
bool receive_from_starter(void* data, std::size_t size);
/// False if the program that started this one has ended.
bool send_to_starter(const void* data, std::size_t size);

/// From now on allocations fail that would take this process over so many bytes: of address space on POSIX systems, of
/// committed memory on Windows. Another call sets another limit. Ends the process if the system refuses.
void limit_memory(std::uint64_t bytes);

}  // namespace rowland
