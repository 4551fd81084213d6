#pragma once

#include <memory>
#include <string>

#include "engine/platform/debug_build.h"
#include "engine/platform/gpu_choice.h"

namespace rowland::platform {

struct HeadlessOptions {
    bool debug = debug_build();  ///< a debug context: the driver reports errors through KHR_debug (see gpu/debug.h)
    /// The number of a GPU or a part of its name, as the error for a wrong one lists them ("?" is always wrong). Empty:
    /// what the environment variable ROWLAND_GPU says, or the first.
    std::string gpu{};
};

/// An OpenGL 4.5 core context without a window: EGL, no surface, so everything is drawn into framebuffer objects. Takes
/// the GPU that is asked for, or the first hardware device there is, or the software renderer; needs neither X nor
/// Wayland. Current on the thread that made it, until another context is made current there; several may live in one
/// process.
class HeadlessContext {
 public:
    /// Throws Error (system) that names what is missing if no device gives OpenGL 4.5 core, and Error (input) that
    /// lists the GPUs if none is the one that is asked for.
    explicit HeadlessContext(const HeadlessOptions& options = {});
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    /// Makes the context current on the calling thread. Throws Error (system).
    void make_current();

    const GpuName& name() const;
    const std::string& renderer() const;  ///< GL_RENDERER
    const std::string& version() const;   ///< GL_VERSION
    /// True on a CPU rasteriser (llvmpipe and its like), whose timings are those of a CPU.
    bool is_software() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rowland::platform
