#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/byte_stream.h"

namespace rowland::diffraction {

inline constexpr std::size_t kTexelComponents = 4;  ///< RGBA

/// Format of a stored component: n/65535, a half float, a float, or n/255.
enum class Storage : std::uint8_t { Unorm16 = 0, Half = 1, Float = 2, Unorm8 = 3 };

/// Bytes of a stored component: 2, 2, 4, 1.
std::size_t component_bytes(Storage storage);

/// "unorm16", "fp16", "fp32", "unorm8".
const char* storage_name(Storage storage);
/// Inverse of storage_name(), whose result `name` must be.
Storage parse_storage(std::string_view name);

/// Layers of RGBA texels as a texture holds them. A component's value is `stored·scale + bias` with scale and bias of
/// its layer. Unorm spans [minimum, maximum] of a component's layer; half floats map the same interval to [−1, 1], with
/// the highest precision about 0; floats are the values themselves, scale 1 and bias 0.
struct PackedTexels {
    Storage storage = Storage::Unorm16;
    std::vector<glm::vec4> scale;  ///< per layer
    std::vector<glm::vec4> bias;   ///< per layer
    /// The components' bits in memory order, RGBA, layer by layer: one word each, fp32 two, unorm8 half a word.
    std::vector<std::uint16_t> texels;

    /// A component of the texel `index` (over all layers), which lies in `layer`.
    double value(std::size_t layer, std::size_t index, std::size_t component) const;
    /// Size of an upload, scale and bias included.
    std::size_t bytes() const;
};

/// Replaces texels, scale and bias of `packed` by `values` (RGBA, layer by layer, `layers` ≥ 1 layers of equal size),
/// rounded to its storage. Values must be finite.
void pack(std::span<const double> values, std::size_t layers, PackedTexels& packed);

/// Writes scale, bias and texels; the caller writes the storage.
void write_packed_texels(const PackedTexels& packed, ByteWriter& writer);

/// Reads scale, bias and texels into `packed`, whose storage is set. Throws Error (input) unless there are `layers`
/// layers of `texels_per_layer` texels and every scale, bias and float is finite.
void read_packed_texels(ByteReader& reader, std::size_t layers, std::size_t texels_per_layer, PackedTexels& packed);

/// The storage that a number in a file names. Throws Error (input) at the reader's offset.
Storage to_storage(const ByteReader& reader, unsigned number);

/// Writes 3 × 3 matrices: their count, then nine floats each, column by column.
void write_matrices(std::span<const glm::mat3> matrices, ByteWriter& writer);
/// Throws Error (input) unless their number is within bounds and every number finite.
std::vector<glm::mat3> read_matrices(ByteReader& reader, const char* what, std::size_t fewest, std::size_t most);

/// A count within bounds. Throws Error (input) that names `what`.
int read_count(ByteReader& reader, const char* what, int minimum, int maximum);

}  // namespace rowland::diffraction
