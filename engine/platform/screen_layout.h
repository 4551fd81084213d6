#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>

namespace rowland::platform {

/// A window or a monitor on the desktop, screen coordinates.
struct ScreenArea {
    glm::ivec2 position{0};
    glm::ivec2 size{0};

    friend bool operator==(const ScreenArea&, const ScreenArea&) = default;
};

/// Index of the monitor that shows the largest part of `window`; the first of equals, 0 (the primary one) if none shows
/// any.
std::size_t monitor_showing(const ScreenArea& window, std::span<const ScreenArea> monitors);

}  // namespace rowland::platform
