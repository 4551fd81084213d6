#include "engine/scene/gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/scene/gltf_document.h"
#include "engine/scene/gltf_index.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

namespace {

// Quantised attributes are ordinary accessors to us, so that extension needs nothing more.
constexpr std::array<std::string_view, 6> kSupportedExtensions = {
    kDracoExtension,       "KHR_lights_punctual",   "KHR_materials_emissive_strength",
    "KHR_materials_unlit", "KHR_mesh_quantization", "KHR_texture_transform"};
constexpr std::int64_t kMaximumBytes = MemoryBudget::kDefaultLimit;
constexpr std::int64_t kMaximumCount = std::numeric_limits<std::int32_t>::max();

/// The checks, each for one kind of object of the file.
class Checker {
 public:
    Checker(const nlohmann::json& json, const std::string& file, std::span<const std::string> handled,
            std::vector<std::string>& warnings)
        : json_(json), root_(json, file), handled_(handled), warnings_(warnings) {}

    void run() {
        check_asset();
        check_extensions();
        for_each("buffers", &Checker::check_buffer);
        for_each("bufferViews", &Checker::check_view);
        for_each("accessors", &Checker::check_accessor);
        for_each("meshes", &Checker::check_mesh);
        for_each("nodes", &Checker::check_node);
        for_each("scenes", &Checker::check_scene);
        if (root_.has("scene")) check_index(root_, "scene", "scenes");
    }

 private:
    bool supports(const std::string& extension) const {
        return std::find(kSupportedExtensions.begin(), kSupportedExtensions.end(), extension) !=
                   kSupportedExtensions.end() ||
               std::find(handled_.begin(), handled_.end(), extension) != handled_.end();
    }

    void for_each(const std::string& array, void (Checker::*check)(JsonReader&)) {
        if (!root_.has(array)) return;
        for (JsonReader& element : root_.objects(array)) (this->*check)(element);
    }

    void check_index(JsonReader& reader, const std::string& key, const std::string& array) const {
        index_into(json_, reader, key, array);
    }
    void check_index_if_there(JsonReader& reader, const std::string& key, const std::string& array) const {
        index_if_there(json_, reader, key, array);
    }

    void check_asset() {
        JsonReader asset = root_.object("asset");
        const std::string version = asset.text("version");
        if (!version.starts_with("2."))
            asset.fail("version", fmt::format("\"{:.20}\"", version), "glTF version 2", "export the file as glTF 2.0");
    }

    void check_extensions() {
        for (const std::string& name : names("extensionsRequired"))
            if (!supports(name))
                root_.fail("extensionsRequired", fmt::format("\"{:.80}\"", name),
                           fmt::format("no required extension but {}", fmt::join(kSupportedExtensions, ", ")),
                           "export the file without it");
        for (const std::string& name : names("extensionsUsed"))
            if (!supports(name)) warn_once(warnings_, fmt::format("the extension {:.80} is ignored", name));
    }
    std::vector<std::string> names(const std::string& key) {
        std::vector<std::string> result;
        if (!root_.has(key)) return result;
        const nlohmann::json& values = root_.raw(key);
        if (!values.is_array()) root_.fail(key, values.type_name(), "an array of names");
        for (const nlohmann::json& value : values) {
            if (!value.is_string()) root_.fail(key, value.type_name(), "a name");
            result.push_back(value.get<std::string>());
        }
        return result;
    }

    void check_buffer(JsonReader& buffer) {
        buffer.integer("byteLength", 1, kMaximumBytes);
        text_if_there(buffer, "uri");
    }

    void check_view(JsonReader& view) {
        check_index(view, "buffer", "buffers");
        view.integer("byteLength", 0, kMaximumBytes);
        view.integer_or("byteOffset", 0, 0, kMaximumBytes);
        const std::int64_t stride = view.integer_or("byteStride", 4, 4, 252);
        if (stride % 4 != 0) view.fail("byteStride", fmt::format("{}", stride), "a multiple of 4");
    }

    static void check_component_type(JsonReader& reader) {
        const std::int64_t type = reader.integer("componentType", 5120, 5126);
        if (type == 5124) reader.fail("componentType", "5124", "one of 5120, 5121, 5122, 5123, 5125, 5126");
    }

    void check_accessor(JsonReader& accessor) {
        check_index_if_there(accessor, "bufferView", "bufferViews");
        accessor.integer_or("byteOffset", 0, 0, kMaximumBytes);
        accessor.integer("count", 1, kMaximumCount);
        check_component_type(accessor);
        accessor.choice("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
        accessor.boolean_or("normalized", false);
        if (!accessor.has("sparse")) return;
        JsonReader sparse = accessor.object("sparse");
        sparse.integer("count", 1, kMaximumCount);
        JsonReader indices = sparse.object("indices");
        check_index(indices, "bufferView", "bufferViews");
        indices.integer_or("byteOffset", 0, 0, kMaximumBytes);
        const std::int64_t type = indices.integer("componentType", 5121, 5125);
        if (type % 2 == 0) indices.fail("componentType", fmt::format("{}", type), "one of 5121, 5123, 5125");
        JsonReader values = sparse.object("values");
        check_index(values, "bufferView", "bufferViews");
        values.integer_or("byteOffset", 0, 0, kMaximumBytes);
    }

    void check_mesh(JsonReader& mesh) {
        text_if_there(mesh, "name");
        for (JsonReader& primitive : mesh.objects("primitives")) check_primitive(primitive);
    }

    void check_primitive(JsonReader& primitive) {
        primitive.integer_or("mode", 4, 0, 6);
        check_index_if_there(primitive, "indices", "accessors");
        check_index_if_there(primitive, "material", "materials");
        if (primitive.has("targets")) warn_once(warnings_, "morph targets are ignored");
        JsonReader attributes = primitive.object("attributes");
        for (const auto& [name, ignored] : primitive.raw("attributes").items())
            check_index(attributes, name, "accessors");
        if (!primitive.has("extensions")) return;
        JsonReader extensions = primitive.object("extensions");
        if (extensions.has(kDracoExtension)) check_draco(extensions.object(kDracoExtension));
    }

    void check_draco(JsonReader draco) {
        check_index(draco, "bufferView", "bufferViews");
        JsonReader ids = draco.object("attributes");
        for (const auto& [name, ignored] : draco.raw("attributes").items()) ids.integer(name, 0, kMaximumCount);
    }

    void check_node(JsonReader& node) {
        text_if_there(node, "name");
        check_index_if_there(node, "mesh", "meshes");
        check_index_if_there(node, "skin", "skins");
        indices_if_there(json_, node, "children", "nodes");
        if (node.has("matrix")) node.numbers("matrix", 16, kFiniteFloat);
        if (node.has("translation")) node.numbers("translation", 3, kFiniteFloat);
        if (node.has("rotation")) node.numbers("rotation", 4, {.minimum = -1.001, .maximum = 1.001});
        if (node.has("scale")) node.numbers("scale", 3, kFiniteFloat);
    }

    void check_scene(JsonReader& scene) {
        text_if_there(scene, "name");
        indices_if_there(json_, scene, "nodes", "nodes");
    }

    const nlohmann::json& json_;
    JsonReader root_;
    std::span<const std::string> handled_;
    std::vector<std::string>& warnings_;
};

}  // namespace

void warn_once(std::vector<std::string>& warnings, std::string text) {
    if (std::find(warnings.begin(), warnings.end(), text) == warnings.end()) warnings.push_back(std::move(text));
}

void check_gltf_json(const nlohmann::json& json, const std::string& file,
                     std::span<const std::string> handled_extensions, std::vector<std::string>& warnings) {
    Checker(json, file, handled_extensions, warnings).run();
}

}  // namespace rowland::scene
