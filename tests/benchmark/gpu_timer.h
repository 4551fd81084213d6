#pragma once

#include <optional>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/handle.h"

namespace rowland::gpu {

/// Measures GPU time between begin() and end(). Timers do not nest.
class Timer {
 public:
    Timer();

    void begin();
    void end();
    /// Milliseconds of the last begin–end; null until the GPU has finished it.
    std::optional<double> poll() const;
    /// The same, but waits.
    double wait() const;

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    Handle<Release> query_;
    Framebuffer first_pass_;
};

}  // namespace rowland::gpu
