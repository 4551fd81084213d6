#pragma once

#include <filesystem>
#include <string>

namespace rowland::app {

/// The first path that no file has: screenshot_0000.png, screenshot_0001.png, … in `folder`, for the stem "screenshot"
/// and the extension ".png".
std::filesystem::path unused_file(const std::filesystem::path& folder, const std::string& stem,
                                  const std::string& extension);

}  // namespace rowland::app
