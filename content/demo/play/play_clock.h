#pragma once

#include <chrono>
#include <span>
#include <vector>

#include "content/demo/play/play.h"
#include "content/demo/play/recording.h"
#include "engine/platform/frame_pacing.h"

namespace rowland::demo {

/// A frame's events fall on its steps evenly and in order, the first one on the first, but a mouse button comes up with
/// what was before it: those of step `step` of `steps`. What happened during a long frame is so neither all at once nor
/// out of order, and a drag keeps about the speed it had until it ends, in its last frame or at the start of the next.
std::span<const PlayEvent> events_of_step(std::span<const PlayEvent> events, int step, int steps);

/// Cuts frames into the steps of a play and deals their events out to them.
class PlayClock {
 public:
    /// Lives through a frame of that length in which `events` happened; those of frames shorter than a step wait for
    /// the next, and a reading of the game pad that says nothing new counts as none. What the play gets is also
    /// recorded, if there is a recorder.
    void live(Play& play, std::chrono::nanoseconds frame, std::vector<PlayEvent> events, Recorder* recorder);

    /// Plays a frame of that length from a recording, which began with the play; false once it is over.
    bool replay(Play& play, std::chrono::nanoseconds frame, const Recording& recording);

 private:
    bool says_nothing_new(const PlayEvent& event);

    // A picture a second is the slowest at which a hand still keeps its speed.
    platform::FixedStep pace_{kStepsPerSecond, std::chrono::seconds(1)};
    std::vector<PlayEvent> waiting_;
    platform::GamepadEvent pad_;  ///< as last read
};

}  // namespace rowland::demo
