#include "engine/gpu/lost_context.h"

#include <epoxy/gl.h>

#include "engine/core/error.h"

namespace rowland::gpu {

namespace {

const char* reason_for(GLenum status) {
    switch (status) {
        case GL_GUILTY_CONTEXT_RESET:
            return "the GPU was reset for what this program drew, and its context is lost";
        case GL_INNOCENT_CONTEXT_RESET:
            return "the GPU was reset for another program, and this one's context is lost";
        default:
            return "the GPU was reset, and the context is lost";
    }
}

}  // namespace

void require_context() {
    const GLenum status = glGetGraphicsResetStatus();
    if (status == GL_NO_ERROR) return;
    fail_system("OpenGL", reason_for(status), "start the program again");
}

}  // namespace rowland::gpu
