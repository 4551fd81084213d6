#include "modules/diffraction/asset/cooked_material.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/parallel.h"

namespace rowland::diffraction {
namespace {

nlohmann::json small_material() {
    return nlohmann::json::parse(R"({
        "grating": { "pitch_nm": 1600, "profile": { "type": "slit", "width_nm": 800 } },
        "quality": { "representation": "spikes", "bands": 3, "spikes": 2, "view_resolution": 4 } })");
}

std::vector<std::byte> cook(const nlohmann::json& json) {
    return write_cooked_material(json, cook_material(json, "m.json"));
}

TEST(CookedMaterial, RoundTripKeepsMaterialAndTable) {
    const nlohmann::json json = small_material();
    const CookedMaterial original = cook_material(json, "m.json");
    const CookedMaterial read = read_cooked_material(write_cooked_material(json, original), "m.material");
    EXPECT_EQ(read.material.grating.pitch_nm, 1600.0);
    EXPECT_EQ(read.table.texels, original.table.texels);
    EXPECT_EQ(read.table.scale, original.table.scale);
    EXPECT_EQ(read.table.bias, original.table.bias);
    EXPECT_EQ(read.table.bands, 3);
    EXPECT_EQ(read.table.spikes, 2);
}

TEST(CookedMaterial, BytesDoNotDependOnTheNumberOfThreads) {
    std::vector<std::byte> one;
    {
        const ThreadLimit limit(1);
        one = cook(small_material());
    }
    const ThreadLimit limit(2);
    EXPECT_EQ(one, cook(small_material()));
    EXPECT_EQ(one, cook(small_material()));
}

TEST(CookedMaterial, EveryTruncationIsRefused) {
    const std::vector<std::byte> bytes = cook(small_material());
    for (std::size_t size = 0; size < bytes.size(); size += size < 400 ? 1 : 97)
        EXPECT_THROW(read_cooked_material(std::span(bytes).first(size), "m.material"), Error) << size;
}

TEST(CookedMaterial, TrailingBytesAreRefused) {
    std::vector<std::byte> bytes = cook(small_material());
    bytes.push_back(std::byte{0});
    EXPECT_THROW(read_cooked_material(bytes, "m.material"), Error);
}

TEST(CookedMaterial, FewGroovesAreRefusedByFileAndPlace) {
    nlohmann::json json = small_material();
    json["grating"]["grooves"] = 7;
    try {
        cook_material(json, "few.json");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.info().file, "few.json");
        EXPECT_EQ(error.info().place, "/grating/grooves");
    }
}

TEST(CookedMaterial, DescriptionShowsWhatWasBaked) {
    nlohmann::json json = small_material();
    EXPECT_NE(describe(cook_material(json, "m")).find("spikes: 2\n"), std::string::npos);
    json["quality"]["spikes"] = 5;
    EXPECT_NE(describe(cook_material(json, "m")).find("spikes: 5\n"), std::string::npos);
}

}  // namespace
}  // namespace rowland::diffraction
