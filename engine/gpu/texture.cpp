#include "engine/gpu/texture.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/core/check.h"
#include "engine/gpu/context.h"
#include "engine/gpu/pipeline_state.h"

namespace rowland::gpu {

namespace {

struct FormatFacts {
    Format format;
    GLenum internal_format;
    int bytes;
};

constexpr std::array<FormatFacts, 12> kFormats = {{{Format::RGBA8, GL_RGBA8, 4},
                                                   {Format::SRGB8_A8, GL_SRGB8_ALPHA8, 4},
                                                   {Format::RGB10_A2, GL_RGB10_A2, 4},
                                                   {Format::RGB9_E5, GL_RGB9_E5, 4},
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

namespace {

constexpr std::array<GLenum, 5> kTargets = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_3D,
                                            GL_TEXTURE_CUBE_MAP};

GLint wrap_mode(Wrap wrap) {
    constexpr std::array<GLint, 3> kModes = {GL_CLAMP_TO_EDGE, GL_REPEAT, GL_MIRRORED_REPEAT};
    return kModes.at(static_cast<std::size_t>(wrap));
}

/// Checks the sizes and fills in the number of levels.
TextureDesc complete(TextureDesc desc) {
    ROWLAND_CHECK_OP(desc.width, >=, 1);
    ROWLAND_CHECK_OP(desc.height, >=, 1);
    ROWLAND_CHECK_OP(desc.depth, >=, 1);
    ROWLAND_CHECK_OP(desc.levels, >=, 0);
    if (desc.kind == TextureKind::Line) ROWLAND_CHECK_OP(desc.height, ==, 1);
    if (desc.kind == TextureKind::CubeMap) ROWLAND_CHECK_OP(desc.width, ==, desc.height);
    if (desc.kind != TextureKind::PlaneArray && desc.kind != TextureKind::Volume) ROWLAND_CHECK_OP(desc.depth, ==, 1);
    const int volume_depth = desc.kind == TextureKind::Volume ? desc.depth : 1;
    const auto longest = static_cast<unsigned>(std::max({desc.width, desc.height, volume_depth}));
    const int full_chain = static_cast<int>(std::bit_width(longest));
    ROWLAND_CHECK_OP(desc.levels, <=, full_chain);
    if (desc.levels == 0) desc.levels = full_chain;
    return desc;
}

/// Slices, layers or faces of a level.
int slice_count(const TextureDesc& desc, int level) {
    if (desc.kind == TextureKind::CubeMap) return 6;
    return desc.kind == TextureKind::Volume ? std::max(desc.depth >> level, 1) : desc.depth;
}

void allocate(GLuint name, const TextureDesc& desc) {
    const GLenum format = internal_format(desc.format);
    switch (desc.kind) {
        case TextureKind::Line:
            glTextureStorage1D(name, desc.levels, format, desc.width);
            return;
        case TextureKind::Plane:
        case TextureKind::CubeMap:
            glTextureStorage2D(name, desc.levels, format, desc.width, desc.height);
            return;
        case TextureKind::PlaneArray:
        case TextureKind::Volume:
            glTextureStorage3D(name, desc.levels, format, desc.width, desc.height, desc.depth);
            return;
    }
}

}  // namespace

float max_anisotropy() {
    float largest = 1.0F;
    if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &largest);
    return largest;
}

float affordable_anisotropy() {
    return renders_in_software() ? 1.0F : max_anisotropy();
}

void Texture::Release::operator()(GLuint name) const {
    glDeleteTextures(1, &name);
    bound_state().forget(BoundState::Slot::Texture, name);
}

Texture::Texture(const TextureDesc& desc, const Sampling& sampling) : desc_(complete(desc)) {
    require_texture(desc_, read_limits());
    GLuint name = 0;
    glCreateTextures(kTargets.at(static_cast<std::size_t>(desc_.kind)), 1, &name);
    handle_ = Handle<Release>(name);
    allocate(name, desc_);
    set_sampling(sampling);
}

glm::ivec2 Texture::size(int level) const {
    return {std::max(desc_.width >> level, 1), std::max(desc_.height >> level, 1)};
}

std::size_t Texture::bytes() const {
    std::size_t texels_total = 0;
    for (int level = 0; level < desc_.levels; ++level) texels_total += texels({level, 0, slice_count(desc_, level)});
    return texels_total * static_cast<std::size_t>(bytes_per_texel(desc_.format));
}

std::size_t Texture::texels(TextureSlice slice) const {
    ROWLAND_CHECK_OP(slice.level, >=, 0);
    ROWLAND_CHECK_OP(slice.level, <, desc_.levels);
    ROWLAND_CHECK_OP(slice.layer, >=, 0);
    ROWLAND_CHECK_OP(slice.layers, >=, 1);
    ROWLAND_CHECK_OP(slice.layer + slice.layers, <=, slice_count(desc_, slice.level));
    const glm::ivec2 area = size(slice.level);
    return static_cast<std::size_t>(area.x) * static_cast<std::size_t>(area.y) * static_cast<std::size_t>(slice.layers);
}

void Texture::upload_typed(const void* data, std::size_t count, GLenum type, TextureSlice slice) {
    const std::size_t texel_count = texels(slice);
    ROWLAND_CHECK(count % texel_count == 0 && count / texel_count >= 1 && count / texel_count <= 4,
                  fmt::format("{} values do not fill {} texels", count, texel_count));
    constexpr std::array<GLenum, 4> layouts{GL_RED, GL_RG, GL_RGB, GL_RGBA};
    upload_area(data, desc_.format == Format::Depth32F ? GL_DEPTH_COMPONENT : layouts[count / texel_count - 1], type,
                slice);
}

void Texture::upload_area(const void* data, GLenum layout, GLenum type, TextureSlice slice) {
    const glm::ivec2 area = size(slice.level);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    switch (desc_.kind) {
        case TextureKind::Line:
            glTextureSubImage1D(id(), slice.level, 0, area.x, layout, type, data);
            return;
        case TextureKind::Plane:
            glTextureSubImage2D(id(), slice.level, 0, 0, area.x, area.y, layout, type, data);
            return;
        case TextureKind::PlaneArray:
        case TextureKind::Volume:
        case TextureKind::CubeMap:
            glTextureSubImage3D(id(), slice.level, 0, 0, slice.layer, area.x, area.y, slice.layers, layout, type, data);
            return;
    }
}

void Texture::upload(std::span<const float> data, TextureSlice slice) {
    upload_typed(data.data(), data.size(), GL_FLOAT, slice);
}

void Texture::upload(std::span<const std::uint8_t> data, TextureSlice slice) {
    upload_typed(data.data(), data.size(), GL_UNSIGNED_BYTE, slice);
}

void Texture::upload(std::span<const std::uint16_t> data, TextureSlice slice) {
    const bool is_half = is_half_float(desc_.format);
    // Drivers copy texels that have all components, but convert others one by one.
    if (is_half)
        ROWLAND_CHECK_OP(data.size_bytes(), ==,
                         texels(slice) * static_cast<std::size_t>(bytes_per_texel(desc_.format)));
    upload_typed(data.data(), data.size(), is_half ? GL_HALF_FLOAT : GL_UNSIGNED_SHORT, slice);
}

void Texture::upload(std::span<const std::uint32_t> data, TextureSlice slice) {
    const bool has_one_exponent = desc_.format == Format::RGB9_E5;
    ROWLAND_CHECK(has_one_exponent || desc_.format == Format::RGB10_A2, "the format has no packed texels");
    ROWLAND_CHECK_OP(data.size(), ==, texels(slice));
    upload_area(data.data(), has_one_exponent ? GL_RGB : GL_RGBA,
                has_one_exponent ? GL_UNSIGNED_INT_5_9_9_9_REV : GL_UNSIGNED_INT_2_10_10_10_REV, slice);
}

void Texture::upload(std::span<const glm::vec3> data, TextureSlice slice) {
    upload_typed(data.data(), 3 * data.size(), GL_FLOAT, slice);
}

void Texture::upload(std::span<const glm::vec4> data, TextureSlice slice) {
    upload_typed(data.data(), 4 * data.size(), GL_FLOAT, slice);
}

void Texture::generate_levels() {
    glGenerateTextureMipmap(id());
}

void Texture::set_sampling(const Sampling& sampling) {
    const GLint magnify = sampling.filter == Filter::Nearest ? GL_NEAREST : GL_LINEAR;
    const GLint minify = sampling.filter == Filter::Trilinear                 ? GL_LINEAR_MIPMAP_LINEAR
                         : sampling.filter == Filter::Nearest && levels() > 1 ? GL_NEAREST_MIPMAP_NEAREST
                                                                              : magnify;
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, magnify);
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, minify);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_S, wrap_mode(sampling.wrap_s));
    glTextureParameteri(id(), GL_TEXTURE_WRAP_T, wrap_mode(sampling.wrap_t));
    glTextureParameteri(id(), GL_TEXTURE_WRAP_R, wrap_mode(sampling.wrap_r));
    if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
        glTextureParameterf(id(), GL_TEXTURE_MAX_ANISOTROPY_EXT, sampling.anisotropy);
    }
    if (desc_.format == Format::Depth32F) {
        glTextureParameteri(id(), GL_TEXTURE_COMPARE_MODE,
                            sampling.compare_depth ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
        glTextureParameteri(id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    glTextureParameterf(id(), GL_TEXTURE_LOD_BIAS, sampling.level_bias);
    // Core in 3.2, but off by default: without it cube maps show the edges of their faces.
    if (desc_.kind == TextureKind::CubeMap) glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

void Texture::bind(unsigned unit) const {
    if (bound_state().changes(BoundState::Slot::Texture, unit, {id()})) glBindTextureUnit(unit, id());
}

void Texture::bind_image(unsigned unit) const {
    glBindImageTexture(unit, id(), 0, GL_TRUE, 0, GL_READ_WRITE, internal_format(desc_.format));
}

std::vector<glm::vec4> Texture::read(TextureSlice slice) const {
    std::vector<glm::vec4> result(texels(slice));
    const glm::ivec2 area = size(slice.level);
    const bool is_depth = desc_.format == Format::Depth32F;
    std::vector<float> depths(is_depth ? result.size() : 0);
    void* data = is_depth ? static_cast<void*>(depths.data()) : static_cast<void*>(result.data());
    const std::size_t bytes_read = is_depth ? depths.size() * sizeof(float) : result.size() * sizeof(glm::vec4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(id(), slice.level, 0, 0, slice.layer, area.x, area.y, slice.layers,
                         is_depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, static_cast<GLsizei>(bytes_read), data);
    for (std::size_t i = 0; i < depths.size(); ++i) result[i] = {depths[i], 0.0F, 0.0F, 1.0F};
    return result;
}

}  // namespace rowland::gpu
