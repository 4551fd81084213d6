#include "engine/scene/primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "engine/scene/draco_decode.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/primitive_attribute.h"
#include "engine/scene/tangents.h"

namespace rowland::scene {

namespace {

void read_vertices(const PrimitiveImport& import, Mesh& mesh) {
    mesh.positions = read_attribute<glm::vec3>(import, "POSITION");
    mesh.normals = read_attribute<glm::vec3>(import, "NORMAL");
    mesh.tangents = read_attribute<glm::vec4>(import, "TANGENT");
    mesh.uvs = read_attribute<glm::vec2>(import, "TEXCOORD_0");
    mesh.uvs1 = read_attribute<glm::vec2>(import, "TEXCOORD_1");
    mesh.colours = read_colours(import);
    Skinning skinning = read_skinning(import);
    mesh.joints = std::move(skinning.joints);
    mesh.weights = std::move(skinning.weights);
    for (const auto& [count, name] : {std::pair(mesh.normals.size(), "NORMAL"),
                                      {mesh.tangents.size(), "TANGENT"},
                                      {mesh.uvs.size(), "TEXCOORD_0"},
                                      {mesh.uvs1.size(), "TEXCOORD_1"},
                                      {mesh.colours.size(), "COLOR_0"},
                                      {mesh.joints.size(), "JOINTS_0"}})
        if (count != 0 && count != mesh.positions.size())
            import.fail(fmt::format("{} values of {}", count, name),
                        fmt::format("as many as POSITION, {}", mesh.positions.size()));
    for (const glm::vec3& position : mesh.positions)
        if (!is_finite(position)) import.fail("a position that is infinite or not a number", "finite positions");
}

/// The primitive's vertex indices as they stand, each checked.
std::vector<std::uint32_t> read_corners(const PrimitiveImport& import, std::size_t vertex_count) {
    std::vector<std::uint32_t> corners;
    if (import.draco) {
        corners = import.draco->indices();
    } else if (import.primitive.indices) {
        corners = read_indices(import.document, *import.primitive.indices, import.budget);
    } else {
        import.budget.spend(vertex_count, sizeof(std::uint32_t), import.pointer);
        corners.resize(vertex_count);
        std::iota(corners.begin(), corners.end(), 0U);
    }
    const auto beyond =
        std::find_if(corners.begin(), corners.end(), [&](std::uint32_t corner) { return corner >= vertex_count; });
    if (beyond != corners.end())
        import.fail(fmt::format("vertex index {}", *beyond), fmt::format("below the {} vertices", vertex_count));
    return corners;
}

/// Strips and fans become lists with the same winding (glTF 2.0, 3.7.2.1).
std::vector<std::uint32_t> triangle_list(const PrimitiveImport& import, PrimitiveMode mode,
                                         std::vector<std::uint32_t> corners) {
    if (mode == PrimitiveMode::Triangles) {
        if (corners.size() % 3 != 0) import.fail(fmt::format("{} triangle corners", corners.size()), "a multiple of 3");
        return corners;
    }
    if (corners.size() < 3) import.fail(fmt::format("{} corners", corners.size()), "at least 3");
    import.budget.spend(corners.size() - 2, 3 * sizeof(std::uint32_t), import.pointer);
    std::vector<std::uint32_t> list;
    list.reserve((corners.size() - 2) * 3);
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool odd = i % 2 == 1;
        if (mode == PrimitiveMode::TriangleFan)
            list.insert(list.end(), {corners[i + 1], corners[i + 2], corners[0]});
        else
            list.insert(list.end(), {corners[i], corners[i + (odd ? 2 : 1)], corners[i + (odd ? 1 : 2)]});
    }
    return list;
}

void finish_uvs(const PrimitiveImport& import, Mesh& mesh) {
    if (mesh.uvs.empty()) mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0F));
    for (std::vector<glm::vec2>* set : {&mesh.uvs, &mesh.uvs1}) {
        for (glm::vec2& uv : *set) {
            if (is_finite(uv)) continue;
            uv = glm::vec2(0.0F);
            import.warn("texture coordinates that are not numbers were set to 0");
        }
    }
}

void finish_normals(const PrimitiveImport& import, Mesh& mesh) {
    std::vector<glm::vec3> given = std::move(mesh.normals);
    const auto usable = [](const glm::vec3& n) { return is_finite(n) && glm::dot(n, n) > 1e-12F; };
    if (given.empty() || !std::all_of(given.begin(), given.end(), usable)) generate_normals(mesh);
    if (given.empty()) return;
    mesh.normals.resize(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (usable(given[i]))
            mesh.normals[i] = glm::vec3(glm::normalize(glm::dvec3(given[i])));
        else
            import.warn("normals without a direction were generated");
    }
}

/// The texture coordinates that the primitive's normal map uses.
const std::vector<glm::vec2>& normal_map_uvs(const PrimitiveImport& import, const Mesh& mesh) {
    if (!import.primitive.material || mesh.uvs1.empty()) return mesh.uvs;
    const MaterialDescription& material = import.document.materials[*import.primitive.material];
    return material.normal_texture && material.normal_texture->uv_set == 1 ? mesh.uvs1 : mesh.uvs;
}

void finish_tangents(const PrimitiveImport& import, Mesh& mesh) {
    if (mesh.tangents.empty()) {
        generate_tangents(mesh, normal_map_uvs(import, mesh));
        return;
    }
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        if (!is_finite(mesh.tangents[i])) mesh.tangents[i] = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        if (!orthonormalise_tangent(mesh.tangents[i], mesh.normals[i]))
            import.warn("tangents without a direction in the surface were replaced");
    }
}

}  // namespace

bool has_positions(const GltfPrimitive& primitive) {
    return primitive.attributes.contains("POSITION") ||
           (primitive.draco && primitive.draco->attributes.contains("POSITION"));
}

bool has_triangles(const GltfPrimitive& primitive) {
    return primitive.mode == PrimitiveMode::Triangles || primitive.mode == PrimitiveMode::TriangleStrip ||
           primitive.mode == PrimitiveMode::TriangleFan;
}

Mesh import_primitive(const GltfDocument& document, const GltfPrimitive& primitive, const std::string& pointer,
                      DracoProcess& decoder, MemoryBudget& budget, std::vector<std::string>& warnings) {
    std::optional<DracoMesh> stream;
    if (primitive.draco)
        stream.emplace(view_bytes(document, primitive.draco->view), document.file, pointer, decoder, budget);
    const PrimitiveImport import{document, primitive, pointer, budget, warnings, stream ? &*stream : nullptr};

    Mesh mesh;
    read_vertices(import, mesh);
    // A Draco stream holds a list of triangles, whatever the mode says.
    const PrimitiveMode mode = import.draco ? PrimitiveMode::Triangles : primitive.mode;
    mesh.indices = triangle_list(import, mode, read_corners(import, mesh.positions.size()));
    // The steps below add at most normals, tangents and uvs, and hold the tangents' sums for a moment.
    budget.spend(mesh.positions.size(), sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(glm::vec2), pointer);
    budget.require_left(mesh.positions.size(), 6 * sizeof(double), pointer);
    finish_uvs(import, mesh);
    finish_normals(import, mesh);
    finish_tangents(import, mesh);
    return mesh;
}

}  // namespace rowland::scene
