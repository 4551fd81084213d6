#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// A triangle mesh decoded from a Draco 2.2 stream that may be hostile. The counts the stream claims are checked
/// against its length and the memory budget before the decoder runs, and everything it returns is range-checked.
class DracoMesh {
 public:
    /// `place` says where in `file` the stream is. Throws Error (input).
    DracoMesh(std::span<const std::byte> stream, const std::string& file, const std::string& place,
              MemoryBudget& budget);
    ~DracoMesh();
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    std::size_t vertex_count() const;
    /// Three a triangle, each below vertex_count().
    std::vector<std::uint32_t> indices() const;
    /// Number of components of the attribute with Draco's unique id `id`; `name` is for messages. Throws Error (input)
    /// if there is none.
    int component_count(std::uint32_t id, const std::string& name) const;
    /// The attribute's values, one glm::vec2, vec3, vec4 or u16vec4 a vertex; as floats, `normalised` integers stand
    /// for [0, 1] or [−1, 1]. Throws Error (input) if there is none, or if its number of components differs.
    template <typename Vector>
    std::vector<Vector> vectors(std::uint32_t id, const std::string& name, bool normalised = false) const;

 private:
    struct Decoded;
    std::unique_ptr<Decoded> decoded_;
};

}  // namespace rowland::scene
