#pragma once

#include <chrono>

#include "engine/app/window_loop.h"

namespace rowland::inspector {

/// Draws while something changes, and rests when nothing does.
class Redraw {
 public:
    using Clock = std::chrono::steady_clock;

    /// What the loop does next. `changed`: what the window shows may have changed since the last call; `working`:
    /// results of background work are to come.
    app::Next next(bool changed, bool working, Clock::time_point now) {
        if (changed) {
            frames_ = kFrames;
            until_ = now + kAfterwards;
        }
        if (frames_ > 0) --frames_;
        if (frames_ > 0 || now < until_) return app::Next::Frame;
        return working ? app::Next::Watch : app::Next::Wait;
    }

 private:
    /// ImGui places a new window in its second frame, and ui::InputFeed passes a fast drag in three.
    static constexpr int kFrames = 7;
    /// A modal dialog fades in.
    static constexpr std::chrono::milliseconds kAfterwards{250};

    int frames_ = 0;
    Clock::time_point until_{};
};

}  // namespace rowland::inspector
