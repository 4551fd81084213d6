#pragma once

#include <epoxy/gl.h>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/gpu/handle.h"

namespace rowland::gpu {

/// A point in the GPU's work: after all commands so far.
class Fence {
 public:
    Fence();

    /// Whether the GPU is past it. Does not wait.
    bool passed() const;
    /// Waits until the GPU is past it.
    void wait() const;

 private:
    struct Release {
        void operator()(GLsync sync) const;
    };
    std::unique_ptr<std::remove_pointer_t<GLsync>, Release> sync_;
};

/// Offsets of uniform blocks and shader storage in a buffer must be multiples of this, the largest alignment that
/// OpenGL allows a driver to require.
inline constexpr std::size_t kBufferAlignment = 256;
/// The smallest such offset that is at least `offset`.
constexpr std::size_t aligned(std::size_t offset) {
    return (offset + kBufferAlignment - 1) / kBufferAlignment * kBufferAlignment;
}

/// GPU memory of fixed size and, unless it is mapped, of fixed content: vertices, indices, uniform blocks, shader
/// storage.
class Buffer {
 public:
    Buffer() = default;
    /// Holds `data`, which must not be empty.
    explicit Buffer(std::span<const std::byte> data);

    /// A buffer of `bytes` > 0 that stays mapped, coherently. `access`: GL_MAP_WRITE_BIT or GL_MAP_READ_BIT, for what
    /// the CPU does. Throws Error (system) if there is no memory.
    static Buffer mapped(std::size_t bytes, GLbitfield access);
    /// The memory of a mapped() buffer; a logic error for others.
    std::span<std::byte> mapping() const;

    /// A buffer that the GPU fills with `bytes` > 0 of `from`, after all commands so far.
    static Buffer copy_of(const Buffer& from, std::size_t offset, std::size_t bytes);

    /// A buffer that holds `values` as they lie in memory.
    template <typename T>
    static Buffer of(std::span<const T> values) {
        return Buffer(std::as_bytes(values));
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
};

/// A buffer whose content is replaced up to once a frame, as a whole. Draws read what was last written before them.
/// The first content lies in the GPU's own memory. From the second write on there are three copies in mapped memory,
/// written in turn, so that the GPU may be two writes late. They are replaced only if the content does not fit.
/// A graphics card reads mapped memory over the bus in every draw: content that stays is to be kept().
class StreamBuffer {
 public:
    /// Waits only if the GPU is more than two writes late. Throws Error (system) if there is no memory.
    void write(std::span<const std::byte> data);
    template <typename T>
    void write_values(std::span<const T> values) {
        write(std::as_bytes(values));
    }

    /// A frame draws the content of an earlier one. After kFramesToMove such frames it moves to the GPU's own memory.
    void keep();
    static constexpr int kFramesToMove = 8;

    /// Binds `bytes` from `offset` on, a multiple of kBufferAlignment.
    void bind_uniform(unsigned binding, std::size_t offset, std::size_t bytes) const;
    void bind_storage(unsigned binding, std::size_t offset, std::size_t bytes) const;
    /// Binds all of it.
    void bind_uniform(unsigned binding) const { bind_uniform(binding, 0, size_); }
    void bind_storage(unsigned binding) const { bind_storage(binding, 0, size_); }

    /// Binds all of it to a texture unit, as texels of three floats for a samplerBuffer.
    void bind_texels(unsigned unit) const;

    /// Where the content lies from `offset` on: a buffer's name, and bytes from its beginning. Valid until it is
    /// written or kept.
    std::pair<GLuint, GLintptr> location(std::size_t offset) const;

    /// Bytes of the content.
    std::size_t size() const { return size_; }
    /// Number of calls of write().
    int writes() const { return writes_; }

 private:
    static constexpr std::size_t kCopies = 3;
    struct ReleaseTexture {
        void operator()(GLuint name) const;
    };
    void map_copies(std::size_t copy_bytes);
    void hold(Buffer content);
    void next_copy();

    Buffer buffer_;
    std::span<std::byte> mapped_;                     ///< empty: the only copy lies in the GPU's own memory
    std::size_t stride_ = 0;                          ///< bytes from copy to copy
    std::size_t copy_ = 0;                            ///< the last one written
    std::array<std::optional<Fence>, kCopies> read_;  ///< passed when the draws that read a copy are done
    std::size_t size_ = 0;
    int writes_ = 0;
    int kept_ = 0;                           ///< calls of keep() since the last write
    mutable Handle<ReleaseTexture> texels_;  ///< made when first bound
    mutable int texels_write_ = 0;           ///< which write it shows; 0: none, or from another buffer
};

enum class VertexNumber {
    Float,
    UInt16,  ///< an integer in GLSL: uvec4 and so on
};

/// One attribute of a vertex: `layout(location = location)` in GLSL.
struct VertexAttribute {
    unsigned location = 0;
    int components = 3;   ///< 1 to 4
    unsigned offset = 0;  ///< bytes from the start of the vertex
    VertexNumber number = VertexNumber::Float;
};

/// How vertices are read from buffers. The buffers must outlive it.
class VertexArray {
 public:
    /// With nothing attached it draws vertices made from gl_VertexID alone.
    VertexArray();

    /// Reads the attributes from `buffer`, one vertex every `stride` bytes.
    void attach(const Buffer& buffer, int stride, std::initializer_list<VertexAttribute> attributes);
    /// 32-bit indices.
    void attach_indices(const Buffer& buffer);
    /// Attributes that draw_instances() reads once for each instance: `count` vectors of three floats, one after the
    /// other, at locations from `first` on.
    void attach_instances(unsigned first, unsigned count);

    /// Triangles from `count` vertices.
    void draw(int count, int instances = 1) const;
    /// Triangles from the first `count` indices.
    void draw_indexed(int count) const;
    /// Draws them for each of so many instances, whose attributes lie in `buffer` from `offset` on.
    void draw_instances(int count, const StreamBuffer& buffer, std::size_t offset, int instances) const;

    GLuint id() const { return handle_.get(); }

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    void bind() const;

    Handle<Release> handle_;
    unsigned bindings_ = 0;
    struct {
        unsigned binding = 0;
        unsigned first = 0;
        unsigned count = 0;
        mutable bool enabled = false;  ///< not before a buffer is there
    } instances_;
    std::size_t indices_ = 0;
};

}  // namespace rowland::gpu
