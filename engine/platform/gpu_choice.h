#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rowland::platform {

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

}  // namespace rowland::platform
