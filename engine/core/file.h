#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rowland {

/// Reads a whole file. Throws Error (input) if it is missing, not a regular file, unreadable or larger than
/// `max_bytes`.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes);
std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes);

/// Creates a folder and its missing parents. Throws Error (system).
void create_folder(const std::filesystem::path& path);

/// Replaces the file `path`: readers see the old file or the complete new one, even if the program is killed. Creates
/// the folder. Throws Error (system), leaving the old file, if anything fails, and Error (input) if `path` is a folder,
/// a device or a pipe.
void write_file_atomic(const std::filesystem::path& path, std::span<const std::byte> data);
void write_file_atomic(const std::filesystem::path& path, std::string_view text);
/// The same with content that lies in parts.
void write_file_atomic(const std::filesystem::path& path, std::span<const std::span<const std::byte>> parts);

/// Throws the Error that write_file_atomic(path, ...) would throw before it writes: tries a file in the nearest folder
/// that exists, and leaves nothing of it.
void require_writable(const std::filesystem::path& path);

}  // namespace rowland
