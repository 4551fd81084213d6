#include "engine/gpu/format.h"

#include <algorithm>
#include <array>

#include "engine/core/check.h"

namespace rowland::gpu {

namespace {

struct FormatFacts {
    Format format;
    GLenum internal_format;
    int bytes;
};

constexpr std::array<FormatFacts, 11> kFormats = {{{Format::RGBA8, GL_RGBA8, 4},
                                                   {Format::SRGB8_A8, GL_SRGB8_ALPHA8, 4},
                                                   {Format::RGB10_A2, GL_RGB10_A2, 4},
                                                   {Format::RGBA16, GL_RGBA16, 8},
                                                   {Format::RG16F, GL_RG16F, 4},
                                                   {Format::RGBA16F, GL_RGBA16F, 8},
                                                   {Format::R32F, GL_R32F, 4},
                                                   {Format::RG32F, GL_RG32F, 8},
                                                   {Format::RGB32F, GL_RGB32F, 12},
                                                   {Format::RGBA32F, GL_RGBA32F, 16},
                                                   {Format::Depth32F, GL_DEPTH_COMPONENT32F, 4}}};

const FormatFacts& facts(Format format) {
    const auto* found = std::ranges::find(kFormats, format, &FormatFacts::format);
    ROWLAND_CHECK(found != kFormats.end(), "unknown texture format");
    return *found;
}

}  // namespace

GLenum internal_format(Format format) {
    return facts(format).internal_format;
}

int bytes_per_texel(Format format) {
    return facts(format).bytes;
}

bool is_half_float(Format format) {
    return format == Format::RG16F || format == Format::RGBA16F;
}

}  // namespace rowland::gpu
