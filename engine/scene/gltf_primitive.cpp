// Imports primitives of a glTF file as meshes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "engine/core/error.h"
#include "engine/scene/gltf_parts.h"
#include "engine/scene/mesh.h"

namespace rowland::scene {

namespace {

struct PrimitiveImport {
    const GltfDocument& document;
    const gltf::Primitive& primitive;
    const std::string& pointer;  ///< JSON pointer of the primitive
    MemoryBudget& budget;
    std::vector<std::string>& warnings;
    const DracoMesh* draco;  ///< null: not compressed

    /// Throws Error (input).
    [[noreturn]] void fail(std::string found, std::string expected) const {
        refuse_input(document.file, pointer, std::move(found), std::move(expected));
    }
    /// Adds a warning about this primitive, once.
    void warn(const std::string& text) const { warn_once(warnings, pointer + ": " + text); }
};

/// JOINTS_0 and WEIGHTS_0, both empty if one of them is missing.
struct Skinning {
    std::vector<glm::u16vec4> joints;
    std::vector<glm::vec4> weights;  ///< ≥ 0, sum 1
};

template <typename Vector>
bool is_finite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

/// The object of KHR_draco_mesh_compression; null: none.
const gltf::Value* draco_of(const gltf::Primitive& primitive) {
    const auto found = primitive.extensions.find(kDracoExtension);
    return found == primitive.extensions.end() ? nullptr : &found->second;
}

const gltf::Accessor* accessor_of(const PrimitiveImport& import, const std::string& name) {
    const auto found = import.primitive.attributes.find(name);
    return found == import.primitive.attributes.end()
               ? nullptr
               : &import.document.model.accessors[static_cast<std::size_t>(found->second)];
}

/// Draco's id of an attribute, if the stream holds it.
std::optional<std::uint32_t> draco_id(const gltf::Primitive& primitive, const std::string& name) {
    const gltf::Value* draco = draco_of(primitive);
    if (draco == nullptr || !draco->Get("attributes").Has(name)) return std::nullopt;
    return static_cast<std::uint32_t>(draco->Get("attributes").Get(name).GetNumberAsInt());
}

/// An attribute as glm::vec2, vec3 or vec4, from the Draco stream if it is there, else from its accessor; empty if the
/// primitive has none.
template <typename Vector>
std::vector<Vector> read_attribute(const PrimitiveImport& import, const std::string& name) {
    const gltf::Accessor* accessor = accessor_of(import, name);
    if (const auto id = draco_id(import.primitive, name))
        return import.draco->vectors<Vector>(*id, name, accessor && accessor->normalized);
    if (!accessor) return {};
    return read_vectors<Vector>(import.document, import.primitive.attributes.at(name), import.budget);
}

/// Colours and weights are floats or normalised unsigned bytes or shorts, joints unsigned bytes or shorts (glTF 2.0,
/// 3.7.2.1).
void require_component_type(const PrimitiveImport& import, const std::string& name, bool is_fraction) {
    const gltf::Accessor* accessor = accessor_of(import, name);
    if (!accessor || (is_fraction && accessor->componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)) return;
    const bool is_small = accessor->componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          accessor->componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    if (!is_small || accessor->normalized != is_fraction)
        import.fail(fmt::format("{} of another type", name),
                    is_fraction ? "floats or normalised unsigned bytes or shorts" : "unsigned bytes or shorts");
}

std::vector<glm::u16vec4> read_joints(const PrimitiveImport& import, const std::string& name) {
    require_component_type(import, name, false);
    // Floats hold every 16-bit number exactly.
    const std::vector<glm::vec4> read = read_attribute<glm::vec4>(import, name);
    import.budget.spend(read.size(), sizeof(glm::u16vec4), import.pointer);
    std::vector<glm::u16vec4> joints;
    joints.reserve(read.size());
    for (const glm::vec4& joint : read) {
        for (int i = 0; i < 4; ++i)
            if (!(joint[i] >= 0.0F && joint[i] <= 65535.0F))
                import.fail(fmt::format("joint {}", joint[i]), "a number from 0 to 65535");
        joints.emplace_back(joint);
    }
    return joints;
}

void finish_weights(const PrimitiveImport& import, Skinning& skinning) {
    for (std::size_t i = 0; i < skinning.weights.size(); ++i) {
        glm::vec4& weights = skinning.weights[i];
        glm::dvec4 usable(0.0);
        for (int k = 0; k < 4; ++k) {
            if (std::isfinite(weights[k]) && weights[k] >= 0.0F)
                usable[k] = weights[k];
            else
                import.warn("joint weights that are negative or not numbers were set to 0");
        }
        const double sum = usable.x + usable.y + usable.z + usable.w;
        if (sum > 0.0) {
            weights = glm::vec4(usable / sum);
        } else {
            weights = glm::vec4(1.0F, 0.0F, 0.0F, 0.0F);
            import.warn("vertices without joint weights were given to their first joint");
        }
        // The joint of a slot of weight 0 may be any number.
        for (int k = 0; k < 4; ++k)
            if (weights[k] == 0.0F) skinning.joints[i][k] = 0;
    }
}

/// COLOR_0 as linear RGBA, clamped to [0, 1] (glTF 2.0, 3.7.2.1); empty if there is none.
std::vector<glm::vec4> read_colours(const PrimitiveImport& import) {
    const std::string name = "COLOR_0";
    require_component_type(import, name, true);
    const gltf::Accessor* accessor = accessor_of(import, name);
    const auto id = draco_id(import.primitive, name);
    const int components = id                                                 ? import.draco->component_count(*id, name)
                           : accessor && accessor->type == TINYGLTF_TYPE_VEC3 ? 3
                                                                              : 4;
    std::vector<glm::vec4> colours;
    if (components == 3) {
        const std::vector<glm::vec3> opaque = read_attribute<glm::vec3>(import, name);
        import.budget.spend(opaque.size(), sizeof(glm::vec4), import.pointer);
        colours.reserve(opaque.size());
        for (const glm::vec3& colour : opaque) colours.emplace_back(colour, 1.0F);
    } else {
        colours = read_attribute<glm::vec4>(import, name);
    }
    for (glm::vec4& colour : colours) {
        if (!is_finite(colour)) {
            colour = glm::vec4(1.0F);
            import.warn("colours that are not numbers were set to white");
        }
        colour = glm::clamp(colour, 0.0F, 1.0F);
    }
    return colours;
}

/// Normalises the weights to sum 1; a vertex without positive weights follows its first joint.
Skinning read_skinning(const PrimitiveImport& import) {
    const bool has_joints = has_attribute(import.primitive, "JOINTS_0");
    if (has_joints != has_attribute(import.primitive, "WEIGHTS_0")) {
        import.warn("joints without weights, or weights without joints, are ignored");
        return {};
    }
    if (!has_joints) return {};
    if (has_attribute(import.primitive, "JOINTS_1"))
        warn_once(import.warnings, "joints beyond four a vertex are ignored");
    require_component_type(import, "WEIGHTS_0", true);
    Skinning skinning{read_joints(import, "JOINTS_0"), read_attribute<glm::vec4>(import, "WEIGHTS_0")};
    if (skinning.joints.size() != skinning.weights.size())
        import.fail(fmt::format("{} values of JOINTS_0", skinning.joints.size()),
                    fmt::format("as many as WEIGHTS_0, {}", skinning.weights.size()));
    finish_weights(import, skinning);
    return skinning;
}

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

/// The primitive's vertex indices as stored, each checked to be below `vertex_count`; if none are stored, all in order.
std::vector<std::uint32_t> read_corners(const PrimitiveImport& import, std::size_t vertex_count) {
    std::vector<std::uint32_t> corners;
    if (import.draco) {
        corners = import.draco->indices();
    } else if (import.primitive.indices >= 0) {
        corners = read_indices(import.document, import.primitive.indices, import.budget);
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

/// Converts strips and fans to triangle lists of the same winding (glTF 2.0, 3.7.2.1).
std::vector<std::uint32_t> triangle_list(const PrimitiveImport& import, int mode, std::vector<std::uint32_t> corners) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        if (corners.size() % 3 != 0) import.fail(fmt::format("{} triangle corners", corners.size()), "a multiple of 3");
        return corners;
    }
    if (corners.size() < 3) import.fail(fmt::format("{} corners", corners.size()), "at least 3");
    import.budget.spend(corners.size() - 2, 3 * sizeof(std::uint32_t), import.pointer);
    std::vector<std::uint32_t> list;
    list.reserve((corners.size() - 2) * 3);
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool odd = i % 2 == 1;
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
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

void finish_tangents(const PrimitiveImport& import, int normal_map_uvs, Mesh& mesh) {
    if (mesh.tangents.empty()) {
        generate_tangents(mesh, normal_map_uvs == 1 && !mesh.uvs1.empty() ? mesh.uvs1 : mesh.uvs);
        return;
    }
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        if (!is_finite(mesh.tangents[i])) mesh.tangents[i] = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        if (!orthonormalise_tangent(mesh.tangents[i], mesh.normals[i]))
            import.warn("tangents without a direction in the surface were replaced");
    }
}

}  // namespace

bool has_attribute(const gltf::Primitive& primitive, const std::string& name) {
    return primitive.attributes.contains(name) || draco_id(primitive, name);
}

Mesh import_primitive(const GltfDocument& document, const gltf::Primitive& primitive, int normal_map_uvs,
                      const std::string& pointer, DracoProcess& decoder, MemoryBudget& budget,
                      std::vector<std::string>& warnings) {
    std::optional<DracoMesh> stream;
    if (const gltf::Value* draco = draco_of(primitive))
        stream.emplace(document.view_bytes(draco->Get("bufferView").GetNumberAsInt()), document.file, pointer, decoder,
                       budget);
    const PrimitiveImport import{document, primitive, pointer, budget, warnings, stream ? &*stream : nullptr};

    Mesh mesh;
    read_vertices(import, mesh);
    // A Draco stream holds a list of triangles, whatever the mode says.
    const int mode = import.draco ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    mesh.indices = triangle_list(import, mode, read_corners(import, mesh.positions.size()));
    // The steps below add at most normals, tangents and uvs; the tangents' sums are freed again.
    budget.spend(mesh.positions.size(), sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(glm::vec2), pointer);
    budget.require_left(mesh.positions.size(), 6 * sizeof(double), pointer);
    finish_uvs(import, mesh);
    finish_normals(import, mesh);
    finish_tangents(import, normal_map_uvs, mesh);
    return mesh;
}

}  // namespace rowland::scene
