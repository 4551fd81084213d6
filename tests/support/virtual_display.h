#pragma once

#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::test {

/// An X server that shows nothing (Xvfb), for programs with a window. Throws std::runtime_error if it does not start.
class VirtualDisplay {
 public:
    VirtualDisplay(int width, int height);
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    /// For the variable DISPLAY.
    const std::string& name() const { return name_; }

 private:
    int number_pipe_[2];
    Running server_;
    std::string name_;
};

/// Whether Xvfb and xdotool, which plays the user, are installed.
bool has_virtual_display();

}  // namespace rowland::test

/// Without a virtual display the test is skipped by name, or fails where test data is required.
#define ROWLAND_NEEDS_VIRTUAL_DISPLAY()                                                        \
    if (!::rowland::test::has_virtual_display()) {                                             \
        if (::rowland::test::data_is_required()) FAIL() << "Xvfb or xdotool is not installed"; \
        GTEST_SKIP() << "Xvfb or xdotool is not installed";                                    \
    }                                                                                          \
    static_assert(true)
