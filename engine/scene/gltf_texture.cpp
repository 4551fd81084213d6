#include <fmt/format.h>

#include "engine/scene/gltf_parts.h"

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
    return {.offset = read_vector_or(extension, "offset", glm::vec2(0.0F), kFiniteFloat),
            .rotation = static_cast<float>(extension.number_or("rotation", 0.0, kFiniteFloat)),
            .scale = read_vector_or(extension, "scale", glm::vec2(1.0F), kFiniteFloat)};
}

}  // namespace

std::vector<GltfImage> read_images(const GltfJson& json) {
    std::vector<GltfImage> images;
    for (JsonReader& image : json.objects("images")) {
        image.text_or("name", "");
        image.text_or("mimeType", "");
        images.push_back({json.index_if_there(image, "bufferView", "bufferViews"), image.text_or("uri", "")});
    }
    return images;
}

std::vector<GltfTexture> read_textures(const GltfJson& json) {
    std::vector<ImportedTexture> samplers;
    for (JsonReader& sampler : json.objects("samplers")) samplers.push_back(read_sampler(sampler));
    std::vector<GltfTexture> textures;
    for (JsonReader& texture : json.objects("textures")) {
        GltfTexture& to = textures.emplace_back();
        texture.text_or("name", "");
        to.image = json.index_if_there(texture, "source", "images");
        if (const auto sampler = json.index_if_there(texture, "sampler", "samplers")) to.settings = samplers[*sampler];
        if (!to.image) json.warn("textures that have no PNG or JPEG image are ignored");
    }
    return textures;
}

std::optional<TextureUse> read_texture_use(const GltfJson& json, JsonReader& owner, const std::string& key,
                                           std::span<const GltfTexture> textures) {
    if (!owner.has(key)) return std::nullopt;
    JsonReader info = owner.object(key);
    TextureUse use;
    use.texture = json.index(info, "index", "textures");
    constexpr std::int64_t kLastSet = 1 << 20;
    std::int64_t uv_set = info.integer_or("texCoord", 0, 0, kLastSet);
    if (auto transform = extension_of(info, "KHR_texture_transform")) {
        use.transform = read_transform(*transform);
        uv_set = transform->integer_or("texCoord", uv_set, 0, kLastSet);
    }
    if (!textures[use.texture].image) return std::nullopt;
    if (uv_set > 1) {
        json.warn("textures that use a third or later set of texture coordinates are ignored");
        return std::nullopt;
    }
    use.uv_set = static_cast<int>(uv_set);
    return use;
}

}  // namespace rowland::scene
