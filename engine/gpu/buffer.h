#pragma once

#include <cstddef>
#include <span>

#include "engine/gpu/handle.h"

namespace rowland::gpu {

/// Whether a buffer's content may change after it is made.
enum class BufferUse { Static, Dynamic };

/// Offsets of uniform blocks and shader storage in a buffer must be multiples of this: the largest that OpenGL lets a
/// driver ask for.
inline constexpr std::size_t kBufferAlignment = 256;
/// The next such offset, `offset` itself if it is one.
constexpr std::size_t aligned(std::size_t offset) {
    return (offset + kBufferAlignment - 1) / kBufferAlignment * kBufferAlignment;
}

/// GPU memory of fixed size: vertices, indices, uniform blocks, shader storage.
class Buffer {
 public:
    Buffer() = default;
    explicit Buffer(std::span<const std::byte> data, BufferUse use = BufferUse::Static);
    /// A buffer of `bytes` zeros.
    explicit Buffer(std::size_t bytes, BufferUse use = BufferUse::Dynamic);

    /// A buffer that stays mapped, and coherent: GL_MAP_WRITE_BIT or GL_MAP_READ_BIT says what the CPU does. Throws
    /// Error (system) if there is no memory.
    static Buffer mapped(std::size_t bytes, GLbitfield access);
    /// The memory of such a buffer.
    std::span<std::byte> mapping() const;

    /// A buffer that holds `values` as they lie in memory.
    template <typename T>
    static Buffer of(std::span<const T> values, BufferUse use = BufferUse::Static) {
        return Buffer(std::as_bytes(values), use);
    }

    /// Overwrites part of a dynamic buffer. It is a logic error if the buffer is static or the range does not fit.
    void update(std::span<const std::byte> data, std::size_t offset = 0);
    /// Overwrites the start of the buffer with one plain struct, such as a uniform block.
    template <typename T>
    void update_value(const T& value) {
        update(std::as_bytes(std::span<const T>(&value, 1)));
    }

    void bind_uniform(unsigned binding) const { bind_uniform(binding, 0, size_); }
    void bind_storage(unsigned binding) const { bind_storage(binding, 0, size_); }
    /// Binds only `bytes` from `offset` on, a multiple of kBufferAlignment.
    void bind_uniform(unsigned binding, std::size_t offset, std::size_t bytes) const;
    void bind_storage(unsigned binding, std::size_t offset, std::size_t bytes) const;

    std::size_t size() const { return size_; }
    GLuint id() const { return handle_.get(); }

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    void bind(GLenum target, unsigned binding, std::size_t offset, std::size_t bytes) const;

    Handle<Release> handle_;
    std::byte* mapping_ = nullptr;
    std::size_t size_ = 0;
    BufferUse use_ = BufferUse::Static;
};

}  // namespace rowland::gpu
