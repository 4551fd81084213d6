#include "modules/diffraction/foil/card.h"

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "engine/image/byte_image.h"
#include "engine/scene/gltf_source.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/foil/card_mesh.h"
#include "modules/diffraction/foil/card_textures.h"

namespace rowland::diffraction::foil {

namespace {

using OrderedJson = nlohmann::ordered_json;

// Numbers of glTF 2.0.
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kLinear = 9729;
constexpr int kNearest = 9728;
constexpr int kLinearMipmapLinear = 9987;
constexpr int kClampToEdge = 33071;

/// A binary glTF under construction.
class Glb {
 public:
    Glb() {
        json_["asset"] = {{"version", "2.0"}, {"generator", "Rowland"}};
        json_["scene"] = 0;
        json_["scenes"].push_back({{"nodes", OrderedJson::array({0})}});
        json_["nodes"].push_back({{"name", "Card"}, {"mesh", 0}});
        json_["meshes"].push_back({{"name", "Card"}, {"primitives", OrderedJson::array()}});
    }

    OrderedJson& json() { return json_; }

    void add_primitive(const scene::Mesh& mesh, int material) {
        OrderedJson primitive;
        primitive["attributes"]["POSITION"] = add_accessor<glm::vec3>(mesh.positions, "VEC3");
        const scene::Bounds box = bounds(mesh);
        OrderedJson& positions = json_["accessors"].back();
        positions["min"] = {box.minimum.x, box.minimum.y, box.minimum.z};
        positions["max"] = {box.maximum.x, box.maximum.y, box.maximum.z};
        primitive["attributes"]["NORMAL"] = add_accessor<glm::vec3>(mesh.normals, "VEC3");
        primitive["attributes"]["TANGENT"] = add_accessor<glm::vec4>(mesh.tangents, "VEC4");
        primitive["attributes"]["TEXCOORD_0"] = add_accessor<glm::vec2>(mesh.uvs, "VEC2");
        std::vector<std::uint16_t> indices;
        for (const std::uint32_t index : mesh.indices) indices.push_back(static_cast<std::uint16_t>(index));
        primitive["indices"] =
            add_array(std::as_bytes(std::span(indices)), indices.size(), kUnsignedShort, "SCALAR", kElementArrayBuffer);
        primitive["material"] = material;
        json_["meshes"][0]["primitives"].push_back(std::move(primitive));
    }

    /// Returns the index of the texture.
    int add_texture(std::vector<std::byte> image, const char* name, bool nearest = false) {
        const char* type = image::is_jpeg(image) ? "image/jpeg" : "image/png";
        json_["images"].push_back({{"name", name}, {"mimeType", type}, {"bufferView", add_view(image)}});
        const OrderedJson sampler{{"magFilter", nearest ? kNearest : kLinear},
                                  {"minFilter", nearest ? kNearest : kLinearMipmapLinear},
                                  {"wrapS", kClampToEdge},
                                  {"wrapT", kClampToEdge}};
        OrderedJson& samplers = json_["samplers"];
        const auto known = std::find(samplers.begin(), samplers.end(), sampler);
        const auto index = known - samplers.begin();
        if (known == samplers.end()) samplers.push_back(sampler);
        json_["textures"].push_back({{"sampler", index}, {"source", json_["images"].size() - 1}});
        return static_cast<int>(json_["textures"].size()) - 1;
    }

    int add_material(OrderedJson material) {
        json_["materials"].push_back(std::move(material));
        return static_cast<int>(json_["materials"].size()) - 1;
    }

    std::vector<std::byte> bytes(const std::string& file) {
        binary_.resize(scene::padded_chunk(binary_.size()));
        json_["buffers"].push_back({{"byteLength", binary_.size()}});
        std::vector<std::byte> all = scene::glb_beginning(json_.dump(), binary_.size(), 0, file);
        all.insert(all.end(), binary_.begin(), binary_.end());
        return all;
    }

 private:
    std::size_t add_view(std::span<const std::byte> bytes, int target = 0) {
        binary_.resize(scene::padded_chunk(binary_.size()));
        OrderedJson view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
        if (target != 0) view["target"] = target;
        json_["bufferViews"].push_back(std::move(view));
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        return json_["bufferViews"].size() - 1;
    }

    std::size_t add_array(std::span<const std::byte> bytes, std::size_t count, int component, const char* type,
                          int target) {
        json_["accessors"].push_back(
            {{"bufferView", add_view(bytes, target)}, {"componentType", component}, {"count", count}, {"type", type}});
        return json_["accessors"].size() - 1;
    }

    template <typename Vector>
    std::size_t add_accessor(const std::vector<Vector>& values, const char* type) {
        return add_array(std::as_bytes(std::span(values)), values.size(), kFloat, type, kArrayBuffer);
    }

    OrderedJson json_;
    std::vector<std::byte> binary_;
};

OrderedJson surface(double metallic, double roughness) {
    return {{"metallicFactor", metallic}, {"roughnessFactor", roughness}};
}

int add_front(const Recipe& recipe, const CardTexels& texels, CardTextures& textures, Glb& glb) {
    OrderedJson pbr = surface(texels.metallic, texels.roughness);
    pbr["baseColorTexture"] = {{"index", glb.add_texture(std::move(textures.base_colour), "artwork")}};
    if (!textures.metallic_roughness.empty())
        pbr["metallicRoughnessTexture"] = {
            {"index", glb.add_texture(std::move(textures.metallic_roughness), "metal_and_paper")}};
    std::optional<int> grooves;
    if (!textures.grooves.empty())
        grooves = glb.add_texture(std::move(textures.grooves), "grooves", foil_grating(recipe.foil).sparkle);
    OrderedJson material{{"name", "Front"}, {"pbrMetallicRoughness", std::move(pbr)}};
    material["extensions"][kGltfExtension] = foil_material(recipe.foil, texels.layers, grooves);
    glb.json()["extensionsUsed"].push_back(kGltfExtension);
    return glb.add_material(std::move(material));
}

int add_paper(const char* name, std::optional<int> texture, Glb& glb) {
    OrderedJson pbr = surface(0.0, 0.6);
    if (texture)
        pbr["baseColorTexture"] = {{"index", *texture}};
    else
        pbr["baseColorFactor"] = {0.9, 0.89, 0.86, 1.0};
    return glb.add_material({{"name", name}, {"pbrMetallicRoughness", std::move(pbr)}});
}

}  // namespace

std::vector<std::string> picture_names(const Recipe& recipe) {
    std::set<std::string> names = {recipe.artwork, recipe.mask, recipe.card.back};
    if (const auto* two = std::get_if<TwoPictures>(&recipe.foil.type))
        names.insert(two->pictures.begin(), two->pictures.end());
    if (const auto* own = std::get_if<Own>(&recipe.foil.type)) names.insert(own->drawing);
    names.erase("");
    return {names.begin(), names.end()};
}

std::vector<std::byte> card_file(const Recipe& recipe, const CardTexels& texels, CardTextures textures,
                                 const std::string& file) {
    const CardMesh mesh = card_mesh(recipe.card);
    Glb glb;
    glb.add_primitive(mesh.front, add_front(recipe, texels, textures, glb));
    std::optional<int> back;
    if (!textures.back.empty()) back = glb.add_texture(std::move(textures.back), "back");
    glb.add_primitive(mesh.back, add_paper("Back", back, glb));
    glb.add_primitive(mesh.edge, add_paper("Edge", std::nullopt, glb));
    return glb.bytes(file);
}

std::vector<std::byte> make_card(const Recipe& recipe, const NamedPictures& pictures, const std::string& file,
                                 const OnStep& on_step) {
    const CardTexels texels = card_texels(recipe, pictures, file, on_step);
    return card_file(recipe, texels, card_textures(texels, recipe, pictures, on_step), file);
}

std::vector<std::byte> groove_texture(const Foil& foil, const Area& area) {
    return image::encode_png(area.width_px, area.height_px, 3, groove_texels(area, groove_field(foil, area)),
                             image::PngEffort::Small);
}

}  // namespace rowland::diffraction::foil
