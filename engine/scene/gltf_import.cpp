#include "engine/scene/gltf_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

/// A triangle primitive in the imported scene.
struct TrianglePrimitive {
    std::size_t mesh;
    std::optional<std::size_t> material;
};

TangentSource tangent_source(const gltf::Primitive& primitive) {
    if (has_attribute(primitive, "TANGENT")) return TangentSource::File;
    return has_attribute(primitive, "TEXCOORD_0") ? TangentSource::Uvs : TangentSource::Arbitrary;
}

/// Imports every triangle primitive; returns the primitives of each glTF mesh.
std::vector<std::vector<TrianglePrimitive>> import_meshes(const GltfDocument& document, MemoryBudget& budget,
                                                          ImportedScene& scene) {
    const std::vector<gltf::Mesh>& meshes = document.model.meshes;
    std::vector<std::vector<TrianglePrimitive>> imported(meshes.size());
    DracoProcess decoder;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        for (std::size_t k = 0; k < meshes[i].primitives.size(); ++k) {
            const gltf::Primitive& primitive = meshes[i].primitives[k];
            if (document.json.at("meshes").at(i).at("primitives").at(k).contains("targets"))
                warn_once(scene.warnings, "morph targets are ignored");
            const bool has_positions = has_attribute(primitive, "POSITION");
            if (primitive.mode < TINYGLTF_MODE_TRIANGLES || !has_positions) {
                warn_once(scene.warnings,
                          has_positions ? "points and lines are ignored" : "primitives without POSITION are ignored");
                continue;
            }
            std::optional<std::size_t> material;
            int normal_map_uvs = 0;
            if (primitive.material >= 0) {
                material = static_cast<std::size_t>(primitive.material);
                if (const auto& normal = scene.materials[*material].normal_texture) normal_map_uvs = normal->uv_set;
            }
            imported[i].push_back({scene.meshes.size(), material});
            scene.primitives.push_back({i, k});
            scene.meshes.push_back(import_primitive(document, primitive, normal_map_uvs,
                                                    fmt::format("/meshes/{}/primitives/{}", i, k), decoder, budget,
                                                    scene.warnings));
            scene.tangents.push_back(tangent_source(primitive));
        }
    return imported;
}

/// One more than the largest joint a vertex names; 0: not skinned.
std::size_t joint_count(const Mesh& mesh) {
    std::size_t count = 0;
    for (const glm::u16vec4& joints : mesh.joints)
        for (int i = 0; i < 4; ++i) count = std::max(count, std::size_t{joints[i]} + 1);
    return count;
}

/// Adds instances, and the skins that an instance uses.
class InstanceImport {
 public:
    InstanceImport(const GltfDocument& document, const ShownNodes& shown, MemoryBudget& budget, ImportedScene& scene)
        : document_(document), shown_(shown), budget_(budget), scene_(scene), skins_(document.model.skins.size()) {
        for (const Mesh& mesh : scene.meshes) joint_counts_.push_back(joint_count(mesh));
    }

    void add(std::size_t node_index, const std::vector<std::vector<TrianglePrimitive>>& meshes) {
        const gltf::Node& node = document_.model.nodes[node_index];
        if (node.mesh < 0) return;
        const auto mesh = static_cast<std::size_t>(node.mesh);
        const std::string pointer = fmt::format("/nodes/{}", node_index);
        const std::string& name = node.name.empty() ? document_.model.meshes[mesh].name : node.name;
        // Many nodes may use one mesh of many primitives.
        budget_.spend(meshes[mesh].size(), sizeof(ImportedInstance) + name.size(), pointer);
        const std::size_t at = *shown_[node_index];
        for (const TrianglePrimitive& primitive : meshes[mesh]) {
            ImportedInstance instance{name,        scene_.nodes[at].world, primitive.mesh, primitive.material, at,
                                      std::nullopt};
            if (node.skin >= 0) instance.skin = skin_of(static_cast<std::size_t>(node.skin), primitive.mesh, pointer);
            scene_.instances.push_back(std::move(instance));
        }
    }

 private:
    std::optional<std::size_t> skin_of(std::size_t skin, std::size_t mesh, const std::string& pointer) {
        if (joint_counts_[mesh] == 0) {
            warn_once(scene_.warnings, "a skin of a mesh whose vertices have no joints is ignored");
            return std::nullopt;
        }
        const std::size_t count = document_.model.skins[skin].joints.size();
        if (joint_counts_[mesh] > count)
            refuse_input(document_.file, pointer, fmt::format("a vertex with joint {}", joint_counts_[mesh] - 1),
                         fmt::format("below the skin's {} joints", count));
        if (!skins_[skin]) {
            skins_[skin] = scene_.skins.size();
            scene_.skins.push_back(import_skin(document_, skin, shown_, budget_));
        }
        return skins_[skin];
    }

    const GltfDocument& document_;
    const ShownNodes& shown_;
    MemoryBudget& budget_;
    ImportedScene& scene_;
    std::vector<std::optional<std::size_t>> skins_;  ///< the scene's index of each of the document's
    std::vector<std::size_t> joint_counts_;          ///< of each imported mesh
};

}  // namespace

ImportedScene import_gltf(const GltfSource& source, std::span<const std::string> handled_extensions,
                          std::vector<std::filesystem::path>* read_files) {
    ImportedScene scene;
    MemoryBudget budget(source.file);
    const GltfDocument document = parse_gltf(source, handled_extensions, budget, read_files, scene.warnings);
    scene.materials = import_materials(document, scene.warnings);
    const ShownNodes shown = import_nodes(document, budget, scene);
    const auto meshes = import_meshes(document, budget, scene);
    InstanceImport instances(document, shown, budget, scene);
    std::vector<std::size_t> document_nodes(scene.nodes.size());
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (shown[i]) document_nodes[*shown[i]] = i;
    for (const std::size_t node : document_nodes) instances.add(node, meshes);
    scene.animations = import_animations(document, shown, budget);
    import_images(source, document, budget, read_files, scene);
    return scene;
}

ImportedScene load_gltf(const std::filesystem::path& path, std::span<const std::string> handled_extensions,
                        std::vector<std::filesystem::path>* read_files) {
    if (read_files) read_files->push_back(path);
    std::vector<std::byte> bytes = read_file(path, MemoryBudget::scene_limit(), MemoryBudget::kRemedy);
    return import_gltf(split_gltf(std::move(bytes), path.string(), path.parent_path()), handled_extensions, read_files);
}

ImportedScene load_glb(std::span<const std::byte> bytes, const std::string& file,
                       std::span<const std::string> handled_extensions) {
    return import_gltf(split_gltf({bytes.begin(), bytes.end()}, file, std::nullopt), handled_extensions, nullptr);
}

void require_texture(const ImportedScene& scene, std::size_t index, const std::string& file,
                     const std::string& pointer) {
    if (index >= scene.textures.size())
        refuse_input(file, pointer + "/index", fmt::format("{}", index),
                     fmt::format("one of the file's {} textures, counted from 0", scene.textures.size()));
}

}  // namespace rowland::scene
