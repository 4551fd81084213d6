#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/gpu/handle.h"

namespace rowland::gpu {

/// Consecutive draws of one kind.
struct MeteredRun {
    struct Draw {
        std::uint64_t object = 0;
        std::uint64_t samples = 0;  ///< that passed the depth test when it was drawn
    };

    std::uint64_t kind = 0;
    double gpu_ms = 0.0;
    std::vector<Draw> draws;
};

/// Counts the samples of draws and times runs of them, without waiting for the GPU.
class DrawMeter {
 public:
    DrawMeter();

    /// Measures the draw between construction and destruction; with null it does nothing. Not to be nested. It
    /// continues the current run if that is of its kind, and else begins another.
    class Scope {
     public:
        Scope(DrawMeter* meter, std::uint64_t kind, std::uint64_t object);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

     private:
        DrawMeter* meter_;
    };

    /// To be called once before the first draw of each frame. Ends the previous frame.
    void begin_frame();
    /// Ends the current run: to be called before draws that are not measured.
    void end_run();
    /// The runs of the newest frame that the GPU has finished; null if it has finished none since the last call.
    std::optional<std::vector<MeteredRun>> take_finished();

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    /// Query objects of one target, created when they are first needed.
    class Queries {
     public:
        explicit Queries(GLenum target) : target_(target) {}
        GLuint at(std::size_t index);

     private:
        GLenum target_;
        std::vector<Handle<Release>> names_;
    };
    /// A frame that the GPU may not have finished.
    struct QueuedFrame {
        Queries times{GL_TIMESTAMP};         ///< 2i, 2i + 1: start and end of run i
        Queries samples{GL_SAMPLES_PASSED};  ///< of the draws of all runs, in order
        std::vector<MeteredRun> runs;
        std::size_t draws = 0;
        bool pending = false;
    };

    bool read(QueuedFrame& frame) const;
    void write_time(std::size_t query);

    std::array<QueuedFrame, 4> ring_;
    std::size_t next_ = 0;
    QueuedFrame* frame_ = nullptr;  ///< this one; null while the ring is full because the GPU lags
    bool in_run_ = false;
    std::optional<std::vector<MeteredRun>> finished_;
    bool software_;  ///< llvmpipe and its like
};

}  // namespace rowland::gpu
