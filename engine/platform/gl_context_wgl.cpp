#include <windows.h>
//
#include <fmt/format.h>

#include <array>

#include "engine/core/windows_text.h"
#include "engine/platform/gl_context_system.h"

// Drivers of laptops with two GPUs look for these variables of the program, and then draw on the faster one.
extern "C" {
__declspec(dllexport) extern const DWORD NvOptimusEnablement = 1;
__declspec(dllexport) extern const DWORD AmdPowerXpressRequestHighPerformance = 1;
}

namespace rowland::platform {

const char* const context_remedy = "install the GPU's driver, or put Mesa's opengl32.dll beside the program";
const char* const context_needs = "a driver with OpenGL 4.5 core (any GPU of the last ten years, or Mesa's llvmpipe)";

namespace {

// WGL_ARB_create_context, _profile and _robustness.
constexpr int kMajorVersion = 0x2091;
constexpr int kMinorVersion = 0x2092;
constexpr int kFlags = 0x2094;
constexpr int kProfileMask = 0x9126;
constexpr int kCoreProfile = 1;
constexpr int kDebug = 1;
constexpr int kResetStrategy = 0x8256;
constexpr int kLoseContextOnReset = 0x8252;
using CreateContextAttribs = HGLRC(WINAPI*)(HDC, HGLRC, const int*);

/// A window that is never shown: WGL makes contexts for windows only.
class HiddenWindow {
 public:
    HiddenWindow() {
        constexpr const wchar_t* kClass = L"rowland-hidden";
        WNDCLASSW type{};
        type.style = CS_OWNDC;
        type.lpfnWndProc = DefWindowProcW;
        type.hInstance = GetModuleHandleW(nullptr);
        type.lpszClassName = kClass;
        RegisterClassW(&type);  // fails if it is registered already
        window_ = CreateWindowExW(0, kClass, L"", WS_POPUP, 0, 0, 1, 1, nullptr, nullptr, type.hInstance, nullptr);
        if (window_ == nullptr) return;
        device_ = GetDC(window_);
        PIXELFORMATDESCRIPTOR format{};
        format.nSize = sizeof format;
        format.nVersion = 1;
        format.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
        format.iPixelType = PFD_TYPE_RGBA;
        format.cColorBits = 24;
        const int number = ChoosePixelFormat(device_, &format);
        has_format_ = number != 0 && SetPixelFormat(device_, number, &format) != FALSE;
    }
    ~HiddenWindow() {
        if (window_ == nullptr) return;
        ReleaseDC(window_, device_);
        DestroyWindow(window_);
    }
    HiddenWindow(const HiddenWindow&) = delete;
    HiddenWindow& operator=(const HiddenWindow&) = delete;

    bool has_format() const { return has_format_; }
    HDC device() const { return device_; }

 private:
    HWND window_ = nullptr;
    HDC device_ = nullptr;
    bool has_format_ = false;
};

class WglContext : public SystemContext {
 public:
    WglContext(std::unique_ptr<HiddenWindow> window, HGLRC context) : window_(std::move(window)), context_(context) {}
    ~WglContext() override {
        if (wglGetCurrentContext() == context_) wglMakeCurrent(nullptr, nullptr);
        wglDeleteContext(context_);
    }
    WglContext(const WglContext&) = delete;
    WglContext& operator=(const WglContext&) = delete;

    bool make_current() override { return wglMakeCurrent(window_->device(), context_) != FALSE; }

 private:
    std::unique_ptr<HiddenWindow> window_;
    HGLRC context_;
};

/// WGL tells its extensions only while a context is current, so an old one is made first. Null if there is none.
CreateContextAttribs find_creator(HDC device) {
    const HDC device_before = wglGetCurrentDC();
    const HGLRC context_before = wglGetCurrentContext();
    const HGLRC old = wglCreateContext(device);
    if (old == nullptr) return nullptr;
    CreateContextAttribs creator = nullptr;
    if (wglMakeCurrent(device, old) != FALSE)
        creator = reinterpret_cast<CreateContextAttribs>(
            reinterpret_cast<void*>(wglGetProcAddress("wglCreateContextAttribsARB")));
    wglMakeCurrent(device_before, context_before);
    wglDeleteContext(old);
    return creator;
}

class WglSource : public ContextSource {
 public:
    std::unique_ptr<SystemContext> create(bool debug, std::string& reason) override {
        auto window = std::make_unique<HiddenWindow>();
        if (!window->has_format()) {
            reason = fmt::format("no hidden window for OpenGL: {}", last_windows_failure().message());
            return nullptr;
        }
        const CreateContextAttribs creator = find_creator(window->device());
        if (creator == nullptr) {
            reason = "a driver without WGL_ARB_create_context";
            return nullptr;
        }
        std::array attributes{kMajorVersion,
                              4,
                              kMinorVersion,
                              5,
                              kProfileMask,
                              kCoreProfile,
                              kFlags,
                              debug ? kDebug : 0,
                              kResetStrategy,
                              kLoseContextOnReset,
                              0};
        HGLRC context = creator(window->device(), nullptr, attributes.data());
        if (context == nullptr) {
            // Not every driver can report resets (gpu/context.h).
            attributes[attributes.size() - 3] = 0;
            context = creator(window->device(), nullptr, attributes.data());
        }
        if (context == nullptr) {
            reason = "a driver without OpenGL 4.5 core";
            return nullptr;
        }
        return std::make_unique<WglContext>(std::move(window), context);
    }
    std::string kind() const override { return "WGL"; }
    std::string pci_slot() const override { return {}; }
};

}  // namespace

std::vector<std::unique_ptr<ContextSource>> context_sources(std::string& /*reason*/) {
    std::vector<std::unique_ptr<ContextSource>> sources;
    sources.push_back(std::make_unique<WglSource>());
    return sources;
}

}  // namespace rowland::platform
