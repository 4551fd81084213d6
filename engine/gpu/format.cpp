#include "engine/gpu/format.h"

#include "engine/core/check.h"

namespace rowland::gpu {

namespace {

struct FormatFacts {
    GLenum internal_format;
    int components;
    int bytes;
};

FormatFacts facts(Format format) {
    switch (format) {
        case Format::R8:
            return {GL_R8, 1, 1};
        case Format::RG8:
            return {GL_RG8, 2, 2};
        case Format::RGBA8:
            return {GL_RGBA8, 4, 4};
        case Format::SRGB8_A8:
            return {GL_SRGB8_ALPHA8, 4, 4};
        case Format::R16:
            return {GL_R16, 1, 2};
        case Format::RG16:
            return {GL_RG16, 2, 4};
        case Format::RGBA16:
            return {GL_RGBA16, 4, 8};
        case Format::R16F:
            return {GL_R16F, 1, 2};
        case Format::RG16F:
            return {GL_RG16F, 2, 4};
        case Format::RGBA16F:
            return {GL_RGBA16F, 4, 8};
        case Format::R32F:
            return {GL_R32F, 1, 4};
        case Format::RG32F:
            return {GL_RG32F, 2, 8};
        case Format::RGB32F:
            return {GL_RGB32F, 3, 12};
        case Format::RGBA32F:
            return {GL_RGBA32F, 4, 16};
        case Format::Depth32F:
            return {GL_DEPTH_COMPONENT32F, 1, 4};
    }
    check_failed(__FILE__, __LINE__, "unknown texture format");
}

}  // namespace

GLenum internal_format(Format format) {
    return facts(format).internal_format;
}

int component_count(Format format) {
    return facts(format).components;
}

int bytes_per_texel(Format format) {
    return facts(format).bytes;
}

bool is_half_float(Format format) {
    return format == Format::R16F || format == Format::RG16F || format == Format::RGBA16F;
}

}  // namespace rowland::gpu
