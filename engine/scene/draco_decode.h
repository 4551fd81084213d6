#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/child_process.h"
#include "engine/scene/draco_exchange.h"
#include "engine/scene/gltf_source.h"

namespace rowland::scene {

/// Limits for small streams; large streams raise them in proportion to their size. The defaults are enough for any
/// small stream on a busy machine, and the memory for the decoder's tables of 2 million triangles.
struct DracoLimits {
    std::chrono::steady_clock::duration time = std::chrono::seconds(3);  ///< for a whole file; each stream adds to it
    std::uint64_t memory = 448ULL << 20;                                 ///< bytes of address space, with the libraries
};

/// Why a stream cannot be decoded.
struct DracoRefusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Draco's decoder in a process of its own, started at the first stream: a stream that makes it crash, hang or take
/// gigabytes is refused and does no other harm. All streams of a file use one process and its time.
class DracoProcess {
 public:
    struct Decoded {
        std::size_t points = 0;
        std::size_t faces = 0;
        std::vector<DracoAttribute> attributes;
    };

    explicit DracoProcess(const DracoLimits& limits = {}) : allowed_(limits.time), memory_(limits.memory) {}

    /// Decodes a stream; the one before is discarded. Throws DracoRefusal, and Error (system) if the decoder cannot be
    /// started.
    Decoded decode(std::span<const std::byte> stream);
    /// Three unchecked indices per face of the decoded stream. Throws DracoRefusal.
    void indices(std::span<std::uint32_t> result) { fetch({.ask = DracoAsk::Indices}, std::as_writable_bytes(result)); }
    /// All components of an attribute per point. Throws DracoRefusal.
    void values(const DracoAttribute& attribute, std::span<float> result) {
        fetch({.ask = DracoAsk::Values, .attribute = attribute.unique_id, .components = attribute.components},
              std::as_writable_bytes(result));
    }

 private:
    class Timed;

    DracoReply ask(const DracoRequest& request, std::span<const std::byte> sent);
    void fetch(const DracoRequest& request, std::span<std::byte> result);
    void require_done(ChildProcess::Exchange exchange);
    ChildProcess::Deadline deadline() const { return begin_ + (allowed_ - used_); }

    std::optional<ChildProcess> process_;
    std::chrono::steady_clock::duration allowed_;
    std::uint64_t memory_;
    std::chrono::steady_clock::duration used_{};
    ChildProcess::Deadline begin_;  ///< of the present exchange
};

/// A triangle mesh decoded from a Draco stream that may be hostile. The decoder runs in a process of its own with
/// limits of memory and time; the sizes it returns are charged to the memory budget before anything is allocated here,
/// and every index is checked.
class DracoMesh {
 public:
    /// `pointer` is the stream's JSON pointer in `file`. The decoder holds the mesh, which can be read until the next
    /// one is decoded. Throws Error (input), and Error (system) if the decoder cannot be started.
    DracoMesh(std::span<const std::byte> stream, const std::string& file, const std::string& pointer,
              DracoProcess& decoder, MemoryBudget& budget);
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    /// Three per triangle, each below the number of vertices.
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
