#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/draco_process.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// A triangle mesh decoded from a Draco stream that may be hostile. The decoder runs in a process of its own with
/// limits of memory and time; the sizes it returns are spent from the memory budget before anything is allocated here,
/// and every index is checked.
class DracoMesh {
 public:
    /// `pointer` is the stream's JSON pointer in `file`. The decoder holds the mesh, which can be read until the next
    /// one is decoded. Throws Error (input).
    DracoMesh(std::span<const std::byte> stream, const std::string& file, const std::string& pointer,
              DracoProcess& decoder, MemoryBudget& budget);
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    std::size_t vertex_count() const { return decoded_.points; }
    /// Three per triangle, each below vertex_count().
    std::vector<std::uint32_t> indices() const;
    /// Number of components of the attribute with Draco's unique id `id`; `name` is for messages. Throws Error (input)
    /// if there is none.
    int component_count(std::uint32_t id, const std::string& name) const;
    /// The attribute's values, one glm::vec2, vec3 or vec4 per vertex; `normalised` integers become [0, 1] or [−1, 1].
    /// Throws Error (input) if there is none, or if its number of components differs.
    template <typename Vector>
    std::vector<Vector> vectors(std::uint32_t id, const std::string& name, bool normalised = false) const;

 private:
    [[noreturn]] void fail(std::string found, std::string expected) const;
    const DracoAttribute& attribute(std::uint32_t id, const std::string& name) const;

    std::string file_;
    std::string pointer_;
    DracoProcess& decoder_;
    MemoryBudget& budget_;
    DracoProcess::Decoded decoded_;
};

}  // namespace rowland::scene
