// The one translation unit that knows tinygltf. The library reads nothing but JSON here: buffers and images it would
// open itself, and some index and Draco data it would read unchecked, so those parts never reach it.

#include "engine/scene/gltf_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>  // tinygltf uses it even with TINYGLTF_NO_FS
#include <glm/gtc/quaternion.hpp>

#include "engine/core/error.h"
#include "engine/scene/decompose.h"
#include "engine/scene/gltf_animation.h"
#include "engine/scene/gltf_camera.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_extras.h"
#include "engine/scene/gltf_light.h"
#include "engine/scene/gltf_material.h"
#include "engine/scene/gltf_skin.h"
#include "engine/scene/gltf_texture.h"

// Draco's shared library exports another build of tinygltf under the same names.
#define tinygltf rowland_tinygltf
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace rowland::scene {

namespace {

const nlohmann::json* draco_of(const nlohmann::json& primitive) {
    const auto extensions = primitive.find("extensions");
    if (extensions == primitive.end()) return nullptr;
    const auto draco = extensions->find(kDracoExtension);
    return draco == extensions->end() ? nullptr : &*draco;
}

/// What of the file the parser is given. Left out: buffers and images (it would load them), what we read
/// ourselves (gltf_material.h and its like) or ignore, and the indices of Draco primitives (it refuses those, as their
/// accessors have no buffer view).
std::string text_for_parser(const nlohmann::json& checked) {
    nlohmann::json reduced;
    for (const char* part : {"asset", "bufferViews", "accessors", "meshes", "nodes", "scenes", "scene"})
        if (const auto found = checked.find(part); found != checked.end()) reduced[part] = *found;
    if (const auto meshes = reduced.find("meshes"); meshes != reduced.end())
        for (nlohmann::json& mesh : *meshes)
            for (nlohmann::json& primitive : mesh["primitives"])
                if (draco_of(primitive)) primitive.erase("indices");
    return reduced.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<std::size_t> index_or_none(int index) {
    if (index < 0) return std::nullopt;
    return static_cast<std::size_t>(index);
}

GltfAccessor convert(const tinygltf::Accessor& from) {
    GltfAccessor to;
    to.view = index_or_none(from.bufferView);
    to.offset = from.byteOffset;
    to.count = from.count;
    to.type = static_cast<ComponentType>(from.componentType);
    to.normalised = from.normalized;
    switch (from.type) {
        case TINYGLTF_TYPE_VEC2:
            to.rows = 2;
            break;
        case TINYGLTF_TYPE_VEC3:
            to.rows = 3;
            break;
        case TINYGLTF_TYPE_VEC4:
            to.rows = 4;
            break;
        case TINYGLTF_TYPE_MAT2:
            to.rows = to.columns = 2;
            break;
        case TINYGLTF_TYPE_MAT3:
            to.rows = to.columns = 3;
            break;
        case TINYGLTF_TYPE_MAT4:
            to.rows = to.columns = 4;
            break;
        default:
            break;
    }
    if (from.sparse.isSparse)
        to.sparse = GltfSparse{.count = static_cast<std::size_t>(from.sparse.count),
                               .index_view = static_cast<std::size_t>(from.sparse.indices.bufferView),
                               .index_offset = static_cast<std::size_t>(from.sparse.indices.byteOffset),
                               .index_type = static_cast<ComponentType>(from.sparse.indices.componentType),
                               .value_view = static_cast<std::size_t>(from.sparse.values.bufferView),
                               .value_offset = static_cast<std::size_t>(from.sparse.values.byteOffset)};
    return to;
}

GltfPrimitive convert(const tinygltf::Primitive& from, const nlohmann::json& json) {
    GltfPrimitive to;
    for (const auto& [name, accessor] : from.attributes) to.attributes[name] = static_cast<std::size_t>(accessor);
    if (const auto indices = json.find("indices"); indices != json.end()) to.indices = indices->get<std::size_t>();
    to.material = index_or_none(from.material);
    to.mode = static_cast<PrimitiveMode>(from.mode);
    if (const nlohmann::json* draco = draco_of(json)) {
        to.draco.emplace();
        to.draco->view = draco->at("bufferView").get<std::size_t>();
        for (const auto& [name, id] : draco->at("attributes").items())
            to.draco->attributes[name] = id.get<std::uint32_t>();
    }
    return to;
}

/// Fills `to.local` and `to.rest`.
void place_node(const tinygltf::Node& from, const std::string& file, std::size_t index, GltfNode& to,
                std::vector<std::string>& warnings) {
    if (from.matrix.size() == 16) {
        std::copy(from.matrix.begin(), from.matrix.end(), &to.local[0][0]);
        // The bottom row of an affine matrix; anything else glTF forbids, and perspective has no meaning here.
        for (int column = 0; column < 4; ++column) to.local[column][3] = column == 3 ? 1.0 : 0.0;
        const Decomposition parts = decompose(to.local);
        to.rest = parts.transform;
        if (parts.sheared)
            warn_once(warnings, "a node's matrix holds shear, which is lost where something animates it");
        return;
    }
    glm::dvec3 translation(0.0);
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    glm::dvec3 scale(1.0);
    if (from.translation.size() == 3) translation = {from.translation[0], from.translation[1], from.translation[2]};
    if (from.scale.size() == 3) scale = {from.scale[0], from.scale[1], from.scale[2]};
    if (from.rotation.size() == 4) {
        rotation = glm::dquat(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
        const double length = glm::length(rotation);
        if (!(length > 1e-3))
            refuse_input(file, fmt::format("/nodes/{}/rotation", index), "a zero quaternion", "a unit quaternion");
        rotation = rotation / length;
    }
    to.local = glm::mat4_cast(rotation);
    for (int column = 0; column < 3; ++column) to.local[column] *= scale[column];
    to.local[3] = glm::dvec4(translation, 1.0);
    to.rest = {glm::vec3(translation), glm::quat(rotation), glm::vec3(scale)};
}

/// The nodes to start from: those of the default scene, of the first scene if none is the default, and without any
/// scene those that are nobody's child.
std::vector<std::size_t> find_roots(const tinygltf::Model& model) {
    std::vector<std::size_t> roots;
    if (!model.scenes.empty()) {
        const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
        for (const int node : model.scenes.at(scene).nodes) roots.push_back(static_cast<std::size_t>(node));
        return roots;
    }
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children) is_child.at(static_cast<std::size_t>(child)) = true;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(i);
    return roots;
}

tinygltf::Model run_parser(const nlohmann::json& checked, const std::string& file) {
    const std::string text = text_for_parser(checked);
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string error;
    std::string warning;
    if (!parser.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), ""))
        throw Error({.file = file,
                     .place = {},
                     .found = error.substr(0, std::min(error.find('\n'), std::size_t{200})),
                     .expected = "valid glTF 2.0",
                     .remedy = {}});
    return model;
}

std::size_t array_size(const nlohmann::json& json, const char* key) {
    const auto found = json.find(key);
    return found == json.end() ? 0 : found->size();
}

/// The parser drops what it cannot read. Nothing may be dropped, or the indices between the arrays would be wrong.
void check_complete(const tinygltf::Model& model, const nlohmann::json& checked, const std::string& file) {
    bool complete = model.bufferViews.size() == array_size(checked, "bufferViews") &&
                    model.accessors.size() == array_size(checked, "accessors") &&
                    model.meshes.size() == array_size(checked, "meshes") &&
                    model.nodes.size() == array_size(checked, "nodes") &&
                    model.scenes.size() == array_size(checked, "scenes");
    for (std::size_t i = 0; complete && i < model.meshes.size(); ++i)
        complete = model.meshes[i].primitives.size() == checked.at("meshes")[i].at("primitives").size();
    if (!complete)
        throw Error({.file = file,
                     .place = {},
                     .found = "parts that cannot be read",
                     .expected = "valid glTF 2.0",
                     .remedy = "run a glTF validator on it"});
}

}  // namespace

GltfDocument parse_gltf(const nlohmann::json& checked, const std::string& file, std::vector<std::string>& warnings) {
    const tinygltf::Model model = run_parser(checked, file);
    check_complete(model, checked, file);

    GltfDocument document;
    document.file = file;
    for (const tinygltf::BufferView& view : model.bufferViews)
        document.views.push_back(
            {static_cast<std::size_t>(view.buffer), view.byteOffset, view.byteLength, view.byteStride});
    for (const tinygltf::Accessor& accessor : model.accessors) document.accessors.push_back(convert(accessor));
    for (std::size_t i = 0; i < model.meshes.size(); ++i) {
        GltfMesh& mesh = document.meshes.emplace_back();
        mesh.name = model.meshes[i].name;
        const nlohmann::json& primitives = checked.at("meshes")[i].at("primitives");
        for (std::size_t k = 0; k < primitives.size(); ++k)
            mesh.primitives.push_back(convert(model.meshes[i].primitives[k], primitives[k]));
    }
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        GltfNode& node = document.nodes.emplace_back();
        node.name = model.nodes[i].name;
        place_node(model.nodes[i], file, i, node, warnings);
        node.mesh = index_or_none(model.nodes[i].mesh);
        node.skin = index_or_none(model.nodes[i].skin);
        for (const int child : model.nodes[i].children) node.children.push_back(static_cast<std::size_t>(child));
    }
    document.roots = find_roots(model);
    document.images = read_images(checked, file);
    document.textures = read_textures(checked, file, warnings);
    document.materials = read_materials(checked, file, document.textures, warnings);
    document.skins = read_skins(checked, file);
    document.animations = read_animations(checked, file, warnings);
    document.lights = read_lights(checked, file);
    read_node_lights(checked, file, document.nodes, document.lights.size());
    document.cameras = read_cameras(checked, file, warnings);
    read_node_cameras(checked, file, document.nodes);
    read_node_extras(checked, file, document.nodes, warnings);
    return document;
}

std::vector<std::byte> decode_data_uri(const std::string& uri) {
    constexpr std::string_view kMarker = ";base64,";
    const std::size_t comma = uri.find(',');
    const std::size_t marker = uri.find(kMarker);
    if (marker == std::string::npos || marker + kMarker.size() != comma + 1) return {};
    // The parser knows a few media types only; what the bytes are is no concern of the decoding.
    std::vector<unsigned char> data;
    std::string media_type;
    const std::string known = "data:application/octet-stream;base64," + uri.substr(comma + 1);
    if (!tinygltf::DecodeDataURI(&data, media_type, known, 0, false)) return {};
    std::vector<std::byte> bytes(data.size());
    if (!data.empty()) std::memcpy(bytes.data(), data.data(), data.size());
    return bytes;
}

}  // namespace rowland::scene
