#include "engine/gpu/buffer.h"

#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/gpu/pipeline_state.h"

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

void Buffer::Release::operator()(GLuint name) const {
    glDeleteBuffers(1, &name);
    bound_state().forget(BoundState::Slot::UniformBuffer, name);
    bound_state().forget(BoundState::Slot::StorageBuffer, name);
}

namespace {

/// The name of a buffer of `bytes` > 0 that holds `data`, or anything if that is null.
GLuint make_buffer(std::size_t bytes, const std::byte* data, GLbitfield flags) {
    ROWLAND_CHECK_OP(bytes, >, std::size_t{0});
    GLuint name = 0;
    glCreateBuffers(1, &name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes), data, flags);
    return name;
}

}  // namespace

Buffer::Buffer(std::span<const std::byte> data)
    : handle_(make_buffer(data.size(), data.data(), 0)), size_(data.size()) {}

Buffer Buffer::mapped(std::size_t bytes, GLbitfield access) {
    const GLbitfield flags = access | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    Buffer buffer;
    buffer.handle_ = Handle<Release>(make_buffer(bytes, nullptr, flags));
    buffer.size_ = bytes;
    buffer.mapping_ =
        static_cast<std::byte*>(glMapNamedBufferRange(buffer.id(), 0, static_cast<GLsizeiptr>(bytes), flags));
    if (buffer.mapping_ == nullptr)
        fail_system("OpenGL", fmt::format("no memory for a buffer of {} bytes", bytes), "draw smaller or fewer meshes");
    return buffer;
}

Buffer Buffer::copy_of(const Buffer& from, std::size_t offset, std::size_t bytes) {
    ROWLAND_CHECK_OP(offset + bytes, <=, from.size());
    Buffer buffer;
    buffer.handle_ = Handle<Release>(make_buffer(bytes, nullptr, 0));
    buffer.size_ = bytes;
    glCopyNamedBufferSubData(from.id(), buffer.id(), static_cast<GLintptr>(offset), 0, static_cast<GLsizeiptr>(bytes));
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

void StreamBuffer::map_copies(std::size_t copy_bytes) {
    stride_ = aligned(copy_bytes);
    read_ = {};
    copy_ = 0;
    buffer_ = Buffer::mapped(kCopies * stride_, GL_MAP_WRITE_BIT);
    mapped_ = buffer_.mapping();
}

void StreamBuffer::hold(Buffer content) {
    stride_ = aligned(content.size());
    read_ = {};
    copy_ = 0;
    mapped_ = {};
    buffer_ = std::move(content);
    texels_write_ = 0;
}

void StreamBuffer::next_copy() {
    read_[copy_].emplace();
    copy_ = (copy_ + 1) % kCopies;
    if (read_[copy_] && !read_[copy_]->passed()) read_[copy_]->wait();
    read_[copy_].reset();
}

void StreamBuffer::write(std::span<const std::byte> data) {
    size_ = data.size();
    kept_ = 0;
    if (++writes_ == 1) return hold(Buffer(data));
    if (data.size() > stride_)
        map_copies(std::max(data.size(), stride_ + stride_ / 2));
    else if (mapped_.empty())
        map_copies(stride_);
    else
        next_copy();
    std::memcpy(&mapped_[copy_ * stride_], data.data(), data.size());
}

void StreamBuffer::keep() {
    if (!mapped_.empty() && ++kept_ == kFramesToMove) hold(Buffer::copy_of(buffer_, copy_ * stride_, size_));
}

void StreamBuffer::bind_uniform(unsigned binding, std::size_t offset, std::size_t bytes) const {
    ROWLAND_CHECK_OP(offset + bytes, <=, size_);
    buffer_.bind_uniform(binding, copy_ * stride_ + offset, bytes);
}

void StreamBuffer::bind_storage(unsigned binding, std::size_t offset, std::size_t bytes) const {
    ROWLAND_CHECK_OP(offset + bytes, <=, size_);
    buffer_.bind_storage(binding, copy_ * stride_ + offset, bytes);
}

std::pair<GLuint, GLintptr> StreamBuffer::location(std::size_t offset) const {
    return {buffer_.id(), static_cast<GLintptr>(copy_ * stride_ + offset)};
}

void StreamBuffer::ReleaseTexture::operator()(GLuint name) const {
    glDeleteTextures(1, &name);
    bound_state().forget(BoundState::Slot::Texture, name);
}

void StreamBuffer::bind_texels(unsigned unit) const {
    if (texels_.get() == 0) {
        GLuint name = 0;
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
        texels_ = Handle<ReleaseTexture>(name);
    }
    if (std::exchange(texels_write_, writes_) != writes_)
        glTextureBufferRange(texels_.get(), GL_RGB32F, buffer_.id(), static_cast<GLintptr>(copy_ * stride_),
                             static_cast<GLsizeiptr>(size_));
    if (bound_state().changes(BoundState::Slot::Texture, unit, {texels_.get()})) glBindTextureUnit(unit, texels_.get());
}

void VertexArray::Release::operator()(GLuint name) const {
    glDeleteVertexArrays(1, &name);
    bound_state().forget(BoundState::Slot::VertexArray, name);
}

VertexArray::VertexArray() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    handle_ = Handle<Release>(name);
}

void VertexArray::attach(const Buffer& buffer, int stride, std::initializer_list<VertexAttribute> attributes) {
    const unsigned binding = bindings_++;
    glVertexArrayVertexBuffer(id(), binding, buffer.id(), 0, stride);
    for (const VertexAttribute& attribute : attributes) {
        glEnableVertexArrayAttrib(id(), attribute.location);
        if (attribute.number == VertexNumber::UInt16) {
            glVertexArrayAttribIFormat(id(), attribute.location, attribute.components, GL_UNSIGNED_SHORT,
                                       attribute.offset);
        } else {
            glVertexArrayAttribFormat(id(), attribute.location, attribute.components, GL_FLOAT, GL_FALSE,
                                      attribute.offset);
        }
        glVertexArrayAttribBinding(id(), attribute.location, binding);
    }
}

namespace {

constexpr unsigned kInstanceVector = 3 * sizeof(float);

}  // namespace

void VertexArray::attach_instances(unsigned first, unsigned count) {
    instances_ = {.binding = bindings_++, .first = first, .count = count};
    glVertexArrayBindingDivisor(id(), instances_.binding, 1);
    for (unsigned i = 0; i < count; ++i) {
        glVertexArrayAttribFormat(id(), first + i, 3, GL_FLOAT, GL_FALSE, i * kInstanceVector);
        glVertexArrayAttribBinding(id(), first + i, instances_.binding);
    }
}

void VertexArray::attach_indices(const Buffer& buffer) {
    glVertexArrayElementBuffer(id(), buffer.id());
    indices_ = buffer.size() / sizeof(std::uint32_t);
}

void VertexArray::bind() const {
    if (bound_state().changes(BoundState::Slot::VertexArray, 0, {id()})) glBindVertexArray(id());
}

void VertexArray::draw(int count, int instances) const {
    bind();
    glDrawArraysInstanced(GL_TRIANGLES, 0, count, instances);
}

void VertexArray::draw_indexed(int count) const {
    ROWLAND_CHECK_OP(count, >=, 0);
    ROWLAND_CHECK_OP(static_cast<std::size_t>(count), <=, indices_);
    bind();
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
}

void VertexArray::draw_instances(int count, const StreamBuffer& buffer, std::size_t offset, int instances) const {
    const std::size_t stride = std::size_t{instances_.count} * kInstanceVector;
    ROWLAND_CHECK_OP(static_cast<std::size_t>(count), <=, indices_);
    ROWLAND_CHECK_OP(offset + static_cast<std::size_t>(instances) * stride, <=, buffer.size());
    const auto [name, begin] = buffer.location(offset);
    glVertexArrayVertexBuffer(id(), instances_.binding, name, begin, static_cast<GLsizei>(stride));
    if (!std::exchange(instances_.enabled, true))
        for (unsigned i = 0; i < instances_.count; ++i) glEnableVertexArrayAttrib(id(), instances_.first + i);
    bind();
    glDrawElementsInstanced(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr, instances);
}

}  // namespace rowland::gpu
