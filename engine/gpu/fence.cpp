#include "engine/gpu/fence.h"

namespace rowland::gpu {

void Fence::Release::operator()(GLsync sync) const {
    glDeleteSync(sync);
}

Fence::Fence() : sync_(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {}

bool Fence::passed() const {
    GLint status = GL_SIGNALED;
    glGetSynciv(sync_.get(), GL_SYNC_STATUS, 1, nullptr, &status);
    return status == GL_SIGNALED;
}

void Fence::wait() const {
    constexpr GLuint64 kSecond_ns = 1'000'000'000;
    while (glClientWaitSync(sync_.get(), GL_SYNC_FLUSH_COMMANDS_BIT, kSecond_ns) == GL_TIMEOUT_EXPIRED) {
    }
}

}  // namespace rowland::gpu
