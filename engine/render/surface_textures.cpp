#include "engine/render/surface_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "engine/core/check.h"
#include "engine/core/error.h"

namespace rowland::render {

namespace {

constexpr float kAnisotropy = 4.0F;

gpu::Wrap to_gpu(scene::TextureWrap wrap) {
    switch (wrap) {
        case scene::TextureWrap::Repeat:
            return gpu::Wrap::Repeat;
        case scene::TextureWrap::Clamp:
            return gpu::Wrap::Clamp;
        case scene::TextureWrap::Mirror:
            return gpu::Wrap::Mirror;
    }
    check_failed(__FILE__, __LINE__, "unknown texture wrap");
}

gpu::Texture upload(const image::ByteImage& image, const scene::ImportedTexture& texture, TexelMeaning meaning) {
    const bool levels = texture.mipmaps && !texture.nearest;
    gpu::Texture result({.format = meaning == TexelMeaning::Srgb ? gpu::Format::SRGB8_A8 : gpu::Format::RGBA8,
                         .width = image.width,
                         .height = image.height,
                         .levels = levels ? 0 : 1},
                        sampling_of(texture));
    // Row 0, the picture's top, lies at v = 0, as glTF has it.
    result.upload(std::span<const std::uint8_t>(image.rgba));
    if (levels) result.generate_levels();
    return result;
}

}  // namespace

gpu::Sampling sampling_of(const scene::ImportedTexture& texture) {
    gpu::Sampling sampling{.wrap_s = to_gpu(texture.wrap_s), .wrap_t = to_gpu(texture.wrap_t)};
    if (texture.nearest) {
        sampling.filter = gpu::Filter::Nearest;
    } else if (texture.mipmaps) {
        sampling.filter = gpu::Filter::Trilinear;
        sampling.anisotropy = std::min(kAnisotropy, gpu::max_anisotropy());
    }
    return sampling;
}

SurfaceTexture SurfaceTextures::get(const scene::TextureUse& use, TexelMeaning meaning) {
    ROWLAND_CHECK_OP(use.texture, <, scene_->textures.size());
    const scene::ImportedTexture& texture = scene_->textures[use.texture];
    ROWLAND_CHECK_OP(texture.image, <, scene_->images.size());
    std::shared_ptr<const gpu::Texture>& made =
        textures_[{texture.image, meaning, texture.wrap_s, texture.wrap_t, texture.nearest, texture.mipmaps}];
    if (!made) made = std::make_shared<const gpu::Texture>(upload(*scene_->images[texture.image], texture, meaning));
    return {.texture = made, .uv_set = use.uv_set, .transform = use.transform};
}

StandardMaterial make_material(const scene::MaterialDescription* description, SurfaceTextures& textures) {
    const scene::MaterialDescription gltf_default;
    const scene::MaterialDescription& from = description ? *description : gltf_default;
    const auto texture = [&](const std::optional<scene::TextureUse>& use, TexelMeaning meaning) {
        return use ? textures.get(*use, meaning) : SurfaceTexture{};
    };
    return {.base_colour = glm::vec3(from.base_colour),
            .metallic = from.metallic,
            .roughness = from.roughness,
            .alpha = from.base_colour.a,
            .emissive = from.emissive,
            .base_colour_texture = texture(from.base_colour_texture, TexelMeaning::Srgb),
            .metallic_roughness_texture = texture(from.metallic_roughness_texture, TexelMeaning::Linear),
            .normal_texture = texture(from.normal_texture, TexelMeaning::Linear),
            .normal_scale = from.normal_scale,
            .occlusion_texture = texture(from.occlusion_texture, TexelMeaning::Linear),
            .occlusion_strength = from.occlusion_strength,
            .emissive_texture = texture(from.emissive_texture, TexelMeaning::Srgb),
            .alpha_mode = from.alpha_mode,
            .alpha_cutoff = from.alpha_cutoff,
            .double_sided = from.double_sided,
            .unlit = from.unlit,
            .clear_coat = from.clear_coat,
            .clear_coat_roughness = from.clear_coat_roughness,
            .wear_texture = texture(from.wear_texture, TexelMeaning::Linear)};
}

}  // namespace rowland::render
