#include "engine/platform/gl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>
#include <vector>

#include "engine/core/error.h"
#include "engine/gpu/context.h"
#include "engine/gpu/pipeline_state.h"

namespace rowland::platform {

bool debug_build() {
#ifdef NDEBUG
    return false;
#else
    return true;
#endif
}

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

namespace {

constexpr const char* needed =
    "a driver with EGL and OpenGL 4.5 core (any GPU of the last ten years, or Mesa's llvmpipe)";

[[noreturn]] void fail(std::string found, std::string remedy = "") {
    fail_system("OpenGL without a window", std::move(found), std::move(remedy), needed);
}

/// Whether a word is in a list that is separated by spaces; null: an empty list.
bool has_word(const char* words, std::string_view word) {
    return words != nullptr && fmt::format(" {} ", words).find(fmt::format(" {} ", word)) != std::string::npos;
}

const char* client_extensions() {
    return eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
}

/// An EGL display that may give a context on a GPU.
struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    const char* platform = "";
    std::string pci_slot = {};
};

constexpr const char* kSoftwareDevice = "EGL software device";

/// The device's PCI slot as the kernel names it; empty where the driver or the kernel does not tell.
std::string pci_slot(EGLDeviceEXT device) {
    if (!has_word(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_EXT_device_drm")) return {};
    const char* file = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT);
    if (file == nullptr) return {};
    const std::filesystem::path card = std::filesystem::path("/sys/class/drm") / std::filesystem::path(file).filename();
    std::error_code none;
    return std::filesystem::canonical(card / "device", none).filename().string();
}

/// The EGL devices, in the driver's order.
std::vector<Candidate> devices() {
    const bool enumerable = has_word(client_extensions(), "EGL_EXT_device_enumeration") ||
                            has_word(client_extensions(), "EGL_EXT_device_base");
    if (!enumerable || !has_word(client_extensions(), "EGL_EXT_platform_device")) return {};
    std::array<EGLDeviceEXT, 16> found{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(found.size()), found.data(), &count) != EGL_TRUE) return {};
    std::vector<Candidate> candidates;
    for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = found[static_cast<std::size_t>(i)];
        const bool software = has_word(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
        candidates.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                              software ? kSoftwareDevice : "EGL device", software ? "" : pci_slot(device)});
    }
    return candidates;
}

/// Hardware first. For Mesa's software renderer the surfaceless platform, which every version of Mesa has, comes before
/// its device.
std::vector<Candidate> candidates() {
    std::vector<Candidate> all = devices();
    const auto software = std::stable_partition(
        all.begin(), all.end(), [](const Candidate& candidate) { return candidate.platform != kSoftwareDevice; });
    if (has_word(client_extensions(), "EGL_MESA_platform_surfaceless")) {
        all.insert(software, {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                              "surfaceless"});
    }
    return all;
}

/// A context on the display, or the reason why there is none.
EGLContext create_context(EGLDisplay display, bool debug, std::string& reason) {
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
        reason = "an EGL display that does not initialise";
        return EGL_NO_CONTEXT;
    }
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    for (const char* extension : {"EGL_KHR_surfaceless_context", "EGL_KHR_create_context"}) {
        if (!has_word(extensions, extension)) {
            reason = fmt::format("an EGL display without {}", extension);
            return EGL_NO_CONTEXT;
        }
    }
    constexpr std::array config_attributes{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE ||
        eglChooseConfig(display, config_attributes.data(), &config, 1, &count) != EGL_TRUE || count == 0) {
        reason = "an EGL display without desktop OpenGL";
        return EGL_NO_CONTEXT;
    }
    std::array attributes{EGL_CONTEXT_MAJOR_VERSION_KHR,
                          4,
                          EGL_CONTEXT_MINOR_VERSION_KHR,
                          5,
                          EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                          EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                          EGL_CONTEXT_FLAGS_KHR,
                          debug ? EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR : 0,
                          EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_KHR,
                          EGL_LOSE_CONTEXT_ON_RESET_KHR,
                          EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) {
        // Not every driver can report resets (gpu/context.h).
        attributes[attributes.size() - 3] = EGL_NONE;
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    }
    if (context == EGL_NO_CONTEXT)
        reason = fmt::format("{} without OpenGL 4.5 core", eglQueryString(display, EGL_VENDOR));
    return context;
}

/// Whether `wanted` is the number or, ignoring case, a part of the name.
bool is_wanted(std::string_view wanted, std::size_t number, std::string_view name) {
    if (wanted == std::to_string(number)) return true;
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return wanted.find_first_not_of("0123456789") != std::string_view::npos &&
           !std::ranges::search(name, wanted, {}, lower, lower).empty();
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

struct HeadlessContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    GpuName name;
    std::string version;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    // The display is not terminated: EGL has one per device for the whole process, so other contexts may use it.
    ~State() {
        if (context == EGL_NO_CONTEXT) return;
        if (eglGetCurrentContext() == context) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        eglDestroyContext(display, context);
    }
};

HeadlessContext::HeadlessContext(const HeadlessOptions& options) {
    if (!has_word(client_extensions(), "EGL_EXT_platform_base")) {
        fail("an EGL library without EGL_EXT_platform_base, or none", "install a current libEGL and its driver");
    }
    const std::string wanted = wanted_gpu(options.gpu);
    std::string reason = "neither a hardware device nor the surfaceless platform of Mesa";
    std::vector<std::string> others;
    for (const Candidate& candidate : candidates()) {
        state_ = std::make_unique<State>();
        state_->display = candidate.display;
        state_->context = create_context(candidate.display, options.debug, reason);
        if (state_->context == EGL_NO_CONTEXT) continue;
        make_current();
        state_->name = {gl_string(GL_RENDERER), gl_string(GL_VENDOR), candidate.pci_slot};
        state_->version = gl_string(GL_VERSION);
        const std::string name = fmt::format("{}, {}", renderer(), candidate.platform);
        if (wanted.empty() || is_wanted(wanted, others.size(), name)) return;
        others.push_back(fmt::format("{} = {}", others.size(), name));
    }
    if (others.empty())
        fail(reason, "install the GPU's driver, or Mesa's software renderer (Debian: libgl1-mesa-dri, libegl1)");
    refuse_input(gpu_variable, "", fmt::format("no GPU \"{}\"", wanted),
                 fmt::format("the number or a part of the name of one of: {}", fmt::join(others, "; ")));
}

HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::make_current() {
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE ||
        eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context) != EGL_TRUE) {
        fail("a context that cannot be made current on this thread", "it may still be current on another thread");
    }
    gpu::forget_bound_state();
}

const GpuName& HeadlessContext::name() const {
    return state_->name;
}

const std::string& HeadlessContext::renderer() const {
    return state_->name.renderer;
}

const std::string& HeadlessContext::version() const {
    return state_->version;
}

bool HeadlessContext::is_software() const {
    return gpu::is_software_renderer(renderer());
}

}  // namespace rowland::platform
