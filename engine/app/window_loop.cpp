#include "engine/app/window_loop.h"

#include <thread>
#include <utility>

#include "engine/gpu/context.h"

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
    frame.elapsed = since_drawn_ += clock_.tick();
    frame.woken = std::exchange(woken_, false);
    frame.events = window_.poll_events();
    frame.dropped = std::exchange(dropped_, {});
    frame.size = window_.size();
    frame.pixels = window_.framebuffer_size();
    return frame;
}

void WindowLoop::run(const std::function<Next(const Frame&)>& update, const std::function<void(const Frame&)>& draw) {
    constexpr std::chrono::milliseconds kMinimisedFrame(20);  // a minimised window does not wait for the display
    constexpr std::chrono::milliseconds kWatch(30);
    constexpr std::chrono::milliseconds kWait(1000);
    for (;;) {
        const Frame frame = next_frame();
        const Next next = update(frame);
        if (next == Next::End) return;
        if (next != Next::Frame) {
            waited_ = true;
            woken_ = window_.wait(next == Next::Watch ? kWatch : kWait);
            continue;
        }
        if (!std::exchange(waited_, false)) times_.add(frame.elapsed);
        since_drawn_ = {};
        if (frame.pixels.x < 1 || frame.pixels.y < 1) {
            std::this_thread::sleep_for(kMinimisedFrame);
            continue;
        }
        draw(frame);
        window_.swap();
    }
}

}  // namespace rowland::app
