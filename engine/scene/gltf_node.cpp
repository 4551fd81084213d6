#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>

#include "engine/scene/decompose.h"
#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

glm::dmat4 read_matrix(JsonReader& node) {
    const std::vector<double> numbers = node.numbers("matrix", 16, kFiniteFloat);
    glm::dmat4 matrix;
    std::copy(numbers.begin(), numbers.end(), &matrix[0][0]);
    // glTF allows affine matrices only; the bottom row of any other is dropped.
    for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1.0 : 0.0;
    return matrix;
}

glm::dquat read_rotation(JsonReader& node) {
    const auto v =
        read_vector_or(node, "rotation", glm::dvec4(0.0, 0.0, 0.0, 1.0), {.minimum = -1.001, .maximum = 1.001});
    const double length = glm::length(v);
    if (!(length > 1e-3)) node.fail("rotation", "a zero quaternion", "a unit quaternion");
    return {v.w / length, v.x / length, v.y / length, v.z / length};
}

/// Sets `to.local` and `to.rest`.
void read_transform(const GltfJson& json, JsonReader& node, GltfNode& to) {
    const auto translation = read_vector_or(node, "translation", glm::dvec3(0.0), kFiniteFloat);
    const glm::dquat rotation = read_rotation(node);
    const auto scale = read_vector_or(node, "scale", glm::dvec3(1.0), kFiniteFloat);
    if (node.has("matrix")) {
        to.local = read_matrix(node);
        const Decomposition parts = decompose(to.local);
        to.rest = parts.transform;
        if (parts.sheared) json.warn("a node's matrix holds shear, which is lost where something animates it");
        return;
    }
    to.local = glm::mat4_cast(rotation);
    for (int column = 0; column < 3; ++column) to.local[column] *= scale[column];
    to.local[3] = glm::dvec4(translation, 1.0);
    to.rest = {glm::vec3(translation), glm::quat(rotation), glm::vec3(scale)};
}

void read_extras(const GltfJson& json, JsonReader& node, GltfNode& to) {
    if (!node.has("extras")) return;
    const nlohmann::json& extras = node.raw("extras");
    const std::size_t bytes = extras.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).size();
    if (bytes > kMostExtrasBytes) return json.warn("extras of more than 64 KiB are ignored");
    to.extras = extras;
    to.extras_bytes = bytes;
}

}  // namespace

std::vector<GltfNode> read_nodes(const GltfJson& json, std::size_t light_count) {
    std::vector<GltfNode> nodes;
    for (JsonReader& node : json.objects("nodes")) {
        GltfNode& to = nodes.emplace_back();
        to.name = node.text_or("name", "");
        to.mesh = json.index_if_there(node, "mesh", "meshes");
        to.skin = json.index_if_there(node, "skin", "skins");
        to.camera = json.index_if_there(node, "camera", "cameras");
        to.children = json.indices_if_there(node, "children", "nodes");
        if (auto light = extension_of(node, kLightExtension))
            to.light = read_index(*light, "light", light_count, "lights");
        read_transform(json, node, to);
        read_extras(json, node, to);
    }
    return nodes;
}

}  // namespace rowland::scene
