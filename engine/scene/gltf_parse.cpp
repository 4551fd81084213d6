#include "engine/scene/gltf_parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <string_view>

#include "engine/scene/gltf_parts.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

namespace {

// Quantised attributes are ordinary accessors to us, so that extension needs nothing more.
constexpr std::array<std::string_view, 7> kSupportedExtensions = {
    kDracoExtension,       kLightExtension,         "KHR_materials_clearcoat", "KHR_materials_emissive_strength",
    "KHR_materials_unlit", "KHR_mesh_quantization", "KHR_texture_transform"};
constexpr std::int64_t kMaximumBytes = MemoryBudget::kDefaultLimit;
constexpr std::int64_t kMaximumCount = std::numeric_limits<std::int32_t>::max();

struct Version {
    unsigned major = 0;
    unsigned minor = 0;
};

std::optional<Version> parse_version(std::string_view text) {
    Version version;
    const char* const end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, version.major);
    if (major.ec != std::errc{} || major.ptr == end || *major.ptr != '.') return std::nullopt;
    const auto minor = std::from_chars(major.ptr + 1, end, version.minor);
    return minor.ec == std::errc{} && minor.ptr == end ? std::optional(version) : std::nullopt;
}

std::vector<std::string> read_names(JsonReader& root, const std::string& key) {
    std::vector<std::string> names;
    if (!root.has(key)) return names;
    const nlohmann::json& values = root.raw(key);
    if (!values.is_array()) root.fail(key, values.type_name(), "an array of names");
    for (const nlohmann::json& value : values) {
        if (!value.is_string()) root.fail(key, value.type_name(), "a name");
        names.push_back(value.get<std::string>());
    }
    return names;
}

void check_extensions(JsonReader& root, std::span<const std::string> handled, const GltfJson& json) {
    const auto supports = [&](const std::string& name) {
        return std::ranges::find(kSupportedExtensions, name) != kSupportedExtensions.end() ||
               std::ranges::find(handled, name) != handled.end();
    };
    for (const std::string& name : read_names(root, "extensionsRequired"))
        if (!supports(name))
            root.fail("extensionsRequired", fmt::format("\"{:.80}\"", name),
                      fmt::format("no required extension but {}", fmt::join(kSupportedExtensions, ", ")),
                      "export the file without it");
    for (const std::string& name : read_names(root, "extensionsUsed"))
        if (!supports(name)) json.warn(fmt::format("the extension {:.80} is ignored", name));
}

std::size_t read_bytes(JsonReader& reader, const std::string& key) {
    return static_cast<std::size_t>(reader.integer_or(key, 0, 0, kMaximumBytes));
}

std::size_t read_count(JsonReader& reader) {
    return static_cast<std::size_t>(reader.integer("count", 1, kMaximumCount));
}

GltfBufferView read_view(const GltfJson& json, JsonReader& view) {
    GltfBufferView to;
    to.buffer = json.index(view, "buffer", "buffers");
    to.length = static_cast<std::size_t>(view.integer("byteLength", 0, kMaximumBytes));
    to.offset = read_bytes(view, "byteOffset");
    if (view.has("byteStride")) to.stride = static_cast<std::size_t>(view.integer("byteStride", 4, 252));
    if (to.stride % 4 != 0) view.fail("byteStride", fmt::format("{}", to.stride), "a multiple of 4");
    return to;
}

ComponentType read_component_type(JsonReader& reader, std::initializer_list<std::int64_t> allowed) {
    const std::int64_t type = reader.integer("componentType", 0, 65535);
    if (std::ranges::find(allowed, type) == allowed.end())
        reader.fail("componentType", fmt::format("{}", type), fmt::format("one of {}", fmt::join(allowed, ", ")));
    return static_cast<ComponentType>(type);
}

GltfSparse read_sparse(const GltfJson& json, JsonReader sparse) {
    GltfSparse to;
    to.count = read_count(sparse);
    JsonReader indices = sparse.object("indices");
    to.index_view = json.index(indices, "bufferView", "bufferViews");
    to.index_offset = read_bytes(indices, "byteOffset");
    to.index_type = read_component_type(indices, {5121, 5123, 5125});
    JsonReader values = sparse.object("values");
    to.value_view = json.index(values, "bufferView", "bufferViews");
    to.value_offset = read_bytes(values, "byteOffset");
    return to;
}

GltfAccessor read_accessor(const GltfJson& json, JsonReader& accessor) {
    struct Shape {
        int rows;
        int columns;
    };
    const auto shape = accessor.choice<Shape>("type", {{"SCALAR", {1, 1}},
                                                       {"VEC2", {2, 1}},
                                                       {"VEC3", {3, 1}},
                                                       {"VEC4", {4, 1}},
                                                       {"MAT2", {2, 2}},
                                                       {"MAT3", {3, 3}},
                                                       {"MAT4", {4, 4}}});
    GltfAccessor to;
    to.view = json.index_if_there(accessor, "bufferView", "bufferViews");
    to.offset = read_bytes(accessor, "byteOffset");
    to.count = read_count(accessor);
    to.type = read_component_type(accessor, {5120, 5121, 5122, 5123, 5125, 5126});
    to.rows = shape.rows;
    to.columns = shape.columns;
    to.normalised = accessor.boolean_or("normalized", false);
    if (accessor.has("sparse")) to.sparse = read_sparse(json, accessor.object("sparse"));
    return to;
}

GltfDraco read_draco(const GltfJson& json, JsonReader draco) {
    GltfDraco to;
    to.view = json.index(draco, "bufferView", "bufferViews");
    JsonReader ids = draco.object("attributes");
    for (const auto& [name, ignored] : draco.raw("attributes").items())
        to.attributes[name] = static_cast<std::uint32_t>(ids.integer(name, 0, kMaximumCount));
    return to;
}

GltfPrimitive read_primitive(const GltfJson& json, JsonReader& primitive) {
    GltfPrimitive to;
    JsonReader attributes = primitive.object("attributes");
    for (const auto& [name, ignored] : primitive.raw("attributes").items())
        to.attributes[name] = json.index(attributes, name, "accessors");
    to.indices = json.index_if_there(primitive, "indices", "accessors");
    to.material = json.index_if_there(primitive, "material", "materials");
    constexpr auto kTriangles = static_cast<std::int64_t>(PrimitiveMode::Triangles);
    constexpr auto kLast = static_cast<std::int64_t>(PrimitiveMode::TriangleFan);
    to.mode = static_cast<PrimitiveMode>(primitive.integer_or("mode", kTriangles, 0, kLast));
    if (primitive.has("targets")) json.warn("morph targets are ignored");
    if (const auto draco = extension_of(primitive, kDracoExtension)) to.draco = read_draco(json, *draco);
    return to;
}

GltfMesh read_mesh(const GltfJson& json, JsonReader& mesh) {
    GltfMesh to{.name = mesh.text_or("name", ""), .primitives = {}};
    for (JsonReader& primitive : mesh.objects("primitives")) to.primitives.push_back(read_primitive(json, primitive));
    return to;
}

/// The root nodes of the scene to show: the default scene, else the first one. A file without scenes shows the nodes
/// without a parent.
std::vector<std::size_t> find_roots(const GltfJson& json, JsonReader& root, const std::vector<GltfNode>& nodes) {
    std::vector<std::vector<std::size_t>> scenes;
    for (JsonReader& scene : json.objects("scenes")) {
        scene.text_or("name", "");
        scenes.push_back(json.indices_if_there(scene, "nodes", "nodes"));
    }
    const std::size_t shown = json.index_if_there(root, "scene", "scenes").value_or(0);
    if (!scenes.empty()) return scenes[shown];
    std::vector<bool> is_child(nodes.size(), false);
    for (const GltfNode& node : nodes)
        for (const std::size_t child : node.children) is_child[child] = true;
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(i);
    return roots;
}

}  // namespace

void check_asset(JsonReader asset) {
    const auto check = [&](const std::string& key, unsigned most_minor, const std::string& expected) {
        const std::string text = asset.text(key);
        const std::optional<Version> version = parse_version(text);
        if (!version || version->major != 2 || version->minor > most_minor)
            asset.fail(key, fmt::format("\"{:.20}\"", text), expected, "export the file as glTF 2.0");
    };
    check("version", std::numeric_limits<unsigned>::max(), "glTF version 2");
    if (asset.has("minVersion")) check("minVersion", 0, "2.0: no later version is read");
}

GltfDocument parse_gltf(const GltfJson& json, std::span<const std::string> handled_extensions) {
    JsonReader root(json.root, json.file);
    check_asset(root.object("asset"));
    check_extensions(root, handled_extensions, json);
    GltfDocument document;
    document.file = json.file;
    for (JsonReader& buffer : json.objects("buffers")) {
        buffer.integer("byteLength", 1, kMaximumBytes);
        buffer.text_or("uri", "");
    }
    for (JsonReader& view : json.objects("bufferViews")) document.views.push_back(read_view(json, view));
    for (JsonReader& accessor : json.objects("accessors")) document.accessors.push_back(read_accessor(json, accessor));
    for (JsonReader& mesh : json.objects("meshes")) document.meshes.push_back(read_mesh(json, mesh));
    document.images = read_images(json);
    document.textures = read_textures(json);
    document.materials = read_materials(json, document.textures);
    document.skins = read_skins(json);
    document.lights = read_lights(json);
    document.cameras = read_cameras(json);
    document.nodes = read_nodes(json, document.lights.size());
    document.roots = find_roots(json, root, document.nodes);
    return document;
}

}  // namespace rowland::scene
