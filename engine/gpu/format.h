#pragma once

#include <epoxy/gl.h>

namespace rowland::gpu {

/// Texel formats of textures and framebuffers. 8 and 16 without a suffix are unsigned normalised.
enum class Format {
    R8,
    RG8,
    RGBA8,
    SRGB8_A8,
    R16,
    RG16,
    RGBA16,
    R16F,
    RG16F,
    RGBA16F,
    R32F,
    RG32F,
    RGB32F,
    RGBA32F,
    Depth32F,
};

GLenum internal_format(Format format);
int component_count(Format format);
int bytes_per_texel(Format format);
/// True for R16F, RG16F, RGBA16F: 16-bit uploads are then taken as half-float bits.
bool is_half_float(Format format);

}  // namespace rowland::gpu
