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

/// Environment variables that make a driver render on this GPU for a display that another GPU shows (render offload).
/// A window has no other way to choose a GPU: neither GLX nor a Wayland display lists them. Drivers read the variables
/// when a context is made.
std::vector<std::pair<std::string, std::string>> offload_variables(const GpuName& gpu);

/// If wanted_gpu() names a GPU, finds it and sets its offload_variables() for windows that open later, except variables
/// that are set already. No other thread may read the environment meanwhile. Returns the GPU's GL_RENDERER, or an empty
/// text if no GPU is named. Throws as HeadlessContext does.
std::string choose_gpu_of_windows(const std::string& option);

/// Throws Error (system) if the current context's GL_RENDERER is not `chosen`; empty: any is accepted.
void require_gpu_of_window(const std::string& chosen);

struct HeadlessOptions {
    bool debug = debug_build();  ///< a debug context: the driver reports errors through KHR_debug (gpu/context.h)
    /// The number of a GPU or a part of its name; if none matches, as for "?", the error lists them. Empty: what the
    /// environment variable ROWLAND_GPU says, or the first.
    std::string gpu{};
};

/// An OpenGL 4.5 core context without a window, so everything is drawn into framebuffer objects. Takes the GPU that is
/// asked for, or the first hardware device there is, or the software renderer. By EGL it needs neither X nor Wayland;
/// on Windows the display's driver draws. Current on the thread that made it, until another context is made current
/// there; several may live in one process.
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
