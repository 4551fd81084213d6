#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rowland::cook {

/// The text of a Makefile-syntax dependency file as make, ninja and CMake read it: `output: dependency...`.
/// `output` is written unchanged, since the build system knows it by that name; dependencies are made absolute.
/// Throws Error (input) for a name with a line break, which the syntax cannot express.
std::string depfile_text(const std::filesystem::path& output, const std::vector<std::filesystem::path>& dependencies);

}  // namespace rowland::cook
