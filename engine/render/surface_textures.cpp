#include "engine/render/surface_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

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

/// Means over boxes of a finer level, not normalised: the more the vectors vary, the shorter their mean.
std::vector<glm::vec3> means(const std::vector<glm::vec3>& finer, glm::ivec2 size, glm::ivec2 coarser) {
    std::vector<glm::vec3> result;
    result.reserve(static_cast<std::size_t>(coarser.x) * static_cast<std::size_t>(coarser.y));
    for (int row = 0; row < coarser.y; ++row)
        for (int column = 0; column < coarser.x; ++column) {
            const glm::ivec2 begin = glm::ivec2(column, row) * size / coarser;
            const glm::ivec2 end = glm::ivec2(column + 1, row + 1) * size / coarser;
            glm::vec3 sum(0.0F);
            for (int y = begin.y; y < end.y; ++y)
                for (int x = begin.x; x < end.x; ++x) sum += finer[static_cast<std::size_t>(y * size.x + x)];
            result.push_back(sum / static_cast<float>((end.x - begin.x) * (end.y - begin.y)));
        }
    return result;
}

/// Uploads all levels of TexelMeaning::Normal. The mean of unit vectors is about 1 / sqrt(1 + V) long, where V is the
/// sum of the variances of their slopes.
void upload_normals(const image::ByteImage& image, gpu::Texture& texture) {
    std::vector<glm::vec3> normals;
    normals.reserve(image.rgba.size() / 4);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const glm::vec3 normal = glm::vec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]) / 127.5F - 1.0F;
        normals.push_back(normal / std::max(glm::length(normal), 1e-3F));
    }
    std::vector<std::uint8_t> texels(image.rgba.size());
    for (int level = 0; level < texture.levels(); ++level) {
        if (level > 0) normals = means(normals, texture.size(level - 1), texture.size(level));
        texels.clear();
        for (const glm::vec3& mean : normals) {
            const float length = std::max(glm::length(mean), 1e-3F);
            const float variance = std::max(1.0F / (length * length) - 1.0F, 0.0F);
            const glm::vec4 texel(0.5F + 0.5F / length * mean, 0.5F * std::min(std::sqrt(variance), 2.0F));
            for (int i = 0; i < 4; ++i) texels.push_back(static_cast<std::uint8_t>(std::lround(255.0F * texel[i])));
        }
        texture.upload(std::span<const std::uint8_t>(texels), {.level = level});
    }
}

gpu::Texture upload(const image::ByteImage& image, const scene::ImportedTexture& texture, TexelMeaning meaning) {
    const bool levels = texture.mipmaps && !texture.nearest;
    gpu::Texture result({.format = meaning == TexelMeaning::Srgb ? gpu::Format::SRGB8_A8 : gpu::Format::RGBA8,
                         .width = image.width,
                         .height = image.height,
                         .levels = levels ? 0 : 1},
                        sampling_of(texture));
    if (meaning == TexelMeaning::Normal) {
        upload_normals(image, result);
        return result;
    }
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
        sampling.anisotropy = std::min(kAnisotropy, gpu::affordable_anisotropy());
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
            .normal_texture = texture(from.normal_texture, TexelMeaning::Normal),
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
            .wear_texture = texture(from.wear_texture, TexelMeaning::Linear),
            .scratched = from.wear && from.wear->scratches > 0.0F};
}

}  // namespace rowland::render
