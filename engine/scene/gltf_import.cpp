#include "engine/scene/gltf_import.h"

#include <fmt/format.h>

#include "engine/core/file.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_parse.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/memory_budget.h"
#include "engine/scene/node_tree.h"
#include "engine/scene/primitive.h"

namespace rowland::scene {

namespace {

/// A triangle primitive's place in the imported scene.
struct ImportedPrimitive {
    std::size_t mesh;
    std::optional<std::size_t> material;
};

/// Imports every triangle primitive; the result has, for each glTF mesh, its primitives.
std::vector<std::vector<ImportedPrimitive>> import_meshes(const GltfDocument& document, MemoryBudget& budget,
                                                          ImportedScene& scene) {
    std::vector<std::vector<ImportedPrimitive>> imported(document.meshes.size());
    for (std::size_t i = 0; i < document.meshes.size(); ++i) {
        const std::vector<GltfPrimitive>& primitives = document.meshes[i].primitives;
        for (std::size_t k = 0; k < primitives.size(); ++k) {
            if (!has_triangles(primitives[k])) {
                warn_once(scene.warnings, "points and lines are ignored");
                continue;
            }
            const std::string place = fmt::format("/meshes/{}/primitives/{}", i, k);
            imported[i].push_back({scene.meshes.size(), primitives[k].material});
            scene.meshes.push_back(import_primitive(document, primitives[k], place, budget, scene.warnings));
        }
    }
    return imported;
}

ImportedScene import_source(GltfSource source, std::span<const std::string> handled_extensions,
                            std::vector<std::filesystem::path>* read_files) {
    ImportedScene scene;
    check_gltf_json(source.json, source.file, handled_extensions, scene.warnings);
    MemoryBudget budget(source.file);
    GltfDocument document = parse_gltf(source.json, source.file);
    document.buffers = load_buffers(source, budget, read_files);
    check_ranges(document);

    const std::vector<PlacedNode> nodes = place_nodes(document);
    const auto imported = import_meshes(document, budget, scene);
    scene.materials = std::move(document.materials);
    for (const PlacedNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (!node.mesh) continue;
        const std::string& name = node.name.empty() ? document.meshes[*node.mesh].name : node.name;
        // Many nodes may share a mesh of many primitives.
        budget.spend(imported[*node.mesh].size(), sizeof(ImportedInstance) + name.size(),
                     fmt::format("/nodes/{}", placed.node));
        for (const ImportedPrimitive& primitive : imported[*node.mesh])
            scene.instances.push_back({name, glm::mat4(placed.world), primitive.mesh, primitive.material});
    }
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
