#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/renderer.h"
#include "engine/scene/animation.h"
#include "engine/scene/imported_scene.h"

namespace rowland::render {

struct SceneInstance {
    std::vector<ecs::Entity> nodes;   ///< one per node, in the import's order: Transform, Parent and NodeMetadata
    std::vector<ecs::Entity> drawn;   ///< one per instance of a primitive: MeshInstance and StandardMaterial
    std::vector<ecs::Entity> lights;  ///< one per light
    std::vector<ecs::Entity> probes;  ///< one per probe that was cooked: ProbeVolume
    std::vector<scene::Animation> animations;

    /// Sets the nodes' transforms to those of an animation at a time. World matrices follow with the next
    /// scene::update_world_matrices().
    void animate(ecs::World& world, std::size_t animation, float time_s) const;
};

/// Makes entities of a scene and puts its meshes and textures on the GPU. Primitives, lights and probes are children of
/// their nodes; skinned primitives have no parent. The renderer's material types attach their surfaces to materials
/// that have their extensions. `file` is for messages. Throws Error (input) if such an extension is wrong or its tables
/// are missing (the scene has not been cooked), or if two types claim one surface; the world is then as before.
SceneInstance instantiate(ecs::World& world, const scene::ImportedScene& scene, Renderer& renderer,
                          const std::string& file);

/// Removes all entities of an instance that are still alive.
void destroy(ecs::World& world, const SceneInstance& instance);

}  // namespace rowland::render
