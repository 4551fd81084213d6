#pragma once

#include <array>
#include <cstdint>
#include <string_view>

// The messages between the importer and its Draco helper, sent as they lie in memory, since both programs are of one
// build. This header needs nothing of the library, so that the helper links the decoder only.
namespace rowland::scene {

constexpr std::string_view kDracoHelper = "rowland-decode-draco";

enum class DracoAsk : std::uint32_t {
    Decode,   ///< `size` bytes of a stream follow the request; `attributes` DracoAttributes follow the reply
    Indices,  ///< three std::uint32_t per face follow the reply
    Values,   ///< `components` floats per point of `attribute` follow the reply
};

struct DracoRequest {
    DracoAsk ask = DracoAsk::Decode;
    std::uint32_t attribute = 0;  ///< Draco's unique id
    std::uint32_t components = 0;
    std::uint32_t unused = 0;
    std::uint64_t size = 0;
    std::uint64_t memory = 0;  ///< bytes of address space for decoding
};

struct DracoReply {
    std::uint32_t done = 0;  ///< 0: refused for `reason`, and no data follow
    std::uint32_t points = 0;
    std::uint32_t faces = 0;
    std::uint32_t attributes = 0;
    std::array<char, 112> reason{};
};

struct DracoAttribute {
    std::uint32_t unique_id = 0;
    std::uint32_t components = 0;
    std::uint32_t largest_code = 1;  ///< the integer that means 1 in a normalised attribute; 1 for floats
};

}  // namespace rowland::scene
