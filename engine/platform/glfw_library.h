#pragma once

#include <memory>
#include <string>

namespace rowland::platform {

/// GLFW is initialised while someone holds this. Main thread only.
class GlfwLibrary {
 public:
    /// Initialises GLFW if nobody holds it; null if that fails, with GLFW's reason in `reason`.
    static std::shared_ptr<GlfwLibrary> acquire(std::string& reason);
    ~GlfwLibrary();
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;

 private:
    GlfwLibrary() = default;
};

/// Returns and clears GLFW's last error; empty if there was none.
std::string take_glfw_error();

}  // namespace rowland::platform
