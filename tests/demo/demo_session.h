#pragma once

#include <filesystem>

#include "content/demo/play/recording.h"
#include "content/demo/session.h"

namespace rowland::test {

/// Of a session in this process, with the build's cooked assets.
inline demo::Options session_options() {
    demo::Options options;
    options.watch = false;
    options.content_folder = std::filesystem::path(ROWLAND_SOURCE_TREE) / "content";
    options.cooked_folder = std::filesystem::path(ROWLAND_DEMO).parent_path().parent_path() / "cooked";
    return options;
}

inline demo::Options cabinet_options() {
    demo::Options options = session_options();
    options.scene = options.cooked_folder / "cabinet.scene";
    return options;
}

inline demo::PlayEvent mouse(double x, double y) {
    return platform::InputEvent(platform::MouseMoveEvent{{x, y}});
}
inline demo::PlayEvent button(bool down) {
    return platform::InputEvent(platform::MouseButtonEvent{platform::MouseButton::Left, down});
}

}  // namespace rowland::test
