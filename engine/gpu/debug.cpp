#include "engine/gpu/debug.h"

#include <epoxy/gl.h>

#include <cstdlib>
#include <string_view>

#include "engine/core/log.h"

namespace rowland::gpu {

namespace {

bool is_fault(GLenum type) {
    return type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
           type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR;
}

std::string_view text_of(GLsizei length, const GLchar* message) {
    return length < 0 ? std::string_view(message) : std::string_view(message, static_cast<std::size_t>(length));
}

void on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length, const GLchar* message,
                const void* fatal) {
    // What a compiler finds wrong is in the info log, from which Program makes an exception.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER && type == GL_DEBUG_TYPE_ERROR) return;
    if (is_fault(type)) {
        log_error("OpenGL [{}]: {}", id, text_of(length, message));
        // The driver called us: an exception must not pass through its frames.
        if (fatal != nullptr) std::abort();
    } else if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM) {
        log_warning("OpenGL [{}]: {}", id, text_of(length, message));
    }
}

}  // namespace

void enable_debug_output(bool fatal) {
    static const char fatal_mark = 0;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageCallback(on_message, fatal ? &fatal_mark : nullptr);
}

}  // namespace rowland::gpu
