#include "engine/app/window_loop.h"

#include <thread>
#include <utility>

#include "engine/gpu/debug.h"

namespace rowland::app {

WindowLoop::WindowLoop(const std::string& title, glm::ivec2 size, bool debug)
    : window_({.title = title, .size = size, .debug = debug}) {
    if (debug) gpu::enable_debug_output(false);
    window_.set_drop_handler([this](const std::vector<std::filesystem::path>& files) {
        dropped_.insert(dropped_.end(), files.begin(), files.end());
    });
}

Frame WindowLoop::next_frame() {
    Frame frame;
    frame.elapsed = clock_.tick();
    times_.add(frame.elapsed);
    frame.events = window_.poll_events();
    frame.dropped = std::exchange(dropped_, {});
    frame.size = window_.size();
    frame.pixels = window_.framebuffer_size();
    return frame;
}

void WindowLoop::run(const std::function<Next(const Frame&)>& update, const std::function<void(const Frame&)>& draw) {
    constexpr std::chrono::milliseconds kMinimisedFrame(20);  // no display sets the pace
    constexpr std::chrono::milliseconds kRest(30);
    for (;;) {
        const Frame frame = next_frame();
        const Next next = update(frame);
        if (next == Next::End) return;
        if (frame.pixels.x < 1 || frame.pixels.y < 1) {
            std::this_thread::sleep_for(kMinimisedFrame);
            continue;
        }
        draw(frame);
        window_.swap();
        if (next == Next::Rest) std::this_thread::sleep_for(kRest);
    }
}

}  // namespace rowland::app
