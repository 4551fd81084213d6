#pragma once

#include <epoxy/gl.h>

namespace rowland::gpu {

/// Texel formats of textures and framebuffers. 8, 10 and 16 without a suffix are unsigned normalised.
enum class Format {
    RGBA8,
    SRGB8_A8,
    RGB10_A2,
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
/// Then 16-bit uploads are the bits of half floats.
bool is_half_float(Format format);

}  // namespace rowland::gpu
