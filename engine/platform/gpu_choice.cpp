#include "engine/platform/gpu_choice.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "engine/core/error.h"
#include "engine/gpu/software_renderer.h"
#include "engine/platform/headless_context.h"

namespace rowland::platform {

std::string wanted_gpu(const std::string& option) {
    const char* variable = std::getenv(gpu_variable);
    return option.empty() && variable != nullptr ? variable : option;
}

std::vector<std::pair<std::string, std::string>> offload_variables(const GpuName& gpu) {
    if (gpu::is_software_renderer(gpu.renderer))
        return {{"LIBGL_ALWAYS_SOFTWARE", "1"}, {"__GLX_VENDOR_LIBRARY_NAME", "mesa"}};
    if (gpu.vendor == "NVIDIA Corporation")
        return {{"__NV_PRIME_RENDER_OFFLOAD", "1"}, {"__GLX_VENDOR_LIBRARY_NAME", "nvidia"}};
    if (gpu.pci_slot.empty()) return {};
    std::string slot = gpu.pci_slot;
    std::ranges::replace_if(
        slot, [](char c) { return c == ':' || c == '.'; }, '_');
    return {{"DRI_PRIME", "pci-" + slot}};
}

std::string choose_gpu_of_windows(const std::string& option) {
    if (wanted_gpu(option).empty()) return {};
    const HeadlessContext chosen({.debug = false, .gpu = option});
    constexpr int kKeep = 0;
    for (const auto& [name, value] : offload_variables(chosen.name())) setenv(name.c_str(), value.c_str(), kKeep);
    return chosen.renderer();
}

void require_gpu_of_window(const std::string& chosen) {
    const std::string found = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    if (chosen.empty() || found == chosen) return;
    fail_system(gpu_variable, fmt::format("a display whose windows draw on \"{}\"", found),
                "set DRI_PRIME=1 (Mesa), or __NV_PRIME_RENDER_OFFLOAD=1 and __GLX_VENDOR_LIBRARY_NAME=nvidia (NVIDIA); "
                "or make no choice",
                fmt::format("\"{}\", which was chosen", chosen));
}

}  // namespace rowland::platform
