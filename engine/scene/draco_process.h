#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/child_process.h"
#include "engine/scene/draco_exchange.h"

namespace rowland::scene {

/// What decoding may take where that is not more in proportion to a stream's size: more than anything small needs, even
/// where the machine is busy with other things, and the tables for 2 million triangles.
struct DracoLimits {
    std::chrono::steady_clock::duration time = std::chrono::seconds(3);  ///< for all streams, to which each adds
    std::uint64_t memory = 448ULL << 20;                                 ///< bytes of address space, with the libraries
};

/// Draco's decoder in a process of its own (started when first needed), so that a stream that makes it crash, run on or
/// take gigabytes costs a refusal and nothing else. One for all the streams of a file, which share its time.
class DracoProcess {
 public:
    /// What a stream holds, or why it has been refused.
    struct Decoded {
        std::string refused;  ///< empty: it has been decoded
        std::size_t points = 0;
        std::size_t faces = 0;
        std::vector<DracoAttribute> attributes;
    };

    explicit DracoProcess(const DracoLimits& limits = {}) : allowed_(limits.time), memory_(limits.memory) {}

    /// Decodes a stream; what was decoded before is gone. Throws Error (system) if the decoder cannot be started.
    Decoded decode(std::span<const std::byte> stream);
    /// Three for each face, none of them checked. Here and below: `result` has the size that `decode` told, and what is
    /// returned is why there is none, or empty.
    std::string indices(std::span<std::uint32_t> result);
    /// All components of an attribute for each point, as float or std::uint16_t.
    std::string values(const DracoAttribute& attribute, std::span<float> result);
    std::string values(const DracoAttribute& attribute, std::span<std::uint16_t> result);

 private:
    class Timed;

    std::string ask(const DracoRequest& request, std::span<const std::byte> sent, DracoReply& reply);
    std::string fetch(const DracoRequest& request, std::span<std::byte> result);
    std::string reason(ChildProcess::Exchange exchange);
    ChildProcess::Deadline deadline() const { return begin_ + (allowed_ - used_); }

    std::optional<ChildProcess> process_;
    std::chrono::steady_clock::duration allowed_;
    std::uint64_t memory_;
    std::chrono::steady_clock::duration used_{};
    std::chrono::steady_clock::time_point begin_;  ///< of the present exchange
};

}  // namespace rowland::scene
