#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "engine/gpu/buffer.h"
#include "engine/gpu/fence.h"
#include "engine/gpu/handle.h"

namespace rowland::gpu {

/// GPU memory whose content is replaced up to once a frame, as a whole. Draws read what was last written before them.
/// The first content is kept once. From the second write on there are three copies, written in turn, so that the GPU
/// may be two writes late. They are replaced only if the content does not fit.
class StreamBuffer {
 public:
    /// Waits only if the GPU is more than two writes late. Throws Error (system) if there is no memory.
    void write(std::span<const std::byte> data);
    template <typename T>
    void write_values(std::span<const T> values) {
        write(std::as_bytes(values));
    }

    /// Binds `bytes` from `offset` on, a multiple of kBufferAlignment.
    void bind_uniform(unsigned binding, std::size_t offset, std::size_t bytes) const;
    void bind_storage(unsigned binding, std::size_t offset, std::size_t bytes) const;
    /// Binds all of it.
    void bind_uniform(unsigned binding) const { bind_uniform(binding, 0, size_); }
    void bind_storage(unsigned binding) const { bind_storage(binding, 0, size_); }

    /// Binds all of it to a texture unit, as texels of three floats for a samplerBuffer.
    void bind_texels(unsigned unit) const;

    /// Of the content, bytes.
    std::size_t size() const { return size_; }
    /// How often content was written.
    int writes() const { return writes_; }

 private:
    static constexpr std::size_t kCopies = 3;
    struct ReleaseTexture {
        void operator()(GLuint name) const;
    };
    void allocate(std::size_t copy_bytes, std::size_t copies);
    void next_copy();

    Buffer buffer_;
    std::span<std::byte> mapped_;
    std::size_t stride_ = 0;                          ///< of the copies
    std::size_t copy_ = 0;                            ///< the last one written
    std::array<std::optional<Fence>, kCopies> read_;  ///< after the draws that read a copy
    std::size_t size_ = 0;
    int writes_ = 0;
    mutable Handle<ReleaseTexture> texels_;  ///< made when first bound
    mutable int texels_write_ = 0;           ///< which write it shows; 0: none
};

}  // namespace rowland::gpu
