#include "tests/unit/engine/scene/mesh_sanity.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace rowland::scene::test {

namespace {

// Unit vectors of three rounded floats are unit and perpendicular to a few 2^-24; ten times that is far below any
// defect.
constexpr float kRounding = 1e-6F;

testing::AssertionResult vertex_is_sane(const Mesh& mesh, std::size_t i) {
    const auto broken = [i](const char* what) { return testing::AssertionFailure() << "vertex " << i << ": " << what; };
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(mesh.positions[i][c])) return broken("position is not finite");
    for (int c = 0; c < 2; ++c)
        if (!std::isfinite(mesh.uvs[i][c])) return broken("uv is not finite");
    const glm::vec3 n = mesh.normals[i];
    const glm::vec3 t(mesh.tangents[i]);
    if (!(std::abs(glm::length(n) - 1.0F) <= kRounding)) return broken("normal is not unit");
    if (!(std::abs(glm::length(t) - 1.0F) <= kRounding)) return broken("tangent is not unit");
    if (!(std::abs(glm::dot(n, t)) <= kRounding)) return broken("tangent is not perpendicular to the normal");
    if (std::abs(mesh.tangents[i].w) != 1.0F) return broken("tangent's sign is not 1 or -1");
    return testing::AssertionSuccess();
}

}  // namespace

testing::AssertionResult is_sane(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    if (mesh.normals.size() != count || mesh.tangents.size() != count || mesh.uvs.size() != count)
        return testing::AssertionFailure() << "vertex arrays of different lengths";
    if (mesh.indices.size() % 3 != 0) return testing::AssertionFailure() << "no whole triangles";
    for (const std::uint32_t index : mesh.indices)
        if (index >= count) return testing::AssertionFailure() << "index " << index << " of " << count << " vertices";
    for (std::size_t i = 0; i < count; ++i)
        if (auto result = vertex_is_sane(mesh, i); !result) return result;
    return testing::AssertionSuccess();
}

testing::AssertionResult is_sane(const ImportedScene& scene) {
    for (const Mesh& mesh : scene.meshes)
        if (auto result = is_sane(mesh); !result) return result;
    for (const ImportedInstance& instance : scene.instances) {
        if (instance.mesh >= scene.meshes.size()) return testing::AssertionFailure() << "an instance without a mesh";
        if (instance.material && *instance.material >= scene.materials.size())
            return testing::AssertionFailure() << "an instance without its material";
    }
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
