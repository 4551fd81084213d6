#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "engine/image/image.h"
#include "tests/support/program.h"

namespace rowland::test {

/// Where this run's files go.
inline std::filesystem::path result(const std::string& name) {
    return std::filesystem::path(ROWLAND_RESULT_FOLDER) / name;
}

/// Runs the demo without a window; its exit code.
inline int run_demo(const std::string& arguments) {
    const Ended ended = run(command(ROWLAND_DEMO, "--headless " + arguments), {.limit = std::chrono::minutes(10)});
    std::fputs(ended.err.c_str(), stderr);
    return ended.code;
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
