#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <map>

namespace rowland::test {

/// While it lives, the driver reports other limits: it stands between the program and OpenGL. One at a time.
class LoweredLimit {
 public:
    LoweredLimit(GLenum name, std::int64_t value) : LoweredLimit(std::map<GLenum, std::int64_t>{{name, value}}) {}
    explicit LoweredLimit(std::map<GLenum, std::int64_t> values);
    ~LoweredLimit();
    LoweredLimit(const LoweredLimit&) = delete;
    LoweredLimit& operator=(const LoweredLimit&) = delete;
};

}  // namespace rowland::test
