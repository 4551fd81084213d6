#pragma once

#include <filesystem>
#include <string>

namespace rowland::test {

/// A file or folder of the source tree, by its path from the root.
std::filesystem::path source_path(const std::string& path);

/// The source of an asset: a path under content/.
std::filesystem::path content_path(const std::string& path);

}  // namespace rowland::test
