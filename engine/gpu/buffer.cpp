#include "engine/gpu/buffer.h"

#include <vector>

#include "engine/core/check.h"

namespace rowland::gpu {

void Buffer::Release::operator()(GLuint name) const {
    glDeleteBuffers(1, &name);
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

void Buffer::bind_uniform(unsigned binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, id());
}

void Buffer::replace(std::span<const std::byte> data) {
    glInvalidateBufferData(id());
    update(data);
}

void Buffer::bind_uniform(unsigned binding, std::size_t offset, std::size_t bytes) const {
    ROWLAND_CHECK_OP(offset, <=, size_);
    ROWLAND_CHECK_OP(bytes, <=, size_ - offset);
    glBindBufferRange(GL_UNIFORM_BUFFER, binding, id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes));
}

void Buffer::bind_storage(unsigned binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id());
}

std::size_t uniform_alignment() {
    GLint alignment = 256;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    return static_cast<std::size_t>(alignment);
}

}  // namespace rowland::gpu
