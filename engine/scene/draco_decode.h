#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/draco_process.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// A triangle mesh decoded from a Draco 2.2 stream that may be hostile. The counts the stream claims are checked
/// against its length and the memory budget before the decoder runs, which it does in a process of its own, and
/// everything it returns is range-checked.
class DracoMesh {
 public:
    /// `place` says where in `file` the stream is. The decoder holds the mesh, so it can be read until the next one is
    /// decoded. Throws Error (input).
    DracoMesh(std::span<const std::byte> stream, const std::string& file, const std::string& place,
              DracoProcess& decoder, MemoryBudget& budget);
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    std::size_t vertex_count() const { return decoded_.points; }
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
    [[noreturn]] void fail(std::string found, std::string expected) const;
    const DracoAttribute& attribute(std::uint32_t id, const std::string& name) const;

    std::string file_;
    std::string place_;
    DracoProcess& decoder_;
    MemoryBudget& budget_;
    DracoProcess::Decoded decoded_;
};

}  // namespace rowland::scene
