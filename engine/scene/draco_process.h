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

namespace rowland::scene {

/// What decoding may use at least; large streams get more in proportion to their size. Enough for anything small on a
/// busy machine, and for the tables of 2 million triangles.
struct DracoLimits {
    std::chrono::steady_clock::duration time = std::chrono::seconds(3);  ///< for all streams, to which each adds
    std::uint64_t memory = 448ULL << 20;                                 ///< bytes of address space, with the libraries
};

/// Why a stream cannot be decoded.
struct DracoRefusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Draco's decoder in a process of its own, started at the first stream, so that a stream that makes it crash, hang or
/// take gigabytes costs a refusal and nothing else. All streams of a file use one process and its time.
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

}  // namespace rowland::scene
