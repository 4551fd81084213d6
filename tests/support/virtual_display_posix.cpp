#include "tests/support/virtual_display.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>

namespace rowland::test {

namespace {

constexpr int kStartLimit_ms = 60000;

/// -noreset: without it the server resets when its last window closes, and may refuse the next program meanwhile.
Command xvfb(int number_output, int width, int height) {
    return {"/usr/bin/env",
            "Xvfb",
            "-displayfd",
            std::to_string(number_output),
            "-noreset",
            "-nolisten",
            "tcp",
            "-screen",
            "0",
            std::to_string(width) + "x" + std::to_string(height) + "x24"};
}

/// Two ends of a pipe, which are filled in and returned.
int* open_pipe(int (&ends)[2]) {
    if (::pipe(ends) != 0) throw std::runtime_error("cannot open a pipe");
    return ends;
}

/// The number of the display, which the server writes as a line once it is ready.
std::string read_number(int input) {
    std::string text;
    while (text.empty() || text.back() != '\n') {
        pollfd ready{.fd = input, .events = POLLIN, .revents = 0};
        std::array<char, 16> buffer;
        const ssize_t size =
            ::poll(&ready, 1, kStartLimit_ms) > 0 ? ::read(input, buffer.data(), buffer.size()) : ssize_t{0};
        if (size <= 0) throw std::runtime_error("Xvfb did not start");
        text.append(buffer.data(), static_cast<std::size_t>(size));
    }
    text.pop_back();
    return text;
}

}  // namespace

VirtualDisplay::VirtualDisplay(int width, int height) : server_(xvfb(open_pipe(number_pipe_)[1], width, height)) {
    ::close(number_pipe_[1]);
    name_ = ":" + read_number(number_pipe_[0]);
}

VirtualDisplay::~VirtualDisplay() {
    ::close(number_pipe_[0]);
    ::kill(server_.pid(), SIGTERM);  // it removes its lock file
    server_.wait();
}

bool has_virtual_display() {
    static const bool found = run({"/bin/sh", "-c", "command -v Xvfb && command -v xdotool"}).code == 0;
    return found;
}

}  // namespace rowland::test
