#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "engine/image/image.h"

namespace rowland::test {

/// Where this run's files go.
inline std::filesystem::path result(const std::string& name) {
    return std::filesystem::path(ROWLAND_RESULT_FOLDER) / name;
}

/// Runs the demo without a window; its status as of std::system.
inline int run_demo(const std::string& arguments) {
    return std::system((std::string(ROWLAND_DEMO) + " --headless " + arguments).c_str());
}

/// The demo's scene-linear picture.
inline image::Image render(const std::string& name, const std::string& arguments, int width = 192, int height = 108) {
    const std::filesystem::path path = result(name + ".exr");
    EXPECT_EQ(run_demo("--width " + std::to_string(width) + " --height " + std::to_string(height) +
                       " --capture-linear '" + path.string() + "' " + arguments),
              0)
        << name;
    return image::load_image(path);
}

}  // namespace rowland::test
