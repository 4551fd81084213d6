#include <stdexcept>

#include "tests/support/virtual_display.h"

namespace rowland::test {

VirtualDisplay::VirtualDisplay(int /*width*/, int /*height*/) : server_({}) {
    throw std::runtime_error("no virtual display on Windows");
}

VirtualDisplay::~VirtualDisplay() = default;

bool has_virtual_display() {
    return false;
}

}  // namespace rowland::test
