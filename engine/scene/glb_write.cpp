#include "engine/scene/glb_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <type_traits>
#include <utility>

#include "engine/core/byte_stream.h"
#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

/// Keys in the order they are written, so that the bytes are the same every time.
using Json = nlohmann::ordered_json;

constexpr const char* kTextureTransform = "KHR_texture_transform";

/// A float with the fewest digits that distinguish it from its neighbours.
double few_digits(float x) {
    return std::stod(fmt::format("{}", x));
}

template <typename Vector>
Json to_json(const Vector& v) {
    Json array = Json::array();
    for (int i = 0; i < Vector::length(); ++i) {
        if constexpr (std::is_same_v<typename Vector::value_type, float>)
            array.push_back(few_digits(v[i]));
        else
            array.push_back(v[i]);
    }
    return array;
}

class Writing {
 public:
    Writing(const GlbScene& scene, const DracoBits& bits) : scene_(scene), streams_(encode(scene, bits)) {}

    std::vector<std::byte> write() {
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) add_node(i);
        for (const GlbMesh& mesh : scene_.meshes) add_mesh(mesh);
        for (const GlbMaterial& material : scene_.materials) add_material(material);
        for (const GlbTexture& texture : scene_.textures) add_texture(texture);
        for (const GlbCamera& camera : scene_.cameras) add_camera(camera);
        for (const GlbLight& light : scene_.lights) add_light(light);
        return pack(finish().dump());
    }

 private:
    Json& array(const char* key) { return root_[key]; }

    /// The complete JSON. glTF has no empty arrays.
    Json finish() {
        for (const std::string& name : used_) array("extensionsUsed").push_back(name);
        if (used_.contains(kDracoExtension)) array("extensionsRequired").push_back(kDracoExtension);
        if (!binary_.empty()) array("buffers").push_back({{"byteLength", binary_.size()}});
        Json json;
        for (auto& [key, value] : root_.items())
            if (!value.is_null()) json[key] = std::move(value);
        return json;
    }

    void use(const std::string& extension) { used_.insert(extension); }

    void add_node(std::size_t index) {
        const GlbNode& node = scene_.nodes[index];
        Json json = {{"name", node.name}};
        const Transform& at = node.local;
        if (at.translation != glm::vec3(0.0F)) json["translation"] = to_json(at.translation);
        if (at.rotation != glm::quat(1.0F, 0.0F, 0.0F, 0.0F))
            json["rotation"] = to_json(glm::vec4(at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w));
        if (at.scale != glm::vec3(1.0F)) json["scale"] = to_json(at.scale);
        if (node.mesh) json["mesh"] = checked(*node.mesh, scene_.meshes.size());
        if (node.camera) json["camera"] = checked(*node.camera, scene_.cameras.size());
        if (node.light) {
            use(kLightExtension);
            json["extensions"][kLightExtension]["light"] = checked(*node.light, scene_.lights.size());
        }
        if (!node.extras.is_null()) json["extras"] = node.extras;
        array("nodes").push_back(std::move(json));
        Json& above = node.parent ? array("nodes")[checked(*node.parent, index)] : array("scenes")[0];
        above[node.parent ? "children" : "nodes"].push_back(index);
    }

    /// The streams of all primitives, in order.
    static std::vector<DracoStream> encode(const GlbScene& scene, const DracoBits& bits) {
        std::vector<const Mesh*> meshes;
        for (const GlbMesh& mesh : scene.meshes)
            for (const GlbPrimitive& primitive : mesh.primitives) meshes.push_back(&primitive.mesh);
        std::vector<DracoStream> streams(meshes.size());
        parallel_for(meshes.size(), [&](std::size_t i) { streams[i] = encode_draco(*meshes[i], bits); });
        return streams;
    }

    void add_mesh(const GlbMesh& mesh) {
        Json primitives = Json::array();
        for (const GlbPrimitive& primitive : mesh.primitives)
            primitives.push_back(add_primitive(primitive, streams_.at(written_++)));
        array("meshes").push_back(Json{{"name", mesh.name}, {"primitives", std::move(primitives)}});
    }

    Json add_primitive(const GlbPrimitive& primitive, const DracoStream& stream) {
        use(kDracoExtension);
        constexpr int kFloat = 5126;
        constexpr int kUint32 = 5125;
        const std::size_t vertices = primitive.mesh.positions.size();
        Json attributes;
        attributes["POSITION"] = add_accessor(kFloat, vertices, "VEC3");
        array("accessors").back()["min"] = to_json(stream.bounds.minimum);
        array("accessors").back()["max"] = to_json(stream.bounds.maximum);
        attributes["NORMAL"] = add_accessor(kFloat, vertices, "VEC3");
        attributes["TANGENT"] = add_accessor(kFloat, vertices, "VEC4");
        attributes["TEXCOORD_0"] = add_accessor(kFloat, vertices, "VEC2");
        const Json ids = {{"POSITION", DracoIds::kPosition},
                          {"NORMAL", DracoIds::kNormal},
                          {"TANGENT", DracoIds::kTangent},
                          {"TEXCOORD_0", DracoIds::kUv}};
        const std::size_t view = add_view(std::as_bytes(std::span(stream.bytes)));
        Json json = {{"attributes", std::move(attributes)},
                     {"indices", add_accessor(kUint32, primitive.mesh.indices.size(), "SCALAR")},
                     {"extensions", {{kDracoExtension, {{"bufferView", view}, {"attributes", ids}}}}}};
        if (primitive.material) json["material"] = checked(*primitive.material, scene_.materials.size());
        return json;
    }

    void add_material(const GlbMaterial& material) {
        Json pbr = {{"baseColorFactor", to_json(material.colour)},
                    {"metallicFactor", material.metallic},
                    {"roughnessFactor", material.roughness}};
        if (material.colour_texture) {
            Json use_of_it = {{"index", checked(material.colour_texture->texture, scene_.textures.size())}};
            if (material.colour_texture->repeat != glm::dvec2(1.0)) {
                use(kTextureTransform);
                use_of_it["extensions"][kTextureTransform]["scale"] = to_json(material.colour_texture->repeat);
            }
            pbr["baseColorTexture"] = std::move(use_of_it);
        }
        Json json = {{"name", material.name}, {"pbrMetallicRoughness", std::move(pbr)}};
        if (material.emission != glm::dvec3(0.0)) json["emissiveFactor"] = to_json(material.emission);
        if (material.blend) json["alphaMode"] = "BLEND";
        if (material.double_sided) json["doubleSided"] = true;
        for (const auto& [name, value] : material.extensions.items()) {
            use(name);
            json["extensions"][name] = value;
        }
        array("materials").push_back(std::move(json));
    }

    void add_texture(const GlbTexture& texture) {
        Json json = {{"name", texture.name}, {"source", array("images").size()}};
        if (texture.clamp_x || texture.clamp_y) {
            constexpr int kRepeat = 10497;
            constexpr int kClampToEdge = 33071;
            json["sampler"] = array("samplers").size();
            array("samplers")
                .push_back(Json{{"wrapS", texture.clamp_x ? kClampToEdge : kRepeat},
                                {"wrapT", texture.clamp_y ? kClampToEdge : kRepeat}});
        }
        array("textures").push_back(std::move(json));
        array("images").push_back(
            Json{{"name", texture.name}, {"mimeType", "image/png"}, {"bufferView", add_view(texture.png)}});
    }

    void add_camera(const GlbCamera& camera) {
        Json lens = {{"yfov", camera.vertical_field_of_view}, {"znear", camera.near_plane}, {"zfar", camera.far_plane}};
        array("cameras").push_back(
            Json{{"name", camera.name}, {"type", "perspective"}, {"perspective", std::move(lens)}});
    }

    void add_light(const GlbLight& light) {
        use(kLightExtension);
        Json json = {{"name", light.name}};
        if (const auto* distant = std::get_if<DirectionalLight>(&light.light)) {
            json["type"] = "directional";
            add_strength(distant->irradiance, json);
        } else {
            const auto& punctual = std::get<PunctualLight>(light.light);
            json["type"] = punctual.spot ? "spot" : "point";
            add_strength(punctual.intensity, json);
            if (punctual.range_m > 0.0F) json["range"] = few_digits(punctual.range_m);
            if (punctual.spot)
                json["spot"] = {{"innerConeAngle", few_digits(punctual.inner_cone)},
                                {"outerConeAngle", few_digits(punctual.outer_cone)}};
        }
        array("extensions")[kLightExtension]["lights"].push_back(std::move(json));
    }

    /// Colours are at most 1.
    static void add_strength(const glm::vec3& strength, Json& json) {
        const float largest = std::max({strength.x, strength.y, strength.z});
        json["color"] = to_json(largest > 0.0F ? strength / largest : glm::vec3(1.0F));
        json["intensity"] = few_digits(largest);
    }

    std::size_t add_accessor(int component, std::size_t count, const char* type) {
        array("accessors").push_back(Json{{"componentType", component}, {"count", count}, {"type", type}});
        return array("accessors").size() - 1;
    }

    std::size_t add_view(std::span<const std::byte> bytes) {
        binary_.resize((binary_.size() + 3) / 4 * 4);
        array("bufferViews")
            .push_back(Json{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        return array("bufferViews").size() - 1;
    }

    static std::size_t checked(std::size_t index, std::size_t count) {
        ROWLAND_CHECK_OP(index, <, count);
        return index;
    }

    static void add_chunk(ByteWriter& writer, std::uint32_t type, std::span<const std::byte> data, char padding) {
        const std::size_t padded = (data.size() + 3) / 4 * 4;
        writer.value(static_cast<std::uint32_t>(padded));
        writer.value(type);
        for (const std::byte byte : data) writer.value(static_cast<std::uint8_t>(byte));
        for (std::size_t i = data.size(); i < padded; ++i) writer.value(padding);
    }

    std::vector<std::byte> pack(const std::string& json) const {
        ByteWriter chunks;
        add_chunk(chunks, 0x4E4F534A, std::as_bytes(std::span(json)),
                  ' ');                                // "JSON"
        add_chunk(chunks, 0x004E4942, binary_, '\0');  // "BIN"
        ByteWriter file;
        constexpr std::uint32_t kHeaderSize = 12;
        file.value<std::uint32_t>(0x46546C67);  // "glTF"
        file.value<std::uint32_t>(2);
        file.value(static_cast<std::uint32_t>(kHeaderSize + chunks.data().size()));
        std::vector<std::byte> bytes = file.take();
        bytes.insert(bytes.end(), chunks.data().begin(), chunks.data().end());
        return bytes;
    }

    const GlbScene& scene_;
    std::vector<DracoStream> streams_;  ///< of the primitives, in order
    std::size_t written_ = 0;           ///< number of streams written
    /// In the order in which the members are written; null: left out.
    Json root_ = {{"asset", {{"version", "2.0"}, {"generator", "Rowland"}}},
                  {"extensionsUsed", nullptr},
                  {"extensionsRequired", nullptr},
                  {"scene", 0},
                  {"scenes", Json::array({Json::object()})},
                  {"nodes", nullptr},
                  {"meshes", nullptr},
                  {"materials", nullptr},
                  {"textures", nullptr},
                  {"images", nullptr},
                  {"samplers", nullptr},
                  {"cameras", nullptr},
                  {"extensions", nullptr},
                  {"accessors", nullptr},
                  {"bufferViews", nullptr},
                  {"buffers", nullptr}};
    std::vector<std::byte> binary_;
    std::set<std::string> used_;
};

}  // namespace

std::vector<std::byte> write_glb(const GlbScene& scene, const DracoBits& bits) {
    return Writing(scene, bits).write();
}

std::vector<std::byte> write_glb(const Mesh& mesh, const std::string& name, const DracoBits& bits) {
    GlbScene scene;
    scene.meshes.push_back({.name = name, .primitives = {{.mesh = mesh, .material = std::nullopt}}});
    GlbNode node;
    node.name = name;
    node.mesh = 0;
    scene.nodes.push_back(std::move(node));
    return write_glb(scene, bits);
}

}  // namespace rowland::scene
