#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/handle.h"

namespace rowland::gpu {

struct PassTime {
    std::string name;
    double cpu_ms = 0.0;           ///< in this frame, or in the last one while no pass has run in this one
    std::optional<double> gpu_ms;  ///< in the last frame that the GPU has finished; null before
};

/// Times the passes of every frame on CPU and GPU without waiting for the GPU. A pass that runs several times in a
/// frame counts as their sum.
class PassTimes {
 public:
    PassTimes();

    /// Times the pass between construction and destruction; with null it does nothing. Passes may nest.
    class Scope {
     public:
        Scope(PassTimes* times, std::string_view name);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

     private:
        PassTimes* times_;
        std::size_t run_ = 0;
        std::chrono::steady_clock::time_point start_;
    };

    /// To be called once before the first pass of each frame.
    void begin_frame();
    /// The passes of this frame, or of the last one while none has run in this one, in the order in which they first
    /// ran.
    std::vector<PassTime> latest() const;

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    struct Total {
        std::string name;
        double ms = 0.0;
    };
    /// A frame that the GPU may not have finished: queries 2i and 2i + 1 are the start and the end of its i-th pass.
    struct QueuedFrame {
        std::vector<Handle<Release>> queries;
        std::vector<std::string> passes;
        bool pending = false;
    };

    void write_time(std::size_t query);
    void collect_finished();
    static bool is_finished(const QueuedFrame& frame);
    static std::vector<Total> gpu_totals(const QueuedFrame& frame);

    std::vector<Total> runs_;  ///< of this frame; milliseconds of the CPU
    std::vector<Total> last_cpu_;
    std::vector<Total> finished_gpu_;
    std::array<QueuedFrame, 4> ring_;
    std::size_t oldest_ = 0;
    std::optional<std::size_t> slot_;  ///< this frame's; null while the ring is full because the GPU lags
    bool software_;                    ///< llvmpipe and its like
};

}  // namespace rowland::gpu
