#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <variant>

#include "content/demo/play/action.h"
#include "engine/platform/input.h"

namespace rowland::demo {

/// The window has this size now, in the mouse's units; each >= 1.
struct ResizeEvent {
    glm::ivec2 size{1};
};
/// An action was called for otherwise than by its key, say in a menu.
struct ActionEvent {
    Action action;
};

/// All that a play depends on besides the scene: the same events at the same steps make the same play.
using PlayEvent = std::variant<platform::InputEvent, ResizeEvent, ActionEvent>;

/// A frame's events fall on its steps evenly and in order, the first one on the first: those of step `step` of `steps`.
/// What happened during a long frame is so neither all at once nor out of order; a drag keeps about the speed it had,
/// also if it ends with the first event of the next frame.
inline std::span<const PlayEvent> events_of_step(std::span<const PlayEvent> events, int step, int steps) {
    // Event i falls on step floor(i steps / events).
    const auto begin_of = [&](int s) {
        const auto n = static_cast<std::size_t>(steps);
        return (events.size() * static_cast<std::size_t>(s) + n - 1) / n;
    };
    return events.subspan(begin_of(step), begin_of(step + 1) - begin_of(step));
}

}  // namespace rowland::demo
