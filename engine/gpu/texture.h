#pragma once

#include <epoxy/gl.h>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/gpu/handle.h"

namespace rowland::gpu {

/// Texel formats of textures and framebuffers. 8, 10 and 16 without a suffix are unsigned normalised. RGB9_E5 has three
/// numbers of nine bits and their common exponent, of textures alone.
enum class Format {
    RGBA8,
    SRGB8_A8,
    RGB10_A2,
    RGB9_E5,
    RGBA16,
    RG16F,
    RGBA16F,
    R32F,
    RG32F,
    RGB32F,
    RGBA32F,
    Depth32F,
};

GLenum internal_format(Format format);
int bytes_per_texel(Format format);
/// Whether texels are half floats. If so, 16-bit uploads are their bits.
bool is_half_float(Format format);

enum class TextureKind { Line, Plane, PlaneArray, Volume, CubeMap };  ///< GLSL: sampler1D, 2D, 2DArray, 3D, Cube

struct TextureDesc {
    TextureKind kind = TextureKind::Plane;
    Format format = Format::RGBA16F;
    int width = 1;
    int height = 1;  ///< 1 for a line; the width for a cube map
    int depth = 1;   ///< layers of an array, slices of a volume; otherwise 1
    int levels = 1;  ///< mip levels; 0: down to 1×1

    friend bool operator==(const TextureDesc&, const TextureDesc&) = default;
};

enum class Filter { Nearest, Linear, Trilinear };  ///< Nearest: of the nearest level as well
enum class Wrap { Clamp, Repeat, Mirror };

struct Sampling {
    Filter filter = Filter::Linear;
    Wrap wrap_s = Wrap::Clamp;
    Wrap wrap_t = Wrap::Clamp;
    Wrap wrap_r = Wrap::Clamp;
    float anisotropy = 1.0F;     ///< at most max_anisotropy()
    float level_bias = 0.0F;     ///< added to the level that texture() chooses
    bool compare_depth = false;  ///< of a depth texture: sampler2DShadow, 1 where the reference ≤ the texel
};

/// The largest anisotropy; 1 without driver support.
float max_anisotropy();

/// The anisotropy to draw with: max_anisotropy(), but 1 on a software renderer. llvmpipe averages many more texels than
/// a GPU: it took a quarter of a frame of textured objects, and seconds where coordinates change abruptly.
float affordable_anisotropy();

/// Which part of a texture an upload or a read means: all of a level's width and height, and `layers` layers (array),
/// slices (volume) or faces (cube map: +X, −X, +Y, −Y, +Z, −Z) from `layer` on.
struct TextureSlice {
    int level = 0;
    int layer = 0;
    int layers = 1;
};

/// A texture of fixed size and format. The first uploaded row is at t = 0.
class Texture {
 public:
    Texture() = default;
    /// It is a logic error if a size is below 1 or does not suit the kind. Throws Error (system) if a size is above the
    /// GPU's limit (context.h).
    explicit Texture(const TextureDesc& desc, const Sampling& sampling = {});

    /// Writes whole slices. The data's length gives the components per texel (1 to 4, independent of the format;
    /// missing ones become 0, alpha 1). 8- and 16-bit data is normalised, except that 16-bit data of half-float formats
    /// is the bits of halves, all components of each texel. It is a logic error if the length does not suit the slice.
    void upload(std::span<const float> data, TextureSlice slice = {});
    void upload(std::span<const std::uint8_t> data, TextureSlice slice = {});
    void upload(std::span<const std::uint16_t> data, TextureSlice slice = {});
    /// One number per texel of RGB10_A2 or RGB9_E5, red in the lowest bits.
    void upload(std::span<const std::uint32_t> data, TextureSlice slice = {});
    void upload(std::span<const glm::vec3> data, TextureSlice slice = {});
    void upload(std::span<const glm::vec4> data, TextureSlice slice = {});

    /// Fills the levels above 0 with box-filtered copies.
    void generate_levels();
    void set_sampling(const Sampling& sampling);
    /// Binds to a texture unit, as `layout(binding = unit)` in GLSL.
    void bind(unsigned unit) const;
    /// Binds level 0 with all its layers to an image unit, for a compute program to read and write.
    void bind_image(unsigned unit) const;

    /// Texels of whole slices as floats, RGBA, in the order of uploads. Waits for the GPU.
    std::vector<glm::vec4> read(TextureSlice slice = {}) const;

    const TextureDesc& desc() const { return desc_; }
    int levels() const { return desc_.levels; }
    glm::ivec2 size(int level = 0) const;
    /// GPU memory of all levels and layers.
    std::size_t bytes() const;
    GLuint id() const { return handle_.get(); }

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    void upload_typed(const void* data, std::size_t count, GLenum type, TextureSlice slice);
    void upload_area(const void* data, GLenum layout, GLenum type, TextureSlice slice);
    std::size_t texels(TextureSlice slice) const;

    Handle<Release> handle_;
    TextureDesc desc_;
};

}  // namespace rowland::gpu
