#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rowland::platform {

/// Whether this library was compiled for debugging (without NDEBUG). Then contexts are debug contexts by default.
bool debug_build();

inline constexpr const char* gpu_variable = "ROWLAND_GPU";

/// What a program asks for: `option`, or else what the environment variable ROWLAND_GPU says; empty: no choice.
std::string wanted_gpu(const std::string& option);

/// A GPU as its driver names it.
struct GpuName {
    std::string renderer;  ///< GL_RENDERER
    std::string vendor;    ///< GL_VENDOR
    std::string pci_slot;  ///< as "0000:01:00.0"; empty where it is unknown
};

/// Environment variables by which the drivers of a display that another GPU shows draw on this one. A window has no
/// other way to a GPU: neither GLX nor a Wayland display lists them. Read when a context is made.
std::vector<std::pair<std::string, std::string>> offload_variables(const GpuName& gpu);

/// Where a choice is made, finds the GPU and sets its offload_variables(), but for those that are set; for windows that
/// open later. No other thread may read the environment meanwhile. Returns the GPU's renderer, or an empty text if no
/// choice is made. Throws Error (input) that lists the GPUs if none is the one that is asked for.
std::string choose_gpu_of_windows(const std::string& option);

/// Throws Error (system) if the current context draws on another GPU than the `chosen` one; empty: any.
void require_gpu_of_window(const std::string& chosen);

struct HeadlessOptions {
    bool debug = debug_build();  ///< a debug context: the driver reports errors through KHR_debug (gpu/context.h)
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
