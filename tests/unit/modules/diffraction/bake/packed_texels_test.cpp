#include "modules/diffraction/bake/packed_texels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/error.h"

namespace rowland::diffraction {
namespace {

/// Two layers of three texels; a constant component, and one that spans 10⁶.
const std::vector<double> kValues = {0.5, -3.0, 7.0, 1e-3, 0.25, 2.0,  7.0, 1e3, 0.125, 5.0,   7.0, -20.0,
                                     0.0, -1.0, 7.0, 0.0,  1.0,  -0.5, 8.0, 0.0, 0.5,   -0.75, 9.0, 0.0};

PackedTexels packed(Storage storage) {
    PackedTexels result;
    result.storage = storage;
    pack(kValues, 2, result);
    return result;
}

/// Half a step of each storage over the component's range, and a float's rounding of scale and bias.
TEST(PackedTexels, KeepValuesWithinHalfAStep) {
    for (const auto& [storage, half_step] : {std::pair{Storage::Unorm16, 0.5 / 65535.0},
                                             {Storage::Half, 0.5 / 2048.0 / 2.0},
                                             {Storage::Float, 0.0},
                                             {Storage::Unorm8, 0.5 / 255.0}}) {
        const PackedTexels texels = packed(storage);
        for (std::size_t i = 0; i < kValues.size(); ++i) {
            const std::size_t layer = i / 12;
            double low = kValues[layer * 12 + i % 4];
            double high = low;
            for (std::size_t texel = 0; texel < 3; ++texel) {
                low = std::min(low, kValues[layer * 12 + texel * 4 + i % 4]);
                high = std::max(high, kValues[layer * 12 + texel * 4 + i % 4]);
            }
            EXPECT_NEAR(texels.value(layer, i / 4, i % 4), kValues[i],
                        half_step * (high - low) + 1.2e-7 * std::max(std::abs(low), std::abs(high)))
                << storage_name(storage) << " " << i;
        }
    }
}

TEST(PackedTexels, TakeAsManyBytesAsTheirStorage) {
    const std::size_t ranges = std::size_t{2} * 2 * 16;
    for (const Storage storage : {Storage::Unorm16, Storage::Half, Storage::Float, Storage::Unorm8})
        EXPECT_EQ(packed(storage).bytes(), kValues.size() * component_bytes(storage) + ranges);
}

/// The second component of layer 1, texel 1, where an upload finds it.
TEST(PackedTexels, LieAsATextureHoldsThem) {
    const std::size_t component = (1 * 3 + 1) * 4 + 1;
    const PackedTexels bytes = packed(Storage::Unorm8);
    EXPECT_EQ(reinterpret_cast<const std::uint8_t*>(bytes.texels.data())[component], 255);  // −0.5 of −1 … −0.5
    const PackedTexels floats = packed(Storage::Float);
    EXPECT_EQ(reinterpret_cast<const float*>(floats.texels.data())[component], -0.5F);
}

TEST(PackedTexels, RefuseNumbersThatAreNotFinite) {
    for (const Storage storage : {Storage::Float, Storage::Half}) {
        PackedTexels texels = packed(storage);
        const bool half = storage == Storage::Half;
        texels.texels[half ? 5 : 11] = half ? 0x7c00 : 0x7f80;  // infinity
        ByteWriter writer;
        write_packed_texels(texels, writer);
        ByteReader reader(writer.data(), "texels");
        PackedTexels back;
        back.storage = storage;
        EXPECT_THROW(read_packed_texels(reader, 2, 3, back), Error);
    }
}

TEST(PackedTexels, RefuseAnotherNumberOfLayersOrTexels) {
    ByteWriter writer;
    write_packed_texels(packed(Storage::Unorm8), writer);
    for (const auto& [layers, texels] : {std::pair{2U, 4U}, {3U, 3U}, {1U, 6U}, {2U, 2U}}) {
        ByteReader reader(writer.data(), "texels");
        PackedTexels back;
        back.storage = Storage::Unorm8;
        EXPECT_THROW(read_packed_texels(reader, layers, texels, back), Error) << layers << " " << texels;
    }
}

}  // namespace
}  // namespace rowland::diffraction
