#include <windows.h>

#include <stdexcept>

#include "context.h"

void make_headless_context() {
    // WGL makes contexts for windows only; this one is never shown.
    const HWND window = CreateWindowExA(0, "STATIC", "", WS_POPUP, 0, 0, 1, 1, nullptr, nullptr, nullptr, nullptr);
    const HDC device = GetDC(window);
    PIXELFORMATDESCRIPTOR format{};
    format.nSize = sizeof format;
    format.nVersion = 1;
    format.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL;
    format.iPixelType = PFD_TYPE_RGBA;
    format.cColorBits = 24;
    SetPixelFormat(device, ChoosePixelFormat(device, &format), &format);
    // Only a context tells how to make one of a version. WGL is called past libepoxy, which in a static library crashes
    // as a second context becomes current.
    const HGLRC old = wglCreateContext(device);
    wglMakeCurrent(device, old);
    using Create = HGLRC(WINAPI*)(HDC, HGLRC, const int*);
    const auto create = reinterpret_cast<Create>(wglGetProcAddress("wglCreateContextAttribsARB"));
    constexpr int attributes[] = {0x2091, 4, 0x2092, 5, 0};  // WGL_CONTEXT_MAJOR_VERSION_ARB, _MINOR_
    const HGLRC context = create != nullptr ? create(device, nullptr, attributes) : nullptr;
    if (context == nullptr || wglMakeCurrent(device, context) == FALSE)
        throw std::runtime_error("no OpenGL 4.5 without a window");
    wglDeleteContext(old);
}
