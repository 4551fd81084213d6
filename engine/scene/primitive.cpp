#include "engine/scene/primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/core/error.h"
#include "engine/scene/draco_decode.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/tangents.h"

namespace rowland::scene {

namespace {

/// Where one primitive is imported, for every step of it.
struct Import {
    const GltfDocument& document;
    const GltfPrimitive& primitive;
    const std::string& place;
    MemoryBudget& budget;
    std::vector<std::string>& warnings;

    [[noreturn]] void fail(std::string found, std::string expected) const {
        throw Error({.file = document.file,
                     .place = place,
                     .found = std::move(found),
                     .expected = std::move(expected),
                     .remedy = {}});
    }
};

template <typename Vector>
bool is_finite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

/// Reads an attribute from the Draco stream if it is there, else from its accessor; empty if the primitive has none.
template <typename Vector>
std::vector<Vector> read_attribute(const Import& import, const DracoMesh* draco, const std::string& name) {
    if (draco) {
        const auto& ids = import.primitive.draco->attributes;
        if (const auto id = ids.find(name); id != ids.end()) return draco->vectors<Vector>(id->second, name);
    }
    const auto accessor = import.primitive.attributes.find(name);
    if (accessor == import.primitive.attributes.end()) return {};
    // An accessor without data would read as zeros, which only a sparse one can mean.
    const GltfAccessor& at = import.document.accessors[accessor->second];
    if (!at.view && !at.sparse) import.fail(fmt::format("an accessor without data for {}", name), "a buffer view");
    return read_vectors<Vector>(import.document, accessor->second, import.budget);
}

void read_vertices(const Import& import, const DracoMesh* draco, Mesh& mesh) {
    mesh.positions = read_attribute<glm::vec3>(import, draco, "POSITION");
    if (mesh.positions.empty()) import.fail("no POSITION attribute", "one");
    mesh.normals = read_attribute<glm::vec3>(import, draco, "NORMAL");
    mesh.tangents = read_attribute<glm::vec4>(import, draco, "TANGENT");
    mesh.uvs = read_attribute<glm::vec2>(import, draco, "TEXCOORD_0");
    const auto check_length = [&](std::size_t length, const char* name) {
        if (length != 0 && length != mesh.positions.size())
            import.fail(fmt::format("{} values of {}", length, name),
                        fmt::format("as many as POSITION, {}", mesh.positions.size()));
    };
    check_length(mesh.normals.size(), "NORMAL");
    check_length(mesh.tangents.size(), "TANGENT");
    check_length(mesh.uvs.size(), "TEXCOORD_0");
    for (const glm::vec3& position : mesh.positions)
        if (!is_finite(position)) import.fail("a position that is infinite or not a number", "finite positions");
}

/// The primitive's vertex indices as they stand, each checked.
std::vector<std::uint32_t> read_corners(const Import& import, const DracoMesh* draco, std::size_t vertex_count) {
    std::vector<std::uint32_t> corners;
    if (draco) {
        corners = draco->indices();
    } else if (import.primitive.indices) {
        corners = read_indices(import.document, *import.primitive.indices, import.budget);
    } else {
        import.budget.spend(vertex_count, sizeof(std::uint32_t), import.place);
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
std::vector<std::uint32_t> triangle_list(const Import& import, PrimitiveMode mode, std::vector<std::uint32_t> corners) {
    if (mode == PrimitiveMode::Triangles) {
        if (corners.size() % 3 != 0) import.fail(fmt::format("{} triangle corners", corners.size()), "a multiple of 3");
        return corners;
    }
    if (corners.size() < 3) import.fail(fmt::format("{} corners", corners.size()), "at least 3");
    import.budget.spend(corners.size() - 2, 3 * sizeof(std::uint32_t), import.place);
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

void finish_uvs(const Import& import, Mesh& mesh) {
    if (mesh.uvs.empty()) mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0F));
    for (glm::vec2& uv : mesh.uvs) {
        if (is_finite(uv)) continue;
        uv = glm::vec2(0.0F);
        warn_once(import.warnings, import.place + ": texture coordinates that are not numbers were set to 0");
    }
}

void finish_normals(const Import& import, Mesh& mesh) {
    std::vector<glm::vec3> given = std::move(mesh.normals);
    // Generated ones stand in for those that are missing or unusable.
    const auto usable = [](const glm::vec3& n) { return is_finite(n) && glm::dot(n, n) > 1e-12F; };
    if (given.empty() || !std::all_of(given.begin(), given.end(), usable)) generate_normals(mesh);
    if (given.empty()) return;
    mesh.normals.resize(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (usable(given[i]))
            mesh.normals[i] = glm::vec3(glm::normalize(glm::dvec3(given[i])));
        else
            warn_once(import.warnings, import.place + ": normals without a direction were generated");
    }
}

void finish_tangents(const Import& import, Mesh& mesh) {
    if (mesh.tangents.empty()) {
        generate_tangents(mesh);
        return;
    }
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        if (!is_finite(mesh.tangents[i])) mesh.tangents[i] = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        if (!orthonormalise_tangent(mesh.tangents[i], mesh.normals[i]))
            warn_once(import.warnings, import.place + ": tangents without a direction in the surface were replaced");
    }
}

}  // namespace

bool has_triangles(const GltfPrimitive& primitive) {
    return primitive.mode == PrimitiveMode::Triangles || primitive.mode == PrimitiveMode::TriangleStrip ||
           primitive.mode == PrimitiveMode::TriangleFan;
}

Mesh import_primitive(const GltfDocument& document, const GltfPrimitive& primitive, const std::string& place,
                      MemoryBudget& budget, std::vector<std::string>& warnings) {
    const Import import{document, primitive, place, budget, warnings};
    std::optional<DracoMesh> draco;
    if (primitive.draco) draco.emplace(view_bytes(document, primitive.draco->view), document.file, place, budget);
    const DracoMesh* stream = draco ? &*draco : nullptr;

    Mesh mesh;
    read_vertices(import, stream, mesh);
    // A Draco stream holds a list of triangles, whatever the mode says.
    const PrimitiveMode mode = stream ? PrimitiveMode::Triangles : primitive.mode;
    mesh.indices = triangle_list(import, mode, read_corners(import, stream, mesh.positions.size()));
    // What the steps below add at most: normals, tangents and their sums, uvs.
    budget.spend(mesh.positions.size(), sizeof(glm::vec3) + sizeof(glm::vec4) + 6 * sizeof(double) + sizeof(glm::vec2),
                 place);
    finish_uvs(import, mesh);
    finish_normals(import, mesh);
    finish_tangents(import, mesh);
    return mesh;
}

}  // namespace rowland::scene
