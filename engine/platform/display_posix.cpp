#include "engine/platform/display.h"

#include <dlfcn.h>

#include <cstdlib>

#include "engine/core/log.h"

namespace rowland::platform {

namespace {

bool announced(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

/// XErrorEvent of Xlib.h.
struct XError {
    int type;
    void* display;
    unsigned long resource;
    unsigned long serial;
    unsigned char code;
    unsigned char request;
    unsigned char minor;
};

int log_x_error(void* /*display*/, XError* error) {
    log_warning("the X server refused request {} ({}) on {:#x}: error {}", error->request, error->minor,
                error->resource, error->code);
    return 0;
}

}  // namespace

bool display_announced() {
#if defined(__APPLE__)
    return true;
#else
    return announced("DISPLAY") || announced("WAYLAND_DISPLAY");
#endif
}

void survive_display_errors() {
    static void* const x11 = ::dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    if (x11 == nullptr) return;
    using Handler = int (*)(void*, XError*);
    using SetHandler = Handler (*)(Handler);
    if (const auto set = reinterpret_cast<SetHandler>(::dlsym(x11, "XSetErrorHandler"))) set(log_x_error);
}

}  // namespace rowland::platform
