#include "tests/unit/engine/scene/mesh_sanity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rowland::scene::test {

namespace {

// Unit vectors of three rounded floats are unit and perpendicular to a few 2^-24; ten times that is far below any
// defect.
constexpr float kRounding = 1e-6F;
// A tangent is kept if at least a thousandth of it lies in the surface; that part carries the normal's rounding, 2^-23,
// a thousandfold.
constexpr float kPerpendicular = 2e-4F;

testing::AssertionResult optional_attributes_are_sane(const Mesh& mesh, std::size_t i) {
    const auto broken = [i](const char* what) { return testing::AssertionFailure() << "vertex " << i << ": " << what; };
    if (!mesh.uvs1.empty() && !(std::isfinite(mesh.uvs1[i].x) && std::isfinite(mesh.uvs1[i].y)))
        return broken("second uv is not finite");
    for (int c = 0; c < 4; ++c) {
        if (!mesh.colours.empty() && !(std::isfinite(mesh.colours[i][c]) && mesh.colours[i][c] >= 0.0F))
            return broken("colour is negative or not finite");
        if (!mesh.weights.empty() && !(mesh.weights[i][c] >= 0.0F)) return broken("weight is negative or not a number");
    }
    if (!mesh.weights.empty()) {
        const glm::vec4 w = mesh.weights[i];
        if (!(std::abs(w.x + w.y + w.z + w.w - 1.0F) <= kRounding)) return broken("weights do not sum to 1");
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult vertex_is_sane(const Mesh& mesh, std::size_t i) {
    const auto broken = [i](const char* what) { return testing::AssertionFailure() << "vertex " << i << ": " << what; };
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(mesh.positions[i][c])) return broken("position is not finite");
    for (int c = 0; c < 2; ++c)
        if (!std::isfinite(mesh.uvs[i][c])) return broken("uv is not finite");
    if (auto result = optional_attributes_are_sane(mesh, i); !result) return result;
    const glm::vec3 n = mesh.normals[i];
    const glm::vec3 t(mesh.tangents[i]);
    if (!(std::abs(glm::length(n) - 1.0F) <= kRounding)) return broken("normal is not unit");
    if (!(std::abs(glm::length(t) - 1.0F) <= kRounding)) return broken("tangent is not unit");
    if (!(std::abs(glm::dot(n, t)) <= kPerpendicular)) return broken("tangent is not perpendicular to the normal");
    if (std::abs(mesh.tangents[i].w) != 1.0F) return broken("tangent's sign is not 1 or -1");
    return testing::AssertionSuccess();
}

}  // namespace

testing::AssertionResult is_sane(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    if (mesh.normals.size() != count || mesh.tangents.size() != count || mesh.uvs.size() != count)
        return testing::AssertionFailure() << "vertex arrays of different lengths";
    if (mesh.indices.size() % 3 != 0) return testing::AssertionFailure() << "no whole triangles";
    for (const std::size_t length : {mesh.uvs1.size(), mesh.colours.size(), mesh.joints.size(), mesh.weights.size()})
        if (length != 0 && length != count) return testing::AssertionFailure() << "vertex arrays of different lengths";
    if (mesh.joints.size() != mesh.weights.size()) return testing::AssertionFailure() << "joints without weights";
    for (const std::uint32_t index : mesh.indices)
        if (index >= count) return testing::AssertionFailure() << "index " << index << " of " << count << " vertices";
    for (std::size_t i = 0; i < count; ++i)
        if (auto result = vertex_is_sane(mesh, i); !result) return result;
    return testing::AssertionSuccess();
}

namespace {

testing::AssertionResult node_is_sane(const ImportedScene& scene, std::size_t i) {
    const ImportedNode& node = scene.nodes[i];
    if (node.parent && *node.parent >= i) return testing::AssertionFailure() << "node " << i << " before its parent";
    glm::mat4 expected = node.local.matrix();
    if (node.parent) expected = scene.nodes[*node.parent].world * expected;
    float largest = 1.0F;
    float error = 0.0F;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(node.world[column][row]))
                return testing::AssertionFailure() << "node " << i << " is not finite";
            largest = std::max(largest, std::abs(node.world[column][row]));
            error = std::max(error, std::abs(node.world[column][row] - expected[column][row]));
        }
    }
    const std::string shear = "holds shear";
    for (const std::string& warning : scene.warnings)
        if (warning.find(shear) != std::string::npos) return testing::AssertionSuccess();
    // Single precision with a few roundings in the matrices' product and decomposition.
    if (!(error <= 1e-5F * largest))
        return testing::AssertionFailure() << "node " << i << " is not where its parents put it, by " << error;
    return testing::AssertionSuccess();
}

testing::AssertionResult is_sane(const Animation& animation, std::size_t node_count) {
    for (const AnimationChannel& channel : animation.channels) {
        if (channel.node >= node_count) return testing::AssertionFailure() << "a channel without its node";
        if (channel.times_s.empty()) return testing::AssertionFailure() << "a channel without keys";
        if (!std::ranges::is_sorted(channel.times_s)) return testing::AssertionFailure() << "keys out of order";
        for (const float time : channel.times_s)
            for (int c = 0; c < 4; ++c)
                if (!std::isfinite(sample(channel, time)[c])) return testing::AssertionFailure() << "not finite";
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult pictures_are_sane(const ImportedScene& scene) {
    for (const auto& image : scene.images) {
        if (!image || image->width < 1 || image->height < 1 ||
            image->rgba.size() != 4 * static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height))
            return testing::AssertionFailure() << "an image of another size than it says";
    }
    for (const ImportedTexture& texture : scene.textures)
        if (texture.image >= scene.images.size()) return testing::AssertionFailure() << "a texture without its image";
    for (const MaterialDescription& material : scene.materials)
        for (const auto& use : {material.base_colour_texture, material.metallic_roughness_texture,
                                material.normal_texture, material.occlusion_texture, material.emissive_texture})
            if (use && (use->texture >= scene.textures.size() || use->uv_set < 0 || use->uv_set > 1))
                return testing::AssertionFailure() << "a material without its texture";
    return testing::AssertionSuccess();
}

testing::AssertionResult instance_is_sane(const ImportedScene& scene, const ImportedInstance& instance) {
    if (instance.mesh >= scene.meshes.size()) return testing::AssertionFailure() << "an instance without a mesh";
    if (instance.node >= scene.nodes.size()) return testing::AssertionFailure() << "an instance without a node";
    if (instance.material && *instance.material >= scene.materials.size())
        return testing::AssertionFailure() << "an instance without its material";
    if (!instance.skin) return testing::AssertionSuccess();
    if (*instance.skin >= scene.skins.size()) return testing::AssertionFailure() << "an instance without its skin";
    const ImportedSkin& skin = scene.skins[*instance.skin];
    for (const glm::u16vec4& joints : scene.meshes[instance.mesh].joints)
        for (int i = 0; i < 4; ++i)
            if (joints[i] >= skin.joints.size()) return testing::AssertionFailure() << "a vertex without its joint";
    return testing::AssertionSuccess();
}

}  // namespace

testing::AssertionResult is_sane(const ImportedScene& scene) {
    for (const Mesh& mesh : scene.meshes)
        if (auto result = is_sane(mesh); !result) return result;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (auto result = node_is_sane(scene, i); !result) return result;
    for (const ImportedSkin& skin : scene.skins) {
        if (skin.joints.size() != skin.inverse_bind.size())
            return testing::AssertionFailure() << "joints without their matrices";
        for (const std::size_t joint : skin.joints)
            if (joint >= scene.nodes.size()) return testing::AssertionFailure() << "a joint without its node";
    }
    for (const ImportedInstance& instance : scene.instances)
        if (auto result = instance_is_sane(scene, instance); !result) return result;
    for (const Animation& animation : scene.animations)
        if (auto result = is_sane(animation, scene.nodes.size()); !result) return result;
    for (const ImportedLight& light : scene.lights)
        if (light.node >= scene.nodes.size()) return testing::AssertionFailure() << "a light without its node";
    for (const ImportedCamera& camera : scene.cameras)
        if (camera.node >= scene.nodes.size()) return testing::AssertionFailure() << "a camera without its node";
    if (auto result = pictures_are_sane(scene); !result) return result;
    return is_sane(merge_instances(scene));
}

double signed_volume(const Mesh& mesh) {
    double volume = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
        const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return volume;
}

}  // namespace rowland::scene::test
