#pragma once

#include <chrono>
#include <span>
#include <vector>

#include "content/demo/play/play.h"
#include "content/demo/play/recording.h"
#include "engine/platform/frame_pacing.h"

namespace rowland::demo {

/// Distributes a frame's events over its steps, evenly and in order, the first on the first; returns those of step
/// `step` of `steps`. The release of a mouse button stays with the event before it, so that a drag across a long frame
/// keeps about its speed to its end.
std::span<const PlayEvent> events_of_step(std::span<const PlayEvent> events, int step, int steps);

/// Divides frames into the steps of a play.
class PlayClock {
 public:
    /// Advances the play by a frame of that length in which `events` happened. Events of a frame shorter than a step
    /// wait for the next frame; unchanged game pad readings are dropped. What the play gets goes to `recorder` too, if
    /// there is one.
    void live(Play& play, std::chrono::nanoseconds frame, std::vector<PlayEvent> events, Recorder* recorder);

    /// Plays a frame of that length from a recording, which began with the play; false once it is over.
    bool replay(Play& play, std::chrono::nanoseconds frame, const Recording& recording);

 private:
    bool is_unchanged_pad(const PlayEvent& event);

    // One frame per second is the slowest at which a drag keeps its speed.
    platform::FixedStep pace_{kStepsPerSecond, std::chrono::seconds(1)};
    std::vector<PlayEvent> waiting_;
    platform::GamepadEvent pad_;  ///< as last read
};

}  // namespace rowland::demo
