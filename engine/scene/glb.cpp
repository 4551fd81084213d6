#include <fmt/format.h>

#include <limits>

#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/scene/gltf_source.h"

namespace rowland::scene {

std::vector<std::byte> glb_beginning(std::string json, std::optional<std::size_t> binary_size, std::size_t other_size,
                                     const std::string& file) {
    json.resize(padded_chunk(json.size()), ' ');
    const std::size_t total = 20 + json.size() + (binary_size ? 8 + padded_chunk(*binary_size) : 0) + other_size;
    if (total > std::numeric_limits<std::uint32_t>::max())
        refuse_input(file, "", fmt::format("{} bytes with what was added", total),
                     "at most 4 GiB, the most that a .glb can hold");
    ByteWriter writer;
    const auto put = [&](std::size_t number) { writer.value(static_cast<std::uint32_t>(number)); };
    for (const std::size_t number :
         {std::size_t{GltfSource::kMagic}, std::size_t{2}, total, json.size(), std::size_t{GltfSource::kJsonChunk}})
        put(number);
    for (const char character : json) writer.value(character);
    if (binary_size) {
        put(padded_chunk(*binary_size));
        put(GltfSource::kBinaryChunk);
    }
    return writer.take();
}

}  // namespace rowland::scene
