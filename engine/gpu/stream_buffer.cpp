#include "engine/gpu/stream_buffer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/core/check.h"
#include "engine/gpu/bound_state.h"

namespace rowland::gpu {

void StreamBuffer::allocate(std::size_t copy_bytes, std::size_t copies) {
    stride_ = aligned(copy_bytes);
    read_ = {};
    copy_ = 0;
    buffer_ = Buffer::mapped(copies * stride_, GL_MAP_WRITE_BIT);
    mapped_ = buffer_.mapping();
}

void StreamBuffer::next_copy() {
    read_[copy_].emplace();
    copy_ = (copy_ + 1) % kCopies;
    if (read_[copy_] && !read_[copy_]->passed()) read_[copy_]->wait();
    read_[copy_].reset();
}

void StreamBuffer::write(std::span<const std::byte> data) {
    ROWLAND_CHECK_OP(data.size(), >, std::size_t{0});
    if (writes_ == 0)
        allocate(data.size(), 1);
    else if (data.size() > stride_)
        allocate(std::max(data.size(), stride_ + stride_ / 2), kCopies);
    else if (writes_ == 1)
        allocate(stride_, kCopies);
    else
        next_copy();
    std::memcpy(&mapped_[copy_ * stride_], data.data(), data.size());
    size_ = data.size();
    ++writes_;
}

void StreamBuffer::bind_uniform(unsigned binding, std::size_t offset, std::size_t bytes) const {
    ROWLAND_CHECK_OP(offset + bytes, <=, size_);
    buffer_.bind_uniform(binding, copy_ * stride_ + offset, bytes);
}

void StreamBuffer::bind_storage(unsigned binding, std::size_t offset, std::size_t bytes) const {
    ROWLAND_CHECK_OP(offset + bytes, <=, size_);
    buffer_.bind_storage(binding, copy_ * stride_ + offset, bytes);
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

}  // namespace rowland::gpu
