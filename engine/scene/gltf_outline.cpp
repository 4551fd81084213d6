#include "engine/scene/gltf_outline.h"

#include <algorithm>

#include "engine/core/json_reader.h"
#include "engine/scene/gltf_json.h"
#include "engine/scene/gltf_parse.h"

namespace rowland::scene {

namespace {

void check_names(JsonReader& root, const std::string& key) {
    if (!root.has(key)) return;
    const nlohmann::json& names = root.raw(key);
    if (!names.is_array() || !std::ranges::all_of(names, [](const auto& name) { return name.is_string(); }))
        root.fail(key, names.is_array() ? "an element of another type" : names.type_name(), "an array of names");
}

void collect_extensions(const nlohmann::ordered_json& value, std::set<std::string>& names) {
    if (!value.is_structured()) return;
    for (const auto& [key, member] : value.items()) {
        if (value.is_object() && key == "extras") continue;
        if (value.is_object() && key == "extensions" && member.is_object())
            for (const auto& [name, ignored] : member.items()) names.insert(name);
        collect_extensions(member, names);
    }
}

}  // namespace

std::size_t GltfOutline::uses(std::size_t material) const {
    std::size_t count = 0;
    for (const GltfMeshOutline& mesh : meshes)
        count += static_cast<std::size_t>(std::ranges::count(mesh.materials, std::optional(material)));
    return count;
}

GltfOutline read_outline(const nlohmann::json& gltf, const std::string& file) {
    std::vector<std::string> ignored;
    const GltfJson json{gltf, file, ignored};
    JsonReader root(gltf, file);
    check_asset(root.object("asset"));
    GltfOutline outline;
    for (JsonReader& material : json.objects("materials")) {
        outline.materials.push_back(material.text_or("name", ""));
        material.object_if_there("extensions");
    }
    for (JsonReader& mesh : json.objects("meshes")) {
        GltfMeshOutline& to = outline.meshes.emplace_back(GltfMeshOutline{mesh.text_or("name", ""), {}});
        for (JsonReader& primitive : mesh.objects("primitives"))
            to.materials.push_back(json.index_if_there(primitive, "material", "materials"));
    }
    for (const char* names : {"extensionsUsed", "extensionsRequired"}) check_names(root, names);
    for (const char* array : {"buffers", "bufferViews", "images", "samplers", "textures"})
        for (JsonReader& object : json.objects(array)) {
            object.text_or("uri", "");
            for (const char* number : {"buffer", "bufferView", "byteLength", "byteOffset", "sampler", "source"})
                object.integer_or(number, 0, 0, std::int64_t{1} << 32);
        }
    return outline;
}

std::set<std::string> extensions_in(const nlohmann::ordered_json& value) {
    std::set<std::string> names;
    collect_extensions(value, names);
    return names;
}

std::vector<std::string> named_files(const nlohmann::ordered_json& gltf) {
    std::vector<std::string> files;
    for (const char* array : {"buffers", "images"})
        if (gltf.contains(array))
            for (const nlohmann::ordered_json& object : gltf[array])
                if (const std::string uri = object.value("uri", "data:"); !uri.starts_with("data:"))
                    files.push_back(uri);
    return files;
}

}  // namespace rowland::scene
