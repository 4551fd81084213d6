#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/scene/animation.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/mesh.h"

namespace rowland::scene {

namespace {

template <typename Value>
void append(const std::vector<Value>& values, std::vector<Value>& all) {
    all.insert(all.end(), values.begin(), values.end());
}

void append(const Mesh& mesh, const glm::mat4& transform, const std::string& name, Mesh& merged) {
    const auto first = static_cast<std::uint32_t>(merged.positions.size());
    append(mesh.positions, merged.positions);
    append(mesh.normals, merged.normals);
    append(mesh.tangents, merged.tangents);
    append(mesh.uvs, merged.uvs);
    for (std::size_t i = first; i < merged.positions.size(); ++i) {
        transform_vertex(merged, i, transform);
        const glm::vec3& position = merged.positions[i];
        if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
            refuse_input("", fmt::format("instance \"{:.60}\"", name),
                         "a vertex that its transform moves beyond the range of floats", "finite positions");
    }
    const glm::dmat3 linear{glm::dmat4(transform)};
    const bool mirrored = glm::dot(glm::cross(linear[0], linear[1]), linear[2]) < 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        merged.indices.insert(merged.indices.end(),
                              {first + mesh.indices[i], first + mesh.indices[i + (mirrored ? 2 : 1)],
                               first + mesh.indices[i + (mirrored ? 1 : 2)]});
}

/// The joint matrices of a skin at rest.
std::vector<glm::mat4> rest_joints(const ImportedScene& scene, const ImportedSkin& skin) {
    std::vector<glm::mat4> joints;
    joints.reserve(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        joints.push_back(scene.nodes.at(skin.joints[i]).world * skin.inverse_bind.at(i));
    return joints;
}

}  // namespace

void pose_skins_at_rest(ImportedScene& scene) {
    for (ImportedInstance& instance : scene.instances) {
        if (!instance.skin) continue;
        scene.meshes.push_back(
            posed(scene.meshes.at(instance.mesh), rest_joints(scene, scene.skins.at(*instance.skin))));
        Mesh& mesh = scene.meshes.back();
        mesh.joints.clear();
        mesh.weights.clear();
        scene.tangents.push_back(scene.tangents.at(instance.mesh));
        scene.primitives.push_back(scene.primitives.at(instance.mesh));
        scene.nodes.push_back(
            {.name = instance.name, .parent = {}, .local = {}, .world = glm::mat4(1.0F), .extras = {}});
        instance.mesh = scene.meshes.size() - 1;
        instance.node = scene.nodes.size() - 1;
        instance.transform = glm::mat4(1.0F);
        instance.skin.reset();
    }
    scene.skins.clear();
}

Mesh merge_instances(const ImportedScene& scene) {
    MemoryBudget budget("");
    std::size_t vertex_count = 0;
    std::size_t index_count = 0;
    for (const ImportedInstance& instance : scene.instances) {
        ROWLAND_CHECK_OP(instance.mesh, <, scene.meshes.size());
        const Mesh& mesh = scene.meshes[instance.mesh];
        const std::string pointer = fmt::format("instance \"{:.60}\"", instance.name);
        budget.spend(mesh.positions.size(), 2 * sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(glm::vec2), pointer);
        budget.spend(mesh.indices.size(), sizeof(std::uint32_t), pointer);
        vertex_count += mesh.positions.size();
        index_count += mesh.indices.size();
    }
    Mesh merged;
    merged.positions.reserve(vertex_count);
    merged.normals.reserve(vertex_count);
    merged.tangents.reserve(vertex_count);
    merged.uvs.reserve(vertex_count);
    merged.indices.reserve(index_count);
    std::vector<std::vector<glm::mat4>> joints;
    joints.reserve(scene.skins.size());
    for (const ImportedSkin& skin : scene.skins) joints.push_back(rest_joints(scene, skin));
    for (const ImportedInstance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (instance.skin)
            append(posed(mesh, joints.at(*instance.skin)), glm::mat4(1.0F), instance.name, merged);
        else
            append(mesh, instance.transform, instance.name, merged);
    }
    return merged;
}

}  // namespace rowland::scene
