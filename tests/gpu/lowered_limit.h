#pragma once

#include <epoxy/gl.h>

#include <cstdint>

namespace rowland::test {

/// While it lives, the driver reports another limit: it stands between the program and OpenGL. One at a time.
class LoweredLimit {
 public:
    LoweredLimit(GLenum name, std::int64_t value);
    ~LoweredLimit();
    LoweredLimit(const LoweredLimit&) = delete;
    LoweredLimit& operator=(const LoweredLimit&) = delete;
};

}  // namespace rowland::test
