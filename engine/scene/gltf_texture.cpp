#include "engine/scene/gltf_texture.h"

#include <fmt/format.h>

#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_index.h"

namespace rowland::scene {

namespace {

// GL's numbers, which glTF uses (glTF 2.0, 5.26).
constexpr std::int64_t kNearest = 9728;
constexpr std::int64_t kLinear = 9729;
constexpr std::int64_t kFirstMipmapFilter = 9984;
constexpr std::int64_t kLastMipmapFilter = 9987;
constexpr std::int64_t kRepeat = 10497;
constexpr std::int64_t kClampToEdge = 33071;
constexpr std::int64_t kMirroredRepeat = 33648;

TextureWrap read_wrap(JsonReader& sampler, const std::string& key) {
    const std::int64_t wrap = sampler.integer_or(key, kRepeat, 0, 65535);
    if (wrap == kRepeat) return TextureWrap::Repeat;
    if (wrap == kClampToEdge) return TextureWrap::Clamp;
    if (wrap == kMirroredRepeat) return TextureWrap::Mirror;
    sampler.fail(key, fmt::format("{}", wrap),
                 fmt::format("one of {}, {}, {}", kRepeat, kClampToEdge, kMirroredRepeat));
}

/// The settings of a sampler; its texture's image is not its business.
ImportedTexture read_sampler(JsonReader& sampler) {
    ImportedTexture settings;
    settings.wrap_s = read_wrap(sampler, "wrapS");
    settings.wrap_t = read_wrap(sampler, "wrapT");
    const std::int64_t enlarging = sampler.integer_or("magFilter", kLinear, kNearest, kLinear);
    settings.nearest = enlarging == kNearest;
    const std::int64_t shrinking = sampler.integer_or("minFilter", kLastMipmapFilter, kNearest, kLastMipmapFilter);
    if (shrinking > kLinear && shrinking < kFirstMipmapFilter)
        sampler.fail("minFilter", fmt::format("{}", shrinking),
                     fmt::format("{}, {} or {} to {}", kNearest, kLinear, kFirstMipmapFilter, kLastMipmapFilter));
    settings.mipmaps = shrinking >= kFirstMipmapFilter;
    return settings;
}

TextureTransform read_transform(JsonReader& extension) {
    TextureTransform transform;
    if (extension.has("offset")) {
        const std::vector<double> offset = extension.numbers("offset", 2, kFiniteFloat);
        transform.offset = glm::vec2(offset[0], offset[1]);
    }
    transform.rotation = static_cast<float>(extension.number_or("rotation", 0.0, kFiniteFloat));
    if (extension.has("scale")) {
        const std::vector<double> scale = extension.numbers("scale", 2, kFiniteFloat);
        transform.scale = glm::vec2(scale[0], scale[1]);
    }
    return transform;
}

}  // namespace

std::vector<GltfImage> read_images(const nlohmann::json& json, const std::string& file) {
    std::vector<GltfImage> images;
    for (JsonReader& image : root_objects(json, file, "images")) {
        text_if_there(image, "name");
        text_if_there(image, "mimeType");
        images.push_back({index_if_there(json, image, "bufferView", "bufferViews"), text_if_there(image, "uri")});
    }
    return images;
}

std::vector<GltfTexture> read_textures(const nlohmann::json& json, const std::string& file,
                                       std::vector<std::string>& warnings) {
    std::vector<ImportedTexture> samplers;
    for (JsonReader& sampler : root_objects(json, file, "samplers")) samplers.push_back(read_sampler(sampler));
    std::vector<GltfTexture> textures;
    for (JsonReader& texture : root_objects(json, file, "textures")) {
        GltfTexture& added = textures.emplace_back();
        text_if_there(texture, "name");
        added.image = index_if_there(json, texture, "source", "images");
        if (const auto sampler = index_if_there(json, texture, "sampler", "samplers"))
            added.settings = samplers[*sampler];
        if (!added.image) warn_once(warnings, "textures that have no PNG or JPEG image are ignored");
    }
    return textures;
}

std::optional<TextureUse> read_texture_use(const nlohmann::json& json, JsonReader& owner, const std::string& key,
                                           std::span<const GltfTexture> textures, std::vector<std::string>& warnings) {
    if (!owner.has(key)) return std::nullopt;
    JsonReader info = owner.object(key);
    TextureUse use;
    use.texture = index_into(json, info, "index", "textures");
    std::int64_t uv_set = info.integer_or("texCoord", 0, 0, 1 << 20);
    if (info.has("extensions")) {
        JsonReader extensions = info.object("extensions");
        if (extensions.has("KHR_texture_transform")) {
            JsonReader transform = extensions.object("KHR_texture_transform");
            use.transform = read_transform(transform);
            uv_set = transform.integer_or("texCoord", uv_set, 0, 1 << 20);
        }
    }
    if (!textures[use.texture].image) return std::nullopt;
    if (uv_set > 1) {
        warn_once(warnings, "textures that use a third or later set of texture coordinates are ignored");
        return std::nullopt;
    }
    use.uv_set = static_cast<int>(uv_set);
    return use;
}

}  // namespace rowland::scene
