// Materials, textures and images of a glTF file.

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <glm/common.hpp>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/image/image.h"
#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

double number_or(const gltf::Value& object, const std::string& key, double fallback) {
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
}

namespace {

// Decoded images have a budget of their own: 16 images of 4096 × 4096 texels.
constexpr std::uint64_t kMaximumPictureBytes = std::uint64_t{1} << 30;

glm::vec2 vec2_or(const gltf::Value& object, const std::string& key, const glm::vec2& fallback) {
    if (!object.Has(key)) return fallback;
    const gltf::Value& array = object.Get(key);
    return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble()};
}

/// Clamps a factor that an exporter rounded to a little over 1.
float factor(double x) {
    return static_cast<float>(std::min(x, 1.0));
}

/// A material's texture, with KHR_texture_transform. nullopt if the material has none, if the texture has no image that
/// we read or, with a warning, if it uses a third or later set of texture coordinates.
template <typename Info>
std::optional<TextureUse> texture_use(const gltf::Model& model, const Info& info, std::vector<std::string>& warnings) {
    if (info.index < 0) return std::nullopt;
    TextureUse use;
    use.texture = static_cast<std::size_t>(info.index);
    use.uv_set = info.texCoord;
    if (const auto found = info.extensions.find(kTextureTransformExtension); found != info.extensions.end()) {
        const gltf::Value& transform = found->second;
        use.transform = {.offset = vec2_or(transform, "offset", glm::vec2(0.0F)),
                         .rotation = static_cast<float>(number_or(transform, "rotation", 0.0)),
                         .scale = vec2_or(transform, "scale", glm::vec2(1.0F))};
        use.uv_set = static_cast<int>(number_or(transform, "texCoord", use.uv_set));
    }
    if (model.textures[use.texture].source < 0) return std::nullopt;
    if (use.uv_set > 1) {
        warn_once(warnings, "textures that use a third or later set of texture coordinates are ignored");
        return std::nullopt;
    }
    return use;
}

MaterialDescription import_material(const gltf::Model& model, const gltf::Material& from,
                                    std::vector<std::string>& warnings) {
    const auto use = [&](const auto& info) { return texture_use(model, info, warnings); };
    const gltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    MaterialDescription to;
    to.name = from.name;
    for (int i = 0; i < 4; ++i) to.base_colour[i] = factor(pbr.baseColorFactor[static_cast<std::size_t>(i)]);
    to.metallic = factor(pbr.metallicFactor);
    to.roughness = factor(pbr.roughnessFactor);
    to.base_colour_texture = use(pbr.baseColorTexture);
    to.metallic_roughness_texture = use(pbr.metallicRoughnessTexture);
    to.normal_texture = use(from.normalTexture);
    to.normal_scale = static_cast<float>(from.normalTexture.scale);
    to.occlusion_texture = use(from.occlusionTexture);
    to.occlusion_strength = factor(from.occlusionTexture.strength);
    to.emissive_texture = use(from.emissiveTexture);
    for (int i = 0; i < 3; ++i) to.emissive[i] = static_cast<float>(from.emissiveFactor[static_cast<std::size_t>(i)]);
    if (from.alphaMode == "MASK") to.alpha_mode = AlphaMode::Mask;
    if (from.alphaMode == "BLEND") to.alpha_mode = AlphaMode::Blend;
    to.alpha_cutoff = static_cast<float>(from.alphaCutoff);
    to.double_sided = from.doubleSided;
    to.unlit = from.extensions.contains("KHR_materials_unlit");
    if (const auto found = from.extensions.find("KHR_materials_emissive_strength"); found != from.extensions.end())
        to.emissive *= static_cast<float>(number_or(found->second, "emissiveStrength", 1.0));
    if (const auto found = from.extensions.find("KHR_materials_clearcoat"); found != from.extensions.end()) {
        to.clear_coat = factor(number_or(found->second, "clearcoatFactor", 0.0));
        to.clear_coat_roughness = factor(number_or(found->second, "clearcoatRoughnessFactor", 0.0));
    }
    if (const auto found = from.extensions.find(kWearExtension); found != from.extensions.end()) {
        const gltf::Value& wear = found->second;
        to.wear = {.scratches = factor(number_or(wear, "scratches", 0.0)),
                   .fingerprints = factor(number_or(wear, "fingerprints", 0.0)),
                   .dust = factor(number_or(wear, "dust", 0.0)),
                   .size_m = static_cast<float>(number_or(wear, "size_m", Wear{}.size_m)),
                   .seed = static_cast<std::uint32_t>(number_or(wear, "seed", Wear{}.seed))};
        to.wear_texture = TextureUse{0, static_cast<int>(number_or(wear, "texCoord", 0.0)), {}};
        if (wear.Has("maskTexture")) {
            const int texture = wear.Get("maskTexture").Get("index").GetNumberAsInt();
            if (model.textures[static_cast<std::size_t>(texture)].source >= 0) to.wear_mask = texture;
        }
    }
    return to;
}

/// Keeps the extensions that are left to their registered handlers as JSON.
void keep_other_extensions(const nlohmann::json& material, MaterialDescription& to,
                           std::vector<std::string>& warnings) {
    if (!material.contains("extensions")) return;
    for (const auto& [name, value] : material["extensions"].items()) {
        if (name == "KHR_materials_clearcoat")
            for (const char* map : {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"})
                if (value.contains(map))
                    warn_once(warnings, fmt::format("a material's {} is not read: its clear coat is even", map));
        if (name != "KHR_materials_clearcoat" && name != "KHR_materials_unlit" &&
            name != "KHR_materials_emissive_strength" && name != kWearExtension)
            to.extensions[name] = value;
    }
}

ImportedTexture sampler_settings(const gltf::Model& model, const gltf::Texture& texture) {
    ImportedTexture settings;
    if (texture.sampler < 0) return settings;
    const gltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
    const auto wrap = [](int mode) {
        if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::Clamp;
        return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::Mirror : TextureWrap::Repeat;
    };
    settings.wrap_s = wrap(sampler.wrapS);
    settings.wrap_t = wrap(sampler.wrapT);
    settings.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    settings.mipmaps = sampler.minFilter < 0 || sampler.minFilter >= TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST;
    return settings;
}

using SharedImage = std::shared_ptr<const image::ByteImage>;

/// An image before it is decoded.
struct Encoded {
    std::size_t image = 0;
    GltfBuffer bytes;
    image::Depth depth = image::Depth::Bytes;
};

/// Marks the images of the textures that the materials' other extensions name: data, of which 16 bits are kept.
std::vector<bool> images_of_extensions(const gltf::Model& model, const std::vector<MaterialDescription>& materials) {
    std::vector<bool> marked(model.images.size(), false);
    const auto mark = [&](const nlohmann::json& info) {
        const auto index = info.is_object() ? info.find("index") : info.end();
        if (index == info.end() || !index->is_number_unsigned() || *index >= model.textures.size()) return;
        const int image = model.textures[index->get<std::size_t>()].source;
        if (image >= 0) marked[static_cast<std::size_t>(image)] = true;
    };
    for (const MaterialDescription& material : materials)
        for (const auto& [name, extension] : material.extensions)
            for (const auto& [key, member] : extension.items()) mark(member);
    return marked;
}

/// Calls `read` and adds the file and the image to the Error that it throws.
template <typename Read>
auto read_at(const std::string& file, std::size_t image, const Read& read) {
    try {
        return read();
    } catch (const Error& error) {
        ErrorInfo info = error.info();
        info.file = file;
        info.location = fmt::format("/images/{}{}{}", image, info.location.empty() ? "" : ", ", info.location);
        throw Error(std::move(info));
    }
}

/// The most that a texel takes once it is decoded.
std::uint64_t texel_bytes(image::Depth depth) {
    return depth == image::Depth::OfFile ? 4 + 8 : 4;
}

/// Throws Error (input) if highly compressed images would use memory out of proportion to the file.
void check_decoded_total(const std::vector<Encoded>& encoded, const std::string& file) {
    std::uint64_t decoded = 0;
    std::uint64_t bytes = 0;
    for (const Encoded& picture : encoded) {
        const image::ByteImageSize size = image::byte_image_size(picture.bytes.bytes, file);
        decoded += texel_bytes(picture.depth) * static_cast<std::uint64_t>(size.width) *
                   static_cast<std::uint64_t>(size.height);
        bytes += picture.bytes.bytes.size();
    }
    if (const std::uint64_t limit = image::decoded_limit(bytes); decoded > limit)
        refuse_input(file, "/images", fmt::format("{} bytes of images that decode to {}", bytes, decoded),
                     fmt::format("at most {}", limit), "scale the images down");
}

/// Fetches the bytes of the images that a texture names. Throws Error (input) if they would take too much memory once
/// decoded.
std::vector<Encoded> fetch(const GltfSource& source, const GltfDocument& document, const std::vector<bool>& is_data,
                           MemoryBudget& budget, std::vector<std::filesystem::path>* read_files) {
    const gltf::Model& model = document.model;
    std::vector<bool> named(model.images.size(), false);
    for (const gltf::Texture& texture : model.textures)
        if (texture.source >= 0) named[static_cast<std::size_t>(texture.source)] = true;
    MemoryBudget pictures(document.file, kMaximumPictureBytes);
    std::vector<Encoded> encoded;
    for (std::size_t i = 0; i < model.images.size(); ++i) {
        if (!named[i]) continue;
        const gltf::Image& from = model.images[i];
        const std::string pointer = fmt::format("/images/{}", i);
        const image::Depth depth = is_data[i] ? image::Depth::OfFile : image::Depth::Bytes;
        Encoded& added = encoded.emplace_back(Encoded{i, {}, depth});
        if (from.bufferView >= 0)
            added.bytes.bytes = document.view_bytes(from.bufferView);
        else
            added.bytes = load_uri(source, from.uri, pointer, budget, read_files);
        const image::ByteImageSize size =
            read_at(document.file, i, [&] { return image::byte_image_size(added.bytes.bytes, ""); });
        pictures.spend(static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height),
                       texel_bytes(depth), pointer);
    }
    check_decoded_total(encoded, document.file);
    return encoded;
}

/// Decodes each into its element of `images`, on all cores.
void decode(const std::vector<Encoded>& encoded, const std::string& file, std::vector<SharedImage>& images) {
    // The error names the first broken image of the file, whichever thread finishes first.
    std::vector<std::exception_ptr> refusals(encoded.size());
    parallel_for(encoded.size(), [&](std::size_t i) {
        try {
            images[encoded[i].image] = read_at(file, encoded[i].image, [&] {
                return std::make_shared<const image::ByteImage>(
                    image::decode_byte_image(encoded[i].bytes.bytes, "", encoded[i].depth));
            });
        } catch (const Error&) {
            refusals[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& refusal : refusals)
        if (refusal) std::rethrow_exception(refusal);
}

/// Adds a texture for each different wear of the materials, drawn on all cores.
void draw_wear(const std::string& file, ImportedScene& scene) {
    constexpr std::size_t kMaximumMaps = 16;
    std::vector<const MaterialDescription*> drawn;
    for (MaterialDescription& material : scene.materials) {
        if (!material.wear) continue;
        const auto same = std::ranges::find_if(drawn, [&](const MaterialDescription* other) {
            return other->wear == material.wear && other->wear_mask == material.wear_mask;
        });
        if (same != drawn.end()) {
            material.wear_texture->texture = (*same)->wear_texture->texture;
            continue;
        }
        if (drawn.size() == kMaximumMaps)
            refuse_input(file, "/materials", fmt::format("more than {} different {}", kMaximumMaps, kWearExtension),
                         "fewer", "give materials the same wear");
        material.wear_texture->texture = scene.textures.size();
        scene.textures.push_back({.image = scene.images.size() + drawn.size()});
        drawn.push_back(&material);
    }
    std::vector<SharedImage> maps(drawn.size());
    parallel_for(drawn.size(), [&](std::size_t i) {
        image::ByteImage map = wear_map(*drawn[i]->wear);
        if (const auto mask = drawn[i]->wear_mask) mask_wear(*scene.images[scene.textures[*mask].image], map);
        maps[i] = std::make_shared<const image::ByteImage>(std::move(map));
    });
    scene.images.insert(scene.images.end(), maps.begin(), maps.end());
}

}  // namespace

std::vector<MaterialDescription> import_materials(const GltfDocument& document, std::vector<std::string>& warnings) {
    std::vector<MaterialDescription> materials;
    for (const gltf::Material& material : document.model.materials) {
        const nlohmann::json& json = document.json.at("materials").at(materials.size());
        materials.push_back(import_material(document.model, material, warnings));
        keep_other_extensions(json, materials.back(), warnings);
    }
    return materials;
}

void import_images(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                   std::vector<std::filesystem::path>* read_files, ImportedScene& scene) {
    const auto white = std::make_shared<const image::ByteImage>(image::ByteImage{1, 1, {255, 255, 255, 255}});
    scene.images.assign(document.model.images.size(), white);
    const std::vector<bool> is_data = images_of_extensions(document.model, scene.materials);
    decode(fetch(source, document, is_data, budget, read_files), document.file, scene.images);
    for (const gltf::Texture& texture : document.model.textures) {
        ImportedTexture& added = scene.textures.emplace_back(sampler_settings(document.model, texture));
        added.image = texture.source >= 0 ? static_cast<std::size_t>(texture.source) : scene.images.size();
        if (texture.source >= 0) continue;
        warn_once(scene.warnings, "textures that have no PNG or JPEG image are ignored");
        scene.images.push_back(white);
    }
    draw_wear(document.file, scene);
}

}  // namespace rowland::scene
