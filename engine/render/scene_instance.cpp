#include "engine/render/scene_instance.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "engine/core/check.h"
#include "engine/core/log.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/probe_volumes.h"
#include "engine/render/reflections.h"
#include "engine/render/surface_textures.h"
#include "engine/scene/animation.h"
#include "engine/scene/transform.h"

namespace rowland::render {

namespace {

/// Makes one scene's entities. Instances share meshes and textures.
class Builder {
 public:
    Builder(ecs::World& world, const scene::ImportedScene& scene, Renderer& renderer, const std::string& file,
            SceneInstance& instance)
        : world_(world),
          scene_(scene),
          renderer_(renderer),
          file_(file),
          instance_(instance),
          textures_(scene),
          meshes_(scene.meshes.size()) {}

    void add_nodes() {
        for (const scene::ImportedNode& node : scene_.nodes) {
            const ecs::Entity entity = world_.create();
            instance_.nodes.push_back(entity);
            world_.add(entity, scene::Transform(node.local));
            world_.add(entity, scene::NodeMetadata{node.name, node.extras});
            if (!node.parent) continue;
            ROWLAND_CHECK_OP(*node.parent, <, instance_.nodes.size() - 1);
            world_.add(entity, scene::Parent{instance_.nodes[*node.parent]});
        }
    }

    void add_drawn(const scene::ImportedInstance& imported) {
        const ecs::Entity entity = imported.skin ? world_.create() : child_of(imported.node);
        instance_.drawn.push_back(entity);
        if (imported.skin) {
            world_.add(entity, scene::Transform{});
            world_.add(entity, skin(scene_.skins.at(*imported.skin)));
        }
        world_.add(entity, MeshInstance(mesh(imported.mesh)));
        const scene::MaterialDescription* material =
            imported.material ? &scene_.materials.at(*imported.material) : nullptr;
        world_.add(entity, make_material(material, textures_));
        if (scene::is_marked(scene_.nodes.at(imported.node).extras, "reflected_top"))
            world_.add(entity, top_of(scene_.meshes[imported.mesh]));
        if (const auto group = reflecting_node(imported.node))
            world_.add(entity, ReflectsObjects{instance_.nodes[*group]});
        if (material != nullptr) attach_extensions(entity, *material, *imported.material);
    }

    void add_light(const scene::ImportedLight& light) {
        const ecs::Entity entity = child_of(light.node);
        instance_.lights.push_back(entity);
        std::visit([&](const auto& component) { world_.add(entity, std::decay_t<decltype(component)>(component)); },
                   light.light);
    }

    /// Leaves out a probe whose file was missing when the scene was cooked.
    void add_probe(const scene::ImportedProbe& imported) {
        if (!imported.cooked) return;
        auto& probe = probes_[imported.cooked.get()];
        if (!probe)
            probe = std::make_shared<const lighting::LightProbe>(
                lighting::deserialise(*imported.cooked, file_ + ": " + imported.file.string()));
        const ecs::Entity entity = child_of(imported.node);
        instance_.probes.push_back(entity);
        world_.add(entity, ProbeVolume{.probe = probe, .half = 0.5F * imported.size_m, .fade_m = imported.fade_m});
    }

 private:
    /// The nearest node, from this one upward, that is marked `reflects_objects`.
    std::optional<std::size_t> reflecting_node(std::optional<std::size_t> node) const {
        while (node && !scene::is_marked(scene_.nodes.at(*node).extras, "reflects_objects"))
            node = scene_.nodes[*node].parent;
        return node;
    }

    ecs::Entity child_of(std::size_t node) {
        const ecs::Entity entity = world_.create();
        world_.add(entity, scene::Transform{});
        world_.add(entity, scene::Parent{instance_.nodes.at(node)});
        return entity;
    }

    const MeshInstance& mesh(std::size_t index) {
        MeshInstance& made = meshes_.at(index);
        if (!made.mesh) made = make_mesh_instance(scene_.meshes[index]);
        return made;
    }

    scene::Skin skin(const scene::ImportedSkin& imported) const {
        scene::Skin result{.joints = {}, .inverse_bind = imported.inverse_bind};
        for (const std::size_t joint : imported.joints) result.joints.push_back(instance_.nodes.at(joint));
        return result;
    }

    void attach_extensions(ecs::Entity entity, const scene::MaterialDescription& material, std::size_t index) {
        const std::string pointer = fmt::format("/materials/{}/extensions", index);
        for (const auto& [name, object] : material.extensions)
            for (const auto& type : renderer_.material_types())
                if (type->gltf_extension() == name)
                    type->attach(world_, entity, {object, material, file_, fmt::format("{}/{}", pointer, name)},
                                 textures_);
        warn_unaccompanied_extensions(material, pointer);
        owner_of(world_, entity, renderer_.material_types(), file_, pointer);
    }

    /// Warns, once per extension, of extensions that are read only beside their type's gltf_extension().
    void warn_unaccompanied_extensions(const scene::MaterialDescription& material, const std::string& pointer) {
        for (const auto& type : renderer_.material_types()) {
            if (material.extensions.contains(type->gltf_extension())) continue;
            for (const std::string& name : type->gltf_extensions_beside())
                if (material.extensions.contains(name) && warned_extensions_.insert(name).second)
                    log_warning("{}: {}/{} is ignored without {}", file_, pointer, name, type->gltf_extension());
        }
    }

    ecs::World& world_;
    const scene::ImportedScene& scene_;
    Renderer& renderer_;
    const std::string& file_;
    SceneInstance& instance_;
    SurfaceTextures textures_;
    std::vector<MeshInstance> meshes_;  ///< by index; made when first used
    std::set<std::string> warned_extensions_;
    std::map<const std::vector<std::byte>*, std::shared_ptr<const lighting::LightProbe>> probes_;  ///< by payload
};

}  // namespace

void SceneInstance::animate(ecs::World& world, std::size_t animation, float time_s) const {
    ROWLAND_CHECK_OP(animation, <, animations.size());
    std::vector<scene::Transform> pose(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) pose[i] = world.get<scene::Transform>(nodes[i]);
    scene::pose(animations[animation], time_s, pose);
    for (std::size_t i = 0; i < nodes.size(); ++i) world.get<scene::Transform>(nodes[i]) = pose[i];
}

SceneInstance instantiate(ecs::World& world, const scene::ImportedScene& scene, Renderer& renderer,
                          const std::string& file) {
    SceneInstance instance;
    instance.animations = scene.animations;
    try {
        Builder builder(world, scene, renderer, file, instance);
        builder.add_nodes();
        for (const scene::ImportedInstance& imported : scene.instances) builder.add_drawn(imported);
        for (const scene::ImportedLight& light : scene.lights) builder.add_light(light);
        for (const scene::ImportedProbe& probe : scene.probes) builder.add_probe(probe);
    } catch (...) {
        destroy(world, instance);
        throw;
    }
    return instance;
}

void destroy(ecs::World& world, const SceneInstance& instance) {
    for (const std::vector<ecs::Entity>* entities :
         {&instance.drawn, &instance.lights, &instance.probes, &instance.nodes})
        for (const ecs::Entity entity : *entities)
            if (world.alive(entity)) world.destroy(entity);
}

}  // namespace rowland::render
