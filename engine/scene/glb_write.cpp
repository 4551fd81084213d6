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
#include "engine/scene/gltf_document.h"

namespace rowland::scene {

namespace {

/// Keys in the order they are written, so that the bytes are the same every time.
using Json = nlohmann::ordered_json;

constexpr const char* kLights = "KHR_lights_punctual";
constexpr const char* kTextureTransform = "KHR_texture_transform";

/// A float with no more digits than tell it from its neighbours.
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
        return pack(describe().dump());
    }

 private:
    /// The file's JSON. glTF has no empty arrays.
    Json describe() {
        Json root;
        root["asset"] = {{"version", "2.0"}, {"generator", "Rowland"}};
        const auto add = [&root](const char* key, Json& array) {
            if (!array.empty()) root[key] = std::move(array);
        };
        Json extensions = Json::array();
        for (const std::string& name : used_) extensions.push_back(name);
        add("extensionsUsed", extensions);
        if (used_.contains(kDracoExtension)) root["extensionsRequired"] = Json::array({kDracoExtension});
        root["scene"] = 0;
        root["scenes"] = Json::array({Json::object()});
        if (!roots_.empty()) root["scenes"][0]["nodes"] = std::move(roots_);
        add("nodes", nodes_);
        add("meshes", meshes_);
        add("materials", materials_);
        add("textures", textures_);
        add("images", images_);
        add("samplers", samplers_);
        add("cameras", cameras_);
        if (!lights_.empty()) root["extensions"][kLights]["lights"] = std::move(lights_);
        add("accessors", accessors_);
        add("bufferViews", views_);
        if (!binary_.empty()) root["buffers"] = Json::array({Json{{"byteLength", binary_.size()}}});
        return root;
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
            use(kLights);
            json["extensions"][kLights]["light"] = checked(*node.light, scene_.lights.size());
        }
        if (!node.extras.is_null()) json["extras"] = node.extras;
        nodes_.push_back(std::move(json));
        if (node.parent)
            nodes_[checked(*node.parent, index)]["children"].push_back(index);
        else
            roots_.push_back(index);
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
        meshes_.push_back(Json{{"name", mesh.name}, {"primitives", std::move(primitives)}});
    }

    Json add_primitive(const GlbPrimitive& primitive, const DracoStream& stream) {
        use(kDracoExtension);
        constexpr int kFloat = 5126;
        constexpr int kUint32 = 5125;
        const std::size_t vertices = primitive.mesh.positions.size();
        Json attributes;
        attributes["POSITION"] = add_accessor(kFloat, vertices, "VEC3");
        accessors_.back()["min"] = to_json(stream.bounds.minimum);
        accessors_.back()["max"] = to_json(stream.bounds.maximum);
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
        if (material.blend) json["alphaMode"] = "BLEND";
        if (material.double_sided) json["doubleSided"] = true;
        for (const auto& [name, value] : material.extensions.items()) {
            use(name);
            json["extensions"][name] = value;
        }
        materials_.push_back(std::move(json));
    }

    void add_texture(const GlbTexture& texture) {
        Json json = {{"name", texture.name}, {"source", images_.size()}};
        if (texture.clamp_x || texture.clamp_y) {
            constexpr int kRepeat = 10497;
            constexpr int kClampToEdge = 33071;
            json["sampler"] = samplers_.size();
            samplers_.push_back(Json{{"wrapS", texture.clamp_x ? kClampToEdge : kRepeat},
                                     {"wrapT", texture.clamp_y ? kClampToEdge : kRepeat}});
        }
        textures_.push_back(std::move(json));
        images_.push_back(
            Json{{"name", texture.name}, {"mimeType", "image/png"}, {"bufferView", add_view(texture.png)}});
    }

    void add_camera(const GlbCamera& camera) {
        Json lens = {{"yfov", camera.vertical_field_of_view}, {"znear", camera.near_plane}, {"zfar", camera.far_plane}};
        cameras_.push_back(Json{{"name", camera.name}, {"type", "perspective"}, {"perspective", std::move(lens)}});
    }

    void add_light(const GlbLight& light) {
        use(kLights);
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
        lights_.push_back(std::move(json));
    }

    /// Colours are at most 1.
    static void add_strength(const glm::vec3& strength, Json& json) {
        const float largest = std::max({strength.x, strength.y, strength.z});
        json["color"] = to_json(largest > 0.0F ? strength / largest : glm::vec3(1.0F));
        json["intensity"] = few_digits(largest);
    }

    std::size_t add_accessor(int component, std::size_t count, const char* type) {
        accessors_.push_back(Json{{"componentType", component}, {"count", count}, {"type", type}});
        return accessors_.size() - 1;
    }

    std::size_t add_view(std::span<const std::byte> bytes) {
        binary_.resize((binary_.size() + 3) / 4 * 4);
        views_.push_back(Json{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        return views_.size() - 1;
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
        add_chunk(chunks, 0x4E4F534A, std::as_bytes(std::span(json)), ' ');  // "JSON"
        add_chunk(chunks, 0x004E4942, binary_, '\0');                        // "BIN"
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
    std::size_t written_ = 0;           ///< of them
    Json roots_ = Json::array();
    Json nodes_ = Json::array();
    Json meshes_ = Json::array();
    Json materials_ = Json::array();
    Json textures_ = Json::array();
    Json images_ = Json::array();
    Json samplers_ = Json::array();
    Json cameras_ = Json::array();
    Json lights_ = Json::array();
    Json accessors_ = Json::array();
    Json views_ = Json::array();
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
