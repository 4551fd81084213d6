#include "engine/app/context.h"

#include <chrono>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/debug.h"
#include "engine/platform/headless_context.h"
#include "engine/platform/window.h"

namespace rowland::app {

void render_offscreen(bool debug, const std::function<void(const std::string& renderer)>& body) {
    const platform::HeadlessContext context({.debug = debug});
    if (debug) gpu::enable_debug_output(false);
    log_info("rendering on {}", context.renderer());
    const auto started = std::chrono::steady_clock::now();
    body(context.renderer());
    log_info("done in {:.1f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count());
}

void require_display(const std::string& program, const std::string& remedy) {
    if (platform::display_available()) return;
    fail_system(program, "no display", remedy, "X11 or Wayland");
}

}  // namespace rowland::app
