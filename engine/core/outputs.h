#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace rowland {

/// A file that a program is to write.
struct Output {
    std::string option;  ///< that names it, as "--capture"
    std::filesystem::path path;
    std::string extension = {};  ///< of its format, as ".png", in either case; empty: any
};

/// To be called before work begins. Throws Error (input) for an output that
/// - has another extension than its format,
/// - is one of the inputs or another output, whatever name or link leads to it,
/// - cannot be written: it is a folder or a device, or its folder takes no files and cannot be created.
/// Leaves nothing on the disk. Folders that are missing are created later, by write_file_atomic().
void check_outputs(std::span<const std::filesystem::path> inputs, std::span<const Output> outputs);

}  // namespace rowland
