#include "modules/diffraction/bake/packed_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

/// Indexed by Storage.
constexpr std::array<std::string_view, 4> kStorageNames{"unorm16", "fp16", "fp32", "unorm8"};

/// The number of words that hold so many components.
std::size_t word_count(Storage storage, std::size_t components) {
    return components * component_bytes(storage) / sizeof(std::uint16_t);
}

double decode(const std::vector<std::uint16_t>& words, std::size_t index, Storage storage) {
    switch (storage) {
        case Storage::Unorm16:
            return words[index] / 65535.0;
        case Storage::Half:
            return static_cast<double>(glm::unpackHalf1x16(words[index]));
        case Storage::Float: {
            const std::uint32_t bits = words[2 * index] | static_cast<std::uint32_t>(words[2 * index + 1]) << 16U;
            return static_cast<double>(std::bit_cast<float>(bits));
        }
        case Storage::Unorm8:
            break;
    }
    return ((words[index / 2] >> (index % 2 * 8)) & 0xffU) / 255.0;
}

void encode(double stored, std::size_t index, Storage storage, std::vector<std::uint16_t>& words) {
    const auto unorm = [stored](double steps) {
        return static_cast<std::uint16_t>(std::lround(std::clamp(stored, 0.0, 1.0) * steps));
    };
    switch (storage) {
        case Storage::Unorm16:
            words[index] = unorm(65535.0);
            return;
        case Storage::Half:
            words[index] = glm::packHalf1x16(static_cast<float>(std::clamp(stored, -1.0, 1.0)));
            return;
        case Storage::Float: {
            const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(stored));
            words[2 * index] = static_cast<std::uint16_t>(bits & 0xffffU);
            words[2 * index + 1] = static_cast<std::uint16_t>(bits >> 16U);
            return;
        }
        case Storage::Unorm8:
            break;
    }
    const unsigned shift = index % 2 * 8;
    words[index / 2] = static_cast<std::uint16_t>(words[index / 2] | unorm(255.0) << shift);
}

struct Range {
    float scale = 1.0F;
    float bias = 0.0F;
};

Range range_of(double minimum, double maximum, Storage storage) {
    switch (storage) {
        case Storage::Float:
            return {};
        case Storage::Half:
            return {static_cast<float>(0.5 * (maximum - minimum)), static_cast<float>(0.5 * (minimum + maximum))};
        case Storage::Unorm16:
        case Storage::Unorm8:
            break;
    }
    return {static_cast<float>(maximum - minimum), static_cast<float>(minimum)};
}

std::vector<glm::vec4> read_vectors(ByteReader& reader, const char* what, std::size_t count) {
    auto values = reader.array<glm::vec4>();
    if (values.size() != count)
        reader.fail(fmt::format("{} entries of {}", values.size(), what), fmt::format("{}, one per layer", count));
    for (const glm::vec4& value : values)
        for (glm::vec4::length_type c = 0; c < static_cast<int>(kTexelComponents); ++c)
            if (!std::isfinite(value[c])) reader.fail(fmt::format("a {} that is not finite", what), "finite numbers");
    return values;
}

/// Floats and halves can be NaN or infinite, unorm cannot.
void refuse_non_finite(const ByteReader& reader, const PackedTexels& packed, std::size_t components) {
    if (packed.storage != Storage::Float && packed.storage != Storage::Half) return;
    for (std::size_t i = 0; i < components; ++i)
        if (!std::isfinite(decode(packed.texels, i, packed.storage)))
            reader.fail(fmt::format("texel component {} that is not finite", i), "finite numbers");
}

}  // namespace

std::size_t component_bytes(Storage storage) {
    switch (storage) {
        case Storage::Float:
            return 4;
        case Storage::Unorm8:
            return 1;
        case Storage::Unorm16:
        case Storage::Half:
            break;
    }
    return 2;
}

const char* storage_name(Storage storage) {
    return kStorageNames.at(static_cast<std::size_t>(storage)).data();
}

Storage parse_storage(std::string_view name) {
    const auto found = std::find(kStorageNames.begin(), kStorageNames.end(), name);
    ROWLAND_CHECK(found != kStorageNames.end(), name);
    return static_cast<Storage>(found - kStorageNames.begin());
}

double PackedTexels::value(std::size_t layer, std::size_t index, std::size_t component) const {
    const auto c = static_cast<glm::vec4::length_type>(component);
    return decode(texels, index * kTexelComponents + component, storage) * static_cast<double>(scale[layer][c]) +
           static_cast<double>(bias[layer][c]);
}

std::size_t PackedTexels::bytes() const {
    return texels.size() * sizeof(texels[0]) + (scale.size() + bias.size()) * sizeof(glm::vec4);
}

void pack(std::span<const double> values, std::size_t layers, PackedTexels& packed) {
    ROWLAND_CHECK(layers > 0 && values.size() % (layers * kTexelComponents) == 0,
                  "layers of RGBA texels of equal size");
    const std::size_t stride = values.size() / layers;
    packed.scale.assign(layers, glm::vec4(0.0F));
    packed.bias.assign(layers, glm::vec4(0.0F));
    packed.texels.assign(word_count(packed.storage, values.size()), 0);
    for (std::size_t layer = 0; layer < layers; ++layer)
        for (std::size_t component = 0; component < kTexelComponents; ++component) {
            const std::size_t first = layer * stride + component;
            double minimum = values[first];
            double maximum = minimum;
            for (std::size_t i = first; i < (layer + 1) * stride; i += kTexelComponents) {
                minimum = std::min(minimum, values[i]);
                maximum = std::max(maximum, values[i]);
            }
            const Range range = range_of(minimum, maximum, packed.storage);
            packed.scale[layer][static_cast<glm::vec4::length_type>(component)] = range.scale;
            packed.bias[layer][static_cast<glm::vec4::length_type>(component)] = range.bias;
            if (range.scale == 0.0F) continue;
            for (std::size_t i = first; i < (layer + 1) * stride; i += kTexelComponents)
                encode((values[i] - static_cast<double>(range.bias)) / static_cast<double>(range.scale), i,
                       packed.storage, packed.texels);
        }
}

void write_packed_texels(const PackedTexels& packed, ByteWriter& writer) {
    writer.array(std::span<const glm::vec4>(packed.scale));
    writer.array(std::span<const glm::vec4>(packed.bias));
    writer.array(std::span<const std::uint16_t>(packed.texels));
}

void read_packed_texels(ByteReader& reader, std::size_t layers, std::size_t texels_per_layer, PackedTexels& packed) {
    packed.scale = read_vectors(reader, "scale", layers);
    packed.bias = read_vectors(reader, "bias", layers);
    packed.texels = reader.array<std::uint16_t>();
    const std::size_t components = layers * texels_per_layer * kTexelComponents;
    if (packed.texels.size() != word_count(packed.storage, components))
        reader.fail(fmt::format("{} words of texels", packed.texels.size()),
                    fmt::format("{}", word_count(packed.storage, components)));
    refuse_non_finite(reader, packed, components);
}

Storage to_storage(const ByteReader& reader, unsigned number) {
    if (number > static_cast<unsigned>(Storage::Unorm8))
        reader.fail(fmt::format("storage {}", number), "0 (unorm16), 1 (fp16), 2 (fp32) or 3 (unorm8)");
    return static_cast<Storage>(number);
}

void write_matrices(std::span<const glm::mat3> matrices, ByteWriter& writer) {
    writer.array(matrices);
}

std::vector<glm::mat3> read_matrices(ByteReader& reader, const char* what, std::size_t fewest, std::size_t most) {
    auto matrices = reader.array<glm::mat3>();
    if (matrices.size() < fewest || matrices.size() > most)
        reader.fail(fmt::format("{} {}", matrices.size(), what), fmt::format("{} to {}", fewest, most));
    for (const glm::mat3& matrix : matrices)
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                if (!std::isfinite(matrix[column][row]))
                    reader.fail(fmt::format("a number in {} that is not finite", what), "finite numbers");
    return matrices;
}

int read_count(ByteReader& reader, const char* what, int minimum, int maximum) {
    const auto value = reader.value<std::int32_t>();
    if (value < minimum || value > maximum)
        reader.fail(fmt::format("{} {}", what, value), fmt::format("{} in [{}, {}]", what, minimum, maximum));
    return value;
}

}  // namespace rowland::diffraction
