#include "engine/scene/draco_decode.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>
#include <utility>

#include "engine/core/error.h"
#include "engine/scene/draco_header.h"

namespace rowland::scene {

DracoMesh::DracoMesh(std::span<const std::byte> stream, const std::string& file, const std::string& place,
                     DracoProcess& decoder, MemoryBudget& budget)
    : file_(file), place_(place), decoder_(decoder), budget_(budget) {
    const DracoCounts counts = read_draco_counts(stream, file + ": " + place);
    // What the decoder's corner table takes: two indices a corner, and the face's vertices.
    constexpr std::uint64_t kBytesPerFace = 9 * sizeof(std::uint32_t);
    budget.spend(counts.faces, kBytesPerFace, place);
    decoded_ = decoder.decode(stream);
    if (!decoded_.refused.empty()) fail(fmt::format("a broken Draco stream ({})", decoded_.refused), "a whole one");
    if (decoded_.points == 0 || decoded_.faces == 0) fail("an empty Draco mesh", "triangles");
}

void DracoMesh::fail(std::string found, std::string expected) const {
    throw Error({.file = file_,
                 .place = place_,
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = "export the mesh again"});
}

std::vector<std::uint32_t> DracoMesh::indices() const {
    budget_.spend(decoded_.faces, 3 * sizeof(std::uint32_t), place_);
    std::vector<std::uint32_t> indices(decoded_.faces * 3);
    if (const std::string why = decoder_.indices(indices); !why.empty())
        fail(fmt::format("no indices ({})", why), "those of the faces");
    for (const std::uint32_t index : indices)
        if (index >= decoded_.points)
            fail(fmt::format("index {}", index), fmt::format("below the {} vertices", decoded_.points));
    return indices;
}

const DracoAttribute& DracoMesh::attribute(std::uint32_t id, const std::string& name) const {
    const auto found = std::find_if(decoded_.attributes.begin(), decoded_.attributes.end(),
                                    [&](const DracoAttribute& attribute) { return attribute.unique_id == id; });
    if (found == decoded_.attributes.end()) fail(fmt::format("no Draco attribute {} for {}", id, name), "one");
    return *found;
}

int DracoMesh::component_count(std::uint32_t id, const std::string& name) const {
    return static_cast<int>(attribute(id, name).components);
}

template <typename Vector>
std::vector<Vector> DracoMesh::vectors(std::uint32_t id, const std::string& name, bool normalised) const {
    using Component = typename Vector::value_type;
    static_assert(sizeof(Vector) == Vector::length() * sizeof(Component), "vectors lie one behind another");
    const DracoAttribute& source = attribute(id, name);
    if (source.components != static_cast<std::uint32_t>(Vector::length()))
        fail(fmt::format("{} components of {}", source.components, name), fmt::format("{}", Vector::length()));
    budget_.spend(decoded_.points, sizeof(Vector), place_);
    std::vector<Vector> vectors(decoded_.points);
    const std::span components(&vectors[0][0], vectors.size() * static_cast<std::size_t>(Vector::length()));
    if (const std::string why = decoder_.values(source, components); !why.empty())
        fail(fmt::format("no values of {} ({})", name, why), "one a vertex");
    if constexpr (std::is_floating_point_v<Component>) {
        // Signed types have two codes for −1 (glTF 2.0, 3.6.2.2).
        const float factor = normalised ? 1.0F / static_cast<float>(source.largest_code) : 1.0F;
        if (factor != 1.0F)
            for (Vector& vector : vectors) vector = glm::max(vector * factor, Vector(-1.0F));
    }
    return vectors;
}
template std::vector<glm::vec2> DracoMesh::vectors<glm::vec2>(std::uint32_t, const std::string&, bool) const;
template std::vector<glm::vec3> DracoMesh::vectors<glm::vec3>(std::uint32_t, const std::string&, bool) const;
template std::vector<glm::vec4> DracoMesh::vectors<glm::vec4>(std::uint32_t, const std::string&, bool) const;
template std::vector<glm::u16vec4> DracoMesh::vectors<glm::u16vec4>(std::uint32_t, const std::string&, bool) const;

}  // namespace rowland::scene
