#include "engine/platform/glfw_library.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace rowland::platform {

std::shared_ptr<GlfwLibrary> GlfwLibrary::acquire(std::string& reason) {
    // GLFW is one per process and so is the count of its holders.
    static std::weak_ptr<GlfwLibrary> running;
    if (auto held = running.lock()) return held;
    if (glfwInit() != GLFW_TRUE) {
        reason = take_glfw_error();
        return nullptr;
    }
    std::shared_ptr<GlfwLibrary> library(new GlfwLibrary);
    running = library;
    return library;
}

GlfwLibrary::~GlfwLibrary() {
    glfwTerminate();
}

std::string take_glfw_error() {
    const char* description = nullptr;
    const bool failed = glfwGetError(&description) != GLFW_NO_ERROR;
    return failed && description != nullptr ? description : "";
}

}  // namespace rowland::platform
