#include <epoxy/egl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "engine/platform/gl_context_system.h"

namespace rowland::platform {

const char* const context_remedy =
    "install the GPU's driver, or Mesa's software renderer (Debian: libgl1-mesa-dri, libegl1)";
const char* const context_needs =
    "a driver with EGL and OpenGL 4.5 core (any GPU of the last ten years, or Mesa's llvmpipe)";

namespace {

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

class EglContext : public SystemContext {
 public:
    EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    // The display is not terminated: EGL has one per device for the whole process, so other contexts may use it.
    ~EglContext() override {
        if (eglGetCurrentContext() == context_)
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    bool make_current() override {
        return eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
               eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
    }

 private:
    EGLDisplay display_;
    EGLContext context_;
};

class EglSource : public ContextSource {
 public:
    explicit EglSource(Candidate candidate) : candidate_(std::move(candidate)) {}
    std::unique_ptr<SystemContext> create(bool debug, std::string& reason) override {
        const EGLContext context = create_context(candidate_.display, debug, reason);
        if (context == EGL_NO_CONTEXT) return nullptr;
        return std::make_unique<EglContext>(candidate_.display, context);
    }
    std::string kind() const override { return candidate_.platform; }
    std::string pci_slot() const override { return candidate_.pci_slot; }

 private:
    Candidate candidate_;
};

}  // namespace

std::vector<std::unique_ptr<ContextSource>> context_sources(std::string& reason) {
    std::vector<std::unique_ptr<ContextSource>> sources;
    if (!has_word(client_extensions(), "EGL_EXT_platform_base")) {
        reason = "an EGL library without EGL_EXT_platform_base, or none";
        return sources;
    }
    reason = "neither a hardware device nor the surfaceless platform of Mesa";
    for (Candidate& candidate : candidates()) sources.push_back(std::make_unique<EglSource>(std::move(candidate)));
    return sources;
}

}  // namespace rowland::platform
