#include "engine/platform/screen_layout.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>

namespace rowland::platform {

namespace {

std::int64_t common_area(const ScreenArea& a, const ScreenArea& b) {
    const glm::ivec2 low = glm::max(a.position, b.position);
    const glm::ivec2 high = glm::min(a.position + a.size, b.position + b.size);
    const glm::ivec2 size = glm::max(high - low, glm::ivec2(0));
    return std::int64_t{size.x} * size.y;
}

}  // namespace

std::size_t monitor_showing(const ScreenArea& window, std::span<const ScreenArea> monitors) {
    std::size_t best = 0;
    std::int64_t largest = 0;
    for (std::size_t i = 0; i < monitors.size(); ++i) {
        const std::int64_t area = common_area(window, monitors[i]);
        if (area <= largest) continue;
        largest = area;
        best = i;
    }
    return best;
}

}  // namespace rowland::platform
