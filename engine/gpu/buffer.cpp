#include "engine/gpu/buffer.h"

#include <fmt/format.h>

#include <vector>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/gpu/bound_state.h"

namespace rowland::gpu {

void Buffer::Release::operator()(GLuint name) const {
    glDeleteBuffers(1, &name);
    bound_state().forget(BoundState::Slot::UniformBuffer, name);
    bound_state().forget(BoundState::Slot::StorageBuffer, name);
}

Buffer::Buffer(std::span<const std::byte> data, BufferUse use) : size_(data.size()), use_(use) {
    ROWLAND_CHECK_OP(data.size(), >, std::size_t{0});
    GLuint name = 0;
    glCreateBuffers(1, &name);
    handle_ = Handle<Release>(name);
    const GLbitfield flags = use == BufferUse::Dynamic ? GL_DYNAMIC_STORAGE_BIT : 0;
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(data.size()), data.data(), flags);
}

Buffer::Buffer(std::size_t bytes, BufferUse use) : Buffer(std::vector<std::byte>(bytes), use) {}

void Buffer::update(std::span<const std::byte> data, std::size_t offset) {
    ROWLAND_CHECK(use_ == BufferUse::Dynamic, "a static buffer is not updated");
    ROWLAND_CHECK_OP(offset, <=, size_);
    ROWLAND_CHECK_OP(data.size(), <=, size_ - offset);
    glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()), data.data());
}

Buffer Buffer::mapped(std::size_t bytes, GLbitfield access) {
    ROWLAND_CHECK_OP(bytes, >, std::size_t{0});
    const GLbitfield flags = access | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    GLuint name = 0;
    glCreateBuffers(1, &name);
    Buffer buffer;
    buffer.handle_ = Handle<Release>(name);
    buffer.size_ = bytes;
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes), nullptr, flags);
    buffer.mapping_ = static_cast<std::byte*>(glMapNamedBufferRange(name, 0, static_cast<GLsizeiptr>(bytes), flags));
    if (buffer.mapping_ == nullptr)
        fail_system("OpenGL", fmt::format("no memory for a buffer of {} bytes", bytes), "draw smaller or fewer meshes");
    return buffer;
}

std::span<std::byte> Buffer::mapping() const {
    ROWLAND_CHECK(mapping_ != nullptr, "a buffer that is mapped");
    return {mapping_, size_};
}

void Buffer::bind(GLenum target, unsigned binding, std::size_t offset, std::size_t bytes) const {
    ROWLAND_CHECK_OP(offset, <=, size_);
    ROWLAND_CHECK_OP(bytes, <=, size_ - offset);
    const auto slot = target == GL_UNIFORM_BUFFER ? BoundState::Slot::UniformBuffer : BoundState::Slot::StorageBuffer;
    const auto start = static_cast<GLintptr>(offset);
    const auto length = static_cast<GLsizeiptr>(bytes);
    if (bound_state().changes(slot, binding, {id(), start, length}))
        glBindBufferRange(target, binding, id(), start, length);
}

void Buffer::bind_uniform(unsigned binding, std::size_t offset, std::size_t bytes) const {
    bind(GL_UNIFORM_BUFFER, binding, offset, bytes);
}

void Buffer::bind_storage(unsigned binding, std::size_t offset, std::size_t bytes) const {
    bind(GL_SHADER_STORAGE_BUFFER, binding, offset, bytes);
}

}  // namespace rowland::gpu
