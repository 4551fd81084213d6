#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace rowland::gpu {

/// Owns one GL object name; 0 owns nothing. `Release{}(name)` deletes it. The context that made the object must be
/// current when the handle dies.
template <typename Release>
class Handle {
 public:
    Handle() = default;
    explicit Handle(GLuint name) : name_(name) {}
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Handle() {
        if (name_ != 0) Release{}(name_);
    }

    GLuint get() const { return name_; }

 private:
    GLuint name_ = 0;
};

}  // namespace rowland::gpu
