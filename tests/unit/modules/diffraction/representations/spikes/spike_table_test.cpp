#include "modules/diffraction/representations/spikes/spike_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/math/sh_rotation.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

using std::numbers::pi;

Grating foil() {
    Grating grating;
    grating.pitch_nm = 1000.0;
    grating.profile = BlazedProfile{150.0};
    grating.lobe = GaussianLobe{0.3};
    return grating;
}

SpikeTableSettings small(Storage storage) {
    SpikeTableSettings settings;
    settings.theta_nodes = 5;
    settings.phi_nodes = 8;
    settings.spikes.spikes = 3;
    settings.spikes.bands = 4;
    settings.storage = storage;
    return settings;
}

/// Half a step of 16 bits over the component's range; a half float in [−1, 1] has 11 bits, so half a step is 2⁻¹² of
/// half the range.
double largest_storage_error(const SpikeTable& table, std::size_t layer, glm::vec4::length_type component) {
    const double scale = static_cast<double>(table.scale[layer][component]);
    const double bias = std::abs(static_cast<double>(table.bias[layer][component]));
    const double float_rounding = 1e-6 * (scale + bias);
    return (table.storage == Storage::Half ? scale / 4096.0 : 0.5 * scale / 65535.0) + float_rounding;
}

TEST(SpikeTable, NodesAreTheBakedSpikesWithinStorage) {
    for (const Storage storage : {Storage::Unorm16, Storage::Half}) {
        const SpikeTableSettings settings = small(storage);
        const SpikeTable table = bake(foil(), settings);
        for (int i = 0; i < settings.theta_nodes; ++i)
            for (int j = 0; j < settings.phi_nodes; ++j) {
                const double theta = 0.5 * pi * i / (settings.theta_nodes - 1);
                const double phi = 2.0 * pi * j / settings.phi_nodes;
                const glm::dvec3 v(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                   std::max(std::cos(theta), 1e-9));
                const SpikeSet exact = bake_spikes(foil(), v.x, v.y, settings.spikes);
                const SpikeSet stored = sample(table, v.x, v.y, v.z);
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t layers = static_cast<std::size_t>(table.layers_per_spike);
                    for (std::size_t e = 0; e < 16; ++e)
                        EXPECT_NEAR(stored.coefficients[k * 16 + e], exact.coefficients[k * 16 + e],
                                    largest_storage_error(table, k * layers + e / 4, static_cast<int>(e % 4)));
                    EXPECT_NEAR(stored.wavelengths_nm[k], exact.wavelengths_nm[k],
                                400.0 * largest_storage_error(table, k * layers + 4, 0));
                }
            }
    }
}

TEST(SpikeTable, HasTheLayoutTheShaderReads) {
    const SpikeTableSettings settings = small(Storage::Unorm16);
    const SpikeTable table = bake(foil(), settings);
    EXPECT_EQ(table.layers_per_spike, 5);  // 16 coefficients and a wavelength: 17 entries in fours
    EXPECT_EQ(table.layers(), 15);
    EXPECT_EQ(table.texels.size(), 15U * 5U * 8U * 4U);
    EXPECT_EQ(table.scale.size(), 15U);
    // Spike 2, coefficient 6, row 3, column 1: layer 2·5 + 1, component 2.
    const double theta = 0.5 * pi * 3 / 4;
    const double phi = 2.0 * pi / 8;
    const SpikeSet exact =
        bake_spikes(foil(), std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), settings.spikes);
    const std::size_t layer = 11;
    const double stored = table.texels[((layer * 5 + 3) * 8 + 1) * 4 + 2] / 65535.0;
    EXPECT_NEAR(stored * static_cast<double>(table.scale[layer][2]) + static_cast<double>(table.bias[layer][2]),
                exact.coefficients[2 * 16 + 6], largest_storage_error(table, layer, 2));
}

TEST(SpikeTable, FiltersLinearlyBetweenNodesAndAcrossTheSeam) {
    const SpikeTable table = bake(foil(), small(Storage::Unorm16));
    const double theta = 0.5 * pi * 2 / 4;
    const auto at = [&](double phi) {
        return sample(table, std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    };
    // A quarter of the way from column 7 to column 0, across φ = 2π.
    const double step = 2.0 * pi / 8;
    const SpikeSet between = at(7.25 * step);
    const SpikeSet left = at(7.0 * step);
    const SpikeSet right = at(0.0);
    for (std::size_t i = 0; i < between.coefficients.size(); ++i)
        EXPECT_NEAR(between.coefficients[i], 0.75 * left.coefficients[i] + 0.25 * right.coefficients[i], 1e-12);
}

TEST(SpikeTable, ViewBelowTheHorizonIsBlack) {
    const SpikeTable table = bake(foil(), small(Storage::Unorm16));
    const SpikeSet spikes = sample(table, 0.6, 0.0, -0.8);
    for (const double c : spikes.coefficients) EXPECT_EQ(c, 0.0);
    for (const double wavelength_nm : spikes.wavelengths_nm) EXPECT_TRUE(std::isfinite(wavelength_nm));
}

TEST(SpikeTable, BytesDoNotDependOnTheNumberOfThreads) {
    const auto bytes = [](unsigned threads) {
        const ThreadLimit limit(threads);
        ByteWriter writer;
        write(bake(foil(), small(Storage::Unorm16)), writer);
        return writer.take();
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

/// The default table on the named frames, under the oracle's light: 0.05 % on real probes (measured), 0.5 % allowed.
TEST(SpikeTable, DefaultResolutionKeepsTheNamedFrames) {
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    Grating disc;
    disc.pitch_nm = 1600.0;
    disc.profile = SlitProfile{800.0};
    const SpikeTable table = bake(disc, SpikeTableSettings());
    const SpikeBaker baker(disc, SpikeSettings());
    std::vector<glm::dvec3> exact;
    std::vector<glm::dvec3> sampled;
    for (const ShadingPoint& frame : test::read_frames(rowland::test::read_csv(frames_path))) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        lighting::ShLight rotated{5, std::vector<glm::dvec3>(25)};
        math::ShRotation(tangent, 5)
            .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(rotated.coefficients));
        const glm::dvec3 v = tangent * glm::normalize(frame.view);
        exact.push_back(evaluate_spikes(baker.bake(v.x, v.y), rotated));
        sampled.push_back(evaluate_spikes(sample(table, v.x, v.y, v.z), rotated));
    }
    EXPECT_LT(test::relative_rms(sampled, exact), 0.005);
}

/// The other mappings and storages, with one test's words: a node is its own view, a row of v_g for the flat lobe.
TEST(SpikeTable, TakesEveryMappingAndStorage) {
    for (const Storage storage : {Storage::Unorm16, Storage::Half, Storage::Float, Storage::Unorm8}) {
        SpikeTableSettings settings = small(storage);
        settings.mapping = ViewMapping::Parabolic;
        const SpikeTable table = bake(foil(), settings);
        const glm::dvec2 v = node_view(table.grid(), 5, 1);
        const SpikeSet exact = bake_spikes(foil(), v.x, v.y, settings.spikes);
        const SpikeSet stored = sample(table, v.x, v.y, std::sqrt(1.0 - glm::dot(v, v)));
        for (std::size_t i = 0; i < exact.coefficients.size(); ++i) {
            const auto layer = i / 16 * static_cast<std::size_t>(table.layers_per_spike) + i % 16 / 4;
            const double range = static_cast<double>(table.scale[layer][static_cast<int>(i % 4)]);
            EXPECT_NEAR(stored.coefficients[i], exact.coefficients[i],
                        storage == Storage::Unorm8  ? 0.51 / 255.0 * range
                        : storage == Storage::Float ? 1e-7
                                                    : 3e-4 * range);
        }
        ByteWriter writer;
        write(table, writer);
        ByteReader reader(writer.data(), "table");
        const SpikeTable back = read_spike_table(reader);
        EXPECT_EQ(back.mapping, ViewMapping::Parabolic);
        EXPECT_EQ(back.storage, storage);
        EXPECT_EQ(back.texels, table.texels);
    }
    SpikeTableSettings line = small(Storage::Float);
    line.mapping = ViewMapping::OneDimensional;
    line.theta_nodes = 1;
    EXPECT_THROW(bake(foil(), line), Error);
}

std::vector<std::byte> written(const SpikeTable& table) {
    ByteWriter writer;
    write(table, writer);
    return writer.take();
}

TEST(SpikeTable, RoundTripsThroughBytes) {
    const SpikeTable table = bake(foil(), small(Storage::Half));
    const auto bytes = written(table);
    ByteReader reader(bytes, "table");
    const SpikeTable back = read_spike_table(reader);
    EXPECT_EQ(reader.remaining(), 0U);
    EXPECT_EQ(written(back), bytes);
    EXPECT_EQ(back.layers_per_spike, table.layers_per_spike);
    EXPECT_EQ(sample(back, 0.3, 0.2, 0.9).coefficients, sample(table, 0.3, 0.2, 0.9).coefficients);
}

TEST(SpikeTable, RefusesEveryTruncation) {
    const auto bytes = written(bake(foil(), small(Storage::Unorm16)));
    for (std::size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 97) {
        const std::span<const std::byte> all(bytes);
        ByteReader reader(all.first(size), "table");
        EXPECT_THROW(read_spike_table(reader), Error) << size;
    }
}

/// Each 32-bit word of the header set to something wild: refused, or a table whose sizes agree.
TEST(SpikeTable, RefusesAWrongHeader) {
    const auto bytes = written(bake(foil(), small(Storage::Unorm16)));
    for (std::size_t at = 0; at < 16; at += 4)
        for (const std::int32_t wild : {-1, 0, 1 << 14, 0x7fffffff}) {
            auto broken = bytes;
            std::memcpy(broken.data() + at, &wild, sizeof wild);
            ByteReader reader(broken, "table");
            EXPECT_THROW(read_spike_table(reader), Error) << at << " " << wild;
        }
    auto broken = bytes;
    broken[16] = std::byte{7};
    ByteReader reader(broken, "table");
    EXPECT_THROW(read_spike_table(reader), Error);
}

TEST(SpikeTable, RefusesScalesThatAreNotFinite) {
    SpikeTable table = bake(foil(), small(Storage::Unorm16));
    table.scale[3].y = std::numeric_limits<float>::infinity();
    const auto bytes = written(table);
    ByteReader reader(bytes, "table");
    EXPECT_THROW(read_spike_table(reader), Error);
}

}  // namespace
}  // namespace rowland::diffraction
