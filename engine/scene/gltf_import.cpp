#include "engine/scene/gltf_import.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_buffer.h"
#include "engine/scene/gltf_parse.h"
#include "engine/scene/gltf_parts.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/memory_budget.h"
#include "engine/scene/node_label.h"
#include "engine/scene/node_tree.h"
#include "engine/scene/primitive.h"

namespace rowland::scene {

namespace {

/// A triangle primitive in the imported scene.
struct ImportedPrimitive {
    std::size_t mesh;
    std::optional<std::size_t> material;
};

TangentSource tangent_source(const GltfPrimitive& primitive) {
    const auto has = [&](const char* attribute) {
        return primitive.attributes.contains(attribute) ||
               (primitive.draco && primitive.draco->attributes.contains(attribute));
    };
    if (has("TANGENT")) return TangentSource::File;
    return has("TEXCOORD_0") ? TangentSource::Uvs : TangentSource::Arbitrary;
}

/// Imports every triangle primitive; returns the primitives of each glTF mesh.
std::vector<std::vector<ImportedPrimitive>> import_meshes(const GltfDocument& document, MemoryBudget& budget,
                                                          ImportedScene& scene) {
    std::vector<std::vector<ImportedPrimitive>> imported(document.meshes.size());
    DracoProcess decoder;
    for (std::size_t i = 0; i < document.meshes.size(); ++i) {
        const std::vector<GltfPrimitive>& primitives = document.meshes[i].primitives;
        for (std::size_t k = 0; k < primitives.size(); ++k) {
            if (!has_triangles(primitives[k]) || !has_positions(primitives[k])) {
                warn_once(scene.warnings, has_positions(primitives[k]) ? "points and lines are ignored"
                                                                       : "primitives without POSITION are ignored");
                continue;
            }
            const std::string pointer = fmt::format("/meshes/{}/primitives/{}", i, k);
            imported[i].push_back({scene.meshes.size(), primitives[k].material});
            scene.primitives.push_back({i, k});
            scene.meshes.push_back(import_primitive(document, primitives[k], pointer, decoder, budget, scene.warnings));
            scene.tangents.push_back(tangent_source(primitives[k]));
        }
    }
    return imported;
}

/// Memory of a JSON value per character of its text, at most: a map node for {"a":0}.
constexpr std::size_t kJsonBytesPerCharacter = 20;

ImportedLight import_light(const GltfDocument& document, const GltfNode& node, std::size_t at) {
    ImportedLight light{at, document.lights[*node.light]};
    if (auto* distant = std::get_if<DirectionalLight>(&light.light))
        distant->casts_shadow = is_marked(node.extras, "casts_shadow");
    return light;
}

/// Adds the shown nodes, their lights and their cameras; returns the scene's index of each of the document's nodes.
std::vector<std::optional<std::size_t>> import_nodes(const GltfDocument& document,
                                                     const std::vector<PlacedNode>& placed, MemoryBudget& budget,
                                                     ImportedScene& scene) {
    std::vector<std::optional<std::size_t>> shown(document.nodes.size());
    for (const PlacedNode& at : placed) {
        const GltfNode& node = document.nodes[at.node];
        budget.spend(1, sizeof(ImportedNode) + node.name.size(), fmt::format("/nodes/{}", at.node));
        shown[at.node] = scene.nodes.size();
        budget.spend(node.extras_bytes, kJsonBytesPerCharacter, fmt::format("/nodes/{}/extras", at.node));
        if (node.light) scene.lights.push_back(import_light(document, node, scene.nodes.size()));
        if (node.camera && document.cameras[*node.camera]) {
            scene.cameras.push_back(*document.cameras[*node.camera]);
            scene.cameras.back().node = scene.nodes.size();
        }
        scene.nodes.push_back({node.name, at.parent, node.rest, glm::mat4(at.world), node.extras});
    }
    return shown;
}

/// Adds instances, and the skins that an instance uses.
class InstanceImport {
 public:
    InstanceImport(const GltfDocument& document, std::span<const std::optional<std::size_t>> shown,
                   MemoryBudget& budget, ImportedScene& scene)
        : document_(document), shown_(shown), budget_(budget), scene_(scene), skins_(document.skins.size()) {
        for (const Mesh& mesh : scene.meshes) joint_counts_.push_back(joint_count(mesh));
    }

    void add(std::size_t node_index, const std::vector<ImportedPrimitive>& primitives) {
        const GltfNode& node = document_.nodes[node_index];
        const std::string pointer = fmt::format("/nodes/{}", node_index);
        const std::string& name = node.name.empty() ? document_.meshes[*node.mesh].name : node.name;
        // Many nodes may use one mesh of many primitives.
        budget_.spend(primitives.size(), sizeof(ImportedInstance) + name.size(), pointer);
        const std::size_t at = *shown_[node_index];
        for (const ImportedPrimitive& primitive : primitives) {
            ImportedInstance instance{name,        scene_.nodes[at].world, primitive.mesh, primitive.material, at,
                                      std::nullopt};
            if (node.skin) instance.skin = skin_of(*node.skin, primitive.mesh, pointer);
            scene_.instances.push_back(std::move(instance));
        }
    }

 private:
    /// One more than the largest joint a vertex names; 0: not skinned.
    static std::size_t joint_count(const Mesh& mesh) {
        std::size_t count = 0;
        for (const glm::u16vec4& joints : mesh.joints)
            for (int i = 0; i < 4; ++i) count = std::max(count, std::size_t{joints[i]} + 1);
        return count;
    }

    std::optional<std::size_t> skin_of(std::size_t skin, std::size_t mesh, const std::string& pointer) {
        if (joint_counts_[mesh] == 0) {
            warn_once(scene_.warnings, "a skin of a mesh whose vertices have no joints is ignored");
            return std::nullopt;
        }
        if (joint_counts_[mesh] > document_.skins[skin].joints.size())
            refuse_input(document_.file, pointer, fmt::format("a vertex with joint {}", joint_counts_[mesh] - 1),
                         fmt::format("below the skin's {} joints", document_.skins[skin].joints.size()));
        if (!skins_[skin]) {
            skins_[skin] = scene_.skins.size();
            scene_.skins.push_back(import_skin(document_, skin, shown_, budget_));
        }
        return skins_[skin];
    }

    const GltfDocument& document_;
    std::span<const std::optional<std::size_t>> shown_;
    MemoryBudget& budget_;
    ImportedScene& scene_;
    std::vector<std::optional<std::size_t>> skins_;  ///< the scene's index of each of the document's
    std::vector<std::size_t> joint_counts_;          ///< of each imported mesh
};

ImportedScene import_source(const GltfSource& source, std::span<const std::string> handled_extensions,
                            std::vector<std::filesystem::path>* read_files) {
    ImportedScene scene;
    const GltfJson json{source.json, source.file, scene.warnings};
    MemoryBudget budget(source.file);
    GltfDocument document = parse_gltf(json, handled_extensions);
    document.buffers = load_buffers(source, document, budget, read_files);
    check_ranges(document);

    const std::vector<PlacedNode> placed = placed_nodes(document);
    const auto shown = import_nodes(document, placed, budget, scene);
    const auto imported = import_meshes(document, budget, scene);
    InstanceImport instances(document, shown, budget, scene);
    for (const PlacedNode& at : placed)
        if (const auto mesh = document.nodes[at.node].mesh) instances.add(at.node, imported[*mesh]);
    scene.animations = import_animations(json, document, shown, budget);
    import_images(source, document, budget, read_files, scene);
    scene.materials = std::move(document.materials);
    return scene;
}

}  // namespace

ImportedScene load_gltf(const std::filesystem::path& path, std::span<const std::string> handled_extensions,
                        std::vector<std::filesystem::path>* read_files) {
    if (read_files) read_files->push_back(path);
    std::vector<std::byte> bytes = read_file(path, MemoryBudget::kDefaultLimit);
    return import_source(split_gltf(std::move(bytes), path.string(), path.parent_path()), handled_extensions,
                         read_files);
}

ImportedScene load_glb(std::span<const std::byte> bytes, const std::string& file,
                       std::span<const std::string> handled_extensions) {
    return import_source(split_gltf({bytes.begin(), bytes.end()}, file, std::nullopt), handled_extensions, nullptr);
}

}  // namespace rowland::scene
