#include "tests/fuzz/sane_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/core/check.h"

namespace rowland::fuzz {

namespace {

template <typename Vector>
void require_values(const std::vector<Vector>& values, std::size_t count, bool may_be_absent) {
    if (!(may_be_absent && values.empty())) ROWLAND_CHECK_OP(values.size(), ==, count);
    for (const Vector& value : values)
        for (int i = 0; i < Vector::length(); ++i) ROWLAND_CHECK(std::isfinite(value[i]), "finite values");
}

void require_mesh(const scene::Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    for (const std::uint32_t index : mesh.indices) ROWLAND_CHECK_OP(index, <, vertices);
    ROWLAND_CHECK_OP(mesh.indices.size() % 3, ==, 0U);
    require_values(mesh.positions, vertices, false);
    require_values(mesh.normals, vertices, false);
    require_values(mesh.tangents, vertices, false);
    require_values(mesh.uvs, vertices, false);
    require_values(mesh.uvs1, vertices, true);
    require_values(mesh.colours, vertices, true);
    require_values(mesh.weights, vertices, true);
    ROWLAND_CHECK_OP(mesh.joints.size(), ==, mesh.weights.size());
}

void require_below(const std::optional<std::size_t>& reference, std::size_t count) {
    if (reference) ROWLAND_CHECK_OP(*reference, <, count);
}

void require_instance(const scene::ImportedScene& scene, const scene::ImportedInstance& instance) {
    require_below(instance.mesh, scene.meshes.size());
    require_below(instance.material, scene.materials.size());
    require_below(instance.node, scene.nodes.size());
    require_below(instance.skin, scene.skins.size());
    if (!instance.skin) return;
    const std::size_t joints = scene.skins[*instance.skin].joints.size();
    for (const glm::u16vec4& named : scene.meshes[instance.mesh].joints)
        for (int i = 0; i < 4; ++i) ROWLAND_CHECK_OP(named[i], <, joints);
}

void require_material(const scene::ImportedScene& scene, const scene::MaterialDescription& material) {
    for (const auto& use : {material.base_colour_texture, material.metallic_roughness_texture, material.normal_texture,
                            material.occlusion_texture, material.emissive_texture})
        if (use) require_below(use->texture, scene.textures.size());
}

void require_animation(const scene::ImportedScene& scene, const scene::Animation& animation) {
    for (const scene::AnimationChannel& channel : animation.channels) {
        require_below(channel.node, scene.nodes.size());
        ROWLAND_CHECK(!channel.times_s.empty(), "a channel has keys");
        ROWLAND_CHECK(std::is_sorted(channel.times_s.begin(), channel.times_s.end()), "times ascend");
        const std::size_t a_key = channel.interpolation == scene::Interpolation::CubicSpline ? 3 : 1;
        require_values(channel.values, a_key * channel.times_s.size(), false);
    }
}

}  // namespace

void require_sane(const scene::ImportedScene& scene) {
    for (const scene::Mesh& mesh : scene.meshes) require_mesh(mesh);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) require_below(scene.nodes[i].parent, i);
    for (const scene::ImportedInstance& instance : scene.instances) require_instance(scene, instance);
    for (const scene::MaterialDescription& material : scene.materials) require_material(scene, material);
    for (const scene::ImportedTexture& texture : scene.textures) require_below(texture.image, scene.images.size());
    for (const scene::ImportedSkin& skin : scene.skins) {
        ROWLAND_CHECK_OP(skin.inverse_bind.size(), ==, skin.joints.size());
        for (const std::size_t joint : skin.joints) require_below(joint, scene.nodes.size());
    }
    for (const scene::Animation& animation : scene.animations) require_animation(scene, animation);
    for (const scene::ImportedLight& light : scene.lights) require_below(light.node, scene.nodes.size());
    for (const scene::ImportedCamera& camera : scene.cameras) require_below(camera.node, scene.nodes.size());
}

}  // namespace rowland::fuzz
