#include "engine/gpu/debug.h"

#include <epoxy/gl.h>

#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include "engine/core/check.h"
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

/// What the thread's contexts have said. The driver calls from the thread that calls it.
std::set<std::string, std::less<>>& logged() {
    thread_local std::set<std::string, std::less<>> texts;
    return texts;
}

void on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length, const GLchar* message,
                const void* fatal) {
    // What a compiler finds wrong is in the info log, from which Program makes an exception.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER && type == GL_DEBUG_TYPE_ERROR) return;
    const std::string_view text = text_of(length, message);
    const bool is_new = logged().emplace(text).second;
    if (is_fault(type)) {
        if (is_new) log_error("OpenGL [{}]: {}", id, text);
        // The driver called us: an exception must not pass through its frames.
        if (fatal != nullptr) std::abort();
    } else if (is_new && (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)) {
        log_warning("OpenGL [{}]: {}", id, text);
    }
}

}  // namespace

void enable_debug_output(bool fatal) {
    static const char fatal_mark = 0;
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    ROWLAND_CHECK((flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0, "a debug context");
    logged().clear();
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageCallback(on_message, fatal ? &fatal_mark : nullptr);
}

}  // namespace rowland::gpu
