#include "modules/diffraction/bake/spike_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/math/sh_basis.h"

namespace rowland::diffraction {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWavelengthRange_nm = colour::kVisibleMax - colour::kVisibleMin;
constexpr int kComponents = 4;

// Bounds on what a file may claim; far above any use, and small enough that no product of them overflows.
constexpr int kMaximumNodes = 1 << 14;
constexpr int kMaximumSpikes = 512;

/// Where an entry of a view's list lies in the texels.
struct Layout {
    explicit Layout(const SpikeTable& table)
        : theta_nodes(static_cast<std::size_t>(table.theta_nodes)),
          phi_nodes(static_cast<std::size_t>(table.phi_nodes)),
          texels_per_layer(theta_nodes * phi_nodes) {}

    std::size_t index(std::size_t layer, std::size_t row, std::size_t column, std::size_t component) const {
        return (layer * texels_per_layer + row * phi_nodes + column) * kComponents + component;
    }

    std::size_t theta_nodes;
    std::size_t phi_nodes;
    std::size_t texels_per_layer;
};

double normalized(double wavelength_nm) {
    return (wavelength_nm - colour::kVisibleMin) / kWavelengthRange_nm;
}

/// Writes a view's spikes into unquantised texels.
void store(const SpikeSet& spikes, const SpikeTable& table, std::size_t row, std::size_t column,
           std::vector<double>& values) {
    const Layout layout(table);
    const auto count = static_cast<std::size_t>(math::sh_count(table.bands));
    for (std::size_t k = 0; k < spikes.wavelengths_nm.size(); ++k) {
        const std::size_t first_layer = k * static_cast<std::size_t>(table.layers_per_spike);
        const auto put = [&](std::size_t entry, double value) {
            values[layout.index(first_layer + entry / kComponents, row, column, entry % kComponents)] = value;
        };
        for (std::size_t i = 0; i < count; ++i) put(i, spikes.coefficients[k * count + i]);
        put(count, normalized(spikes.wavelengths_nm[k]));
    }
}

/// The view (v_g, −v_h): every lobe is even in s_h + v_h, so what changes is the sign of the functions odd in h, m < 0.
SpikeSet mirrored(SpikeSet spikes) {
    const auto count = static_cast<std::size_t>(math::sh_count(spikes.bands));
    for (std::size_t k = 0; k < spikes.wavelengths_nm.size(); ++k)
        for (int l = 0; l < spikes.bands; ++l)
            for (int m = -l; m < 0; ++m) {
                double& c = spikes.coefficients[k * count + static_cast<std::size_t>(math::sh_index(l, m))];
                c = -c;
            }
    return spikes;
}

std::uint16_t encode(double value, float scale, float bias, Storage storage) {
    if (scale == 0.0F) return 0;
    const double stored = (value - static_cast<double>(bias)) / static_cast<double>(scale);
    if (storage == Storage::Half) return glm::packHalf1x16(static_cast<float>(std::clamp(stored, -1.0, 1.0)));
    return static_cast<std::uint16_t>(std::lround(std::clamp(stored, 0.0, 1.0) * 65535.0));
}

double decode(std::uint16_t stored, float scale, float bias, Storage storage) {
    const double value = storage == Storage::Half ? static_cast<double>(glm::unpackHalf1x16(stored)) : stored / 65535.0;
    return value * static_cast<double>(scale) + static_cast<double>(bias);
}

/// Chooses scale and bias per layer and component and rounds the texels to 16 bits. Unorm16 spans [minimum, maximum];
/// half floats span the same as [−1, 1], where they are finest about 0.
void quantize(const std::vector<double>& values, SpikeTable& table) {
    const Layout layout(table);
    const auto layers = static_cast<std::size_t>(table.layers());
    table.scale.assign(layers, glm::vec4(0.0F));
    table.bias.assign(layers, glm::vec4(0.0F));
    table.texels.assign(values.size(), 0);
    for (std::size_t layer = 0; layer < layers; ++layer) {
        for (std::size_t component = 0; component < kComponents; ++component) {
            double minimum = values[layout.index(layer, 0, 0, component)];
            double maximum = minimum;
            const auto each = [&](const auto& use) {
                for (std::size_t texel = 0; texel < layout.texels_per_layer; ++texel)
                    use((layer * layout.texels_per_layer + texel) * kComponents + component);
            };
            each([&](std::size_t i) {
                minimum = std::min(minimum, values[i]);
                maximum = std::max(maximum, values[i]);
            });
            const bool half = table.storage == Storage::Half;
            const auto bias = static_cast<float>(half ? 0.5 * (minimum + maximum) : minimum);
            const auto scale = static_cast<float>(half ? 0.5 * (maximum - minimum) : maximum - minimum);
            const auto c = static_cast<glm::vec4::length_type>(component);
            table.bias[layer][c] = bias;
            table.scale[layer][c] = scale;
            each([&](std::size_t i) { table.texels[i] = encode(values[i], scale, bias, table.storage); });
        }
    }
}

/// One axis of a bilinear lookup: the two nodes and the second one's share.
struct Neighbours {
    std::size_t first = 0;
    std::size_t second = 0;
    double share = 0.0;
};

/// GL_LINEAR at a coordinate in units of texels (a texel's centre is at index + ½).
Neighbours clamped_neighbours(double texel, std::size_t count) {
    const double position = std::clamp(texel - 0.5, 0.0, static_cast<double>(count - 1));
    const auto first = static_cast<std::size_t>(position);
    return {first, std::min(first + 1, count - 1), position - static_cast<double>(first)};
}

Neighbours repeated_neighbours(double texel, std::size_t count) {
    const double n = static_cast<double>(count);
    double position = std::fmod(texel - 0.5, n);
    if (position < 0.0) position += n;
    const auto first = std::min(static_cast<std::size_t>(position), count - 1);
    return {first, (first + 1) % count, position - static_cast<double>(first)};
}

int read_count(ByteReader& reader, const char* what, int minimum, int maximum) {
    const auto value = reader.value<std::int32_t>();
    if (value < minimum || value > maximum)
        reader.fail(fmt::format("{} {}", what, value), fmt::format("{} in [{}, {}]", what, minimum, maximum));
    return value;
}

std::vector<glm::vec4> read_vectors(ByteReader& reader, const char* what, int count) {
    auto values = reader.array<glm::vec4>();
    if (values.size() != static_cast<std::size_t>(count))
        reader.fail(fmt::format("{} entries of {}", values.size(), what), fmt::format("{}, one a layer", count));
    for (const glm::vec4& value : values)
        for (glm::vec4::length_type c = 0; c < kComponents; ++c)
            if (!std::isfinite(value[c])) reader.fail(fmt::format("a {} that is not finite", what), "finite numbers");
    return values;
}

}  // namespace

SpikeTable bake_spike_table(const Grating& grating, const SpikeTableSettings& settings) {
    ROWLAND_CHECK_OP(settings.theta_nodes, >=, 2);
    ROWLAND_CHECK_OP(settings.phi_nodes, >=, 1);
    SpikeTable table;
    table.bands = settings.spikes.bands;
    table.spikes = settings.spikes.spikes;
    table.theta_nodes = settings.theta_nodes;
    table.phi_nodes = settings.phi_nodes;
    table.layers_per_spike = spike_layers(table.bands);
    table.storage = settings.storage;

    const SpikeBaker baker(grating, settings.spikes);
    const Layout layout(table);
    std::vector<double> values(static_cast<std::size_t>(table.layers()) * layout.texels_per_layer * kComponents, 0.0);
    // Columns j and phi_nodes − j are mirror images.
    const std::size_t half_columns = layout.phi_nodes / 2 + 1;
    Progress progress("baking spikes", layout.theta_nodes * half_columns);
    parallel_for(layout.theta_nodes * half_columns, [&](std::size_t i) {
        const std::size_t row = i / half_columns;
        const std::size_t column = i % half_columns;
        const double theta = 0.5 * kPi * static_cast<double>(row) / static_cast<double>(layout.theta_nodes - 1);
        const double phi = 2.0 * kPi * static_cast<double>(column) / static_cast<double>(layout.phi_nodes);
        const SpikeSet spikes = baker.bake(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi));
        store(spikes, table, row, column, values);
        const std::size_t mirror = (layout.phi_nodes - column) % layout.phi_nodes;
        if (mirror != column) store(mirrored(spikes), table, row, mirror, values);
        progress.advance();
    });
    quantize(values, table);
    return table;
}

SpikeSet sample(const SpikeTable& table, double v_g, double v_h, double v_n) {
    const Layout layout(table);
    const double theta = std::atan2(std::hypot(v_g, v_h), v_n);
    const double phi = std::atan2(v_h, v_g);
    const Neighbours columns =
        repeated_neighbours(phi / (2.0 * kPi) * static_cast<double>(layout.phi_nodes) + 0.5, layout.phi_nodes);
    const Neighbours rows =
        clamped_neighbours(theta / (0.5 * kPi) * static_cast<double>(layout.theta_nodes - 1) + 0.5, layout.theta_nodes);

    const auto entry = [&](std::size_t spike, std::size_t i) {
        const std::size_t layer = spike * static_cast<std::size_t>(table.layers_per_spike) + i / kComponents;
        const auto c = static_cast<glm::vec4::length_type>(i % kComponents);
        const auto texel = [&](std::size_t row, std::size_t column) {
            return decode(table.texels[layout.index(layer, row, column, i % kComponents)], table.scale[layer][c],
                          table.bias[layer][c], table.storage);
        };
        const auto in_row = [&](std::size_t row) {
            return std::lerp(texel(row, columns.first), texel(row, columns.second), columns.share);
        };
        return std::lerp(in_row(rows.first), in_row(rows.second), rows.share);
    };

    const auto count = static_cast<std::size_t>(math::sh_count(table.bands));
    SpikeSet result{.bands = table.bands, .wavelengths_nm = {}, .coefficients = {}};
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.spikes); ++k) {
        for (std::size_t i = 0; i < count; ++i) result.coefficients.push_back(v_n > 0.0 ? entry(k, i) : 0.0);
        result.wavelengths_nm.push_back(colour::kVisibleMin + kWavelengthRange_nm * entry(k, count));
    }
    return result;
}

void write_spike_table(const SpikeTable& table, ByteWriter& writer) {
    writer.value<std::int32_t>(table.bands);
    writer.value<std::int32_t>(table.spikes);
    writer.value<std::int32_t>(table.theta_nodes);
    writer.value<std::int32_t>(table.phi_nodes);
    writer.value<std::uint8_t>(static_cast<std::uint8_t>(table.storage));
    writer.array(std::span<const glm::vec4>(table.scale));
    writer.array(std::span<const glm::vec4>(table.bias));
    writer.array(std::span<const std::uint16_t>(table.texels));
}

SpikeTable read_spike_table(ByteReader& reader) {
    SpikeTable table;
    table.bands = read_count(reader, "bands", 1, math::kMaximumBands);
    table.spikes = read_count(reader, "spikes", 1, kMaximumSpikes);
    table.theta_nodes = read_count(reader, "theta nodes", 2, kMaximumNodes);
    table.phi_nodes = read_count(reader, "phi nodes", 1, kMaximumNodes);
    table.layers_per_spike = spike_layers(table.bands);
    const auto storage = reader.value<std::uint8_t>();
    if (storage > static_cast<std::uint8_t>(Storage::Half))
        reader.fail(fmt::format("storage {}", storage), "0 (unorm16) or 1 (half)");
    table.storage = static_cast<Storage>(storage);
    table.scale = read_vectors(reader, "scale", table.layers());
    table.bias = read_vectors(reader, "bias", table.layers());
    table.texels = reader.array<std::uint16_t>();
    const std::uint64_t expected = static_cast<std::uint64_t>(table.layers()) *
                                   static_cast<std::uint64_t>(table.theta_nodes) *
                                   static_cast<std::uint64_t>(table.phi_nodes) * kComponents;
    if (table.texels.size() != expected)
        reader.fail(fmt::format("{} texel components", table.texels.size()), fmt::format("{}", expected));
    return table;
}

}  // namespace rowland::diffraction
