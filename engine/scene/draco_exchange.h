#pragma once

#include <array>
#include <cstdint>
#include <string_view>

// What the importer and its Draco helper send each other, as it lies in memory: both are of one build. Kept free of
// the library, so that the helper has nothing in it but the decoder.
namespace rowland::scene {

constexpr std::string_view kDracoHelper = "rowland-decode-draco";

enum class DracoAsk : std::uint32_t {
    Decode,   ///< `size` bytes of a stream follow the request; `attributes` DracoAttributes follow the reply
    Indices,  ///< three std::uint32_t a face follow the reply
    Values,   ///< `components` of each point's `attribute` follow the reply, as `element`
};

enum class DracoElement : std::uint32_t { Float, UnsignedShort };

struct DracoRequest {
    DracoAsk ask = DracoAsk::Decode;
    std::uint32_t attribute = 0;  ///< Draco's unique id
    std::uint32_t components = 0;
    DracoElement element = DracoElement::Float;
    std::uint64_t size = 0;
    std::uint64_t memory = 0;  ///< bytes of address space for decoding
};

struct DracoReply {
    std::uint32_t done = 0;  ///< 0: nothing follows but the next request, for `reason`
    std::uint32_t points = 0;
    std::uint32_t faces = 0;
    std::uint32_t attributes = 0;
    std::array<char, 112> reason{};
};

struct DracoAttribute {
    std::uint32_t unique_id = 0;
    std::uint32_t components = 0;
    std::uint32_t largest_code = 1;  ///< stands for 1 if the attribute is normalised; 1: its values are what they are
};

}  // namespace rowland::scene
