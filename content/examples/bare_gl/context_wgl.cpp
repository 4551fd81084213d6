#include <windows.h>
//
#include <epoxy/wgl.h>

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
    // Only a context tells how to make one of a version.
    const HGLRC old = wglCreateContext(device);
    wglMakeCurrent(device, old);
    constexpr int attributes[] = {WGL_CONTEXT_MAJOR_VERSION_ARB, 4, WGL_CONTEXT_MINOR_VERSION_ARB, 5, 0};
    const HGLRC context = epoxy_has_wgl_extension(device, "WGL_ARB_create_context")
                              ? wglCreateContextAttribsARB(device, nullptr, attributes)
                              : nullptr;
    if (context == nullptr || wglMakeCurrent(device, context) == FALSE)
        throw std::runtime_error("no OpenGL 4.5 without a window");
    wglDeleteContext(old);
}
