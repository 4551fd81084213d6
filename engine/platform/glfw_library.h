#pragma once

#include <memory>
#include <string>

namespace rowland::platform {

/// GLFW as long as someone holds it. Main thread only.
class GlfwLibrary {
 public:
    /// The library, started if nobody holds it; null if it does not start, with GLFW's reason in `reason`.
    static std::shared_ptr<GlfwLibrary> acquire(std::string& reason);
    ~GlfwLibrary();
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;

 private:
    GlfwLibrary() = default;
};

/// What GLFW says about its last failure, which is then forgotten; empty if there was none.
std::string take_glfw_error();

}  // namespace rowland::platform
