#include "modules/diffraction/representations/spikes/spike_table.h"

#include <fmt/format.h>

#include "engine/math/sh_basis.h"

namespace rowland::diffraction {

namespace {

constexpr double kWavelengthRange_nm = colour::kVisibleMax - colour::kVisibleMin;

// Limits for files: far above any use, and small enough that no product of them overflows.
constexpr int kMaximumAngleNodes = 1 << 14;
constexpr int kMaximumSpikes = 512;

/// Storage and mapping are in one byte.
constexpr unsigned kMappingShift = 4;

double normalized(double wavelength_nm) {
    return (wavelength_nm - colour::kVisibleMin) / kWavelengthRange_nm;
}

/// Writes a view's spikes into unquantised texels.
void store(const SpikeSet& spikes, const SpikeTable& table, std::size_t texel, std::vector<double>& values) {
    const std::size_t texels_per_layer = table.grid().texels();
    const auto count = static_cast<std::size_t>(math::sh_count(table.bands));
    for (std::size_t k = 0; k < spikes.wavelengths_nm.size(); ++k) {
        const std::size_t first_layer = k * static_cast<std::size_t>(table.layers_per_spike);
        const auto put = [&](std::size_t entry, double value) {
            const std::size_t layer = first_layer + entry / kTexelComponents;
            values[(layer * texels_per_layer + texel) * kTexelComponents + entry % kTexelComponents] = value;
        };
        for (std::size_t i = 0; i < count; ++i) put(i, spikes.coefficients[k * count + i]);
        put(count, normalized(spikes.wavelengths_nm[k]));
    }
}

SpikeSet mirrored(SpikeSet spikes, std::span<const double> signs) {
    for (std::size_t i = 0; i < spikes.coefficients.size(); ++i) spikes.coefficients[i] *= signs[i % signs.size()];
    return spikes;
}

}  // namespace

SpikeTable bake(const Grating& grating, const SpikeTableSettings& settings) {
    SpikeTable table;
    table.bands = settings.spikes.bands;
    table.spikes = settings.spikes.spikes;
    table.theta_nodes = settings.theta_nodes;
    table.phi_nodes = settings.phi_nodes;
    table.layers_per_spike = spike_layers(table.bands);
    table.storage = settings.storage;
    table.mapping = settings.mapping;
    const ViewGrid grid = table.grid();
    check_view_grid(grid, grating);

    const SpikeBaker baker(grating, settings.spikes);
    const std::vector<double> signs = mirror_signs(table.bands);
    std::vector<double> values(static_cast<std::size_t>(table.layers()) * grid.texels() * kTexelComponents, 0.0);
    for_each_view("baking spikes", grid, grating, [&](const glm::dvec2& view, std::size_t texel, std::size_t mirror) {
        const SpikeSet spikes = baker.bake(view.x, view.y);
        store(spikes, table, texel, values);
        if (mirror != texel) store(mirrored(spikes, signs), table, mirror, values);
    });
    pack(values, static_cast<std::size_t>(table.layers()), table);
    return table;
}

SpikeSet sample(const SpikeTable& table, double v_g, double v_h, double v_n) {
    const BilinearLookup lookup = look_up(table.grid(), v_g, v_h, v_n);
    const std::size_t texels_per_layer = table.grid().texels();
    const auto entry = [&](std::size_t spike, std::size_t i) {
        const std::size_t layer = spike * static_cast<std::size_t>(table.layers_per_spike) + i / kTexelComponents;
        return filtered(table, layer, texels_per_layer, i % kTexelComponents, lookup);
    };

    const auto count = static_cast<std::size_t>(math::sh_count(table.bands));
    SpikeSet result{.bands = table.bands, .wavelengths_nm = {}, .coefficients = {}};
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.spikes); ++k) {
        for (std::size_t i = 0; i < count; ++i) result.coefficients.push_back(v_n > 0.0 ? entry(k, i) : 0.0);
        result.wavelengths_nm.push_back(colour::kVisibleMin + kWavelengthRange_nm * entry(k, count));
    }
    return result;
}

void write(const SpikeTable& table, ByteWriter& writer) {
    writer.value<std::int32_t>(table.bands);
    writer.value<std::int32_t>(table.spikes);
    writer.value<std::int32_t>(table.theta_nodes);
    writer.value<std::int32_t>(table.phi_nodes);
    writer.value(static_cast<std::uint8_t>(static_cast<unsigned>(table.storage) | static_cast<unsigned>(table.mapping)
                                                                                      << kMappingShift));
    write_packed_texels(table, writer);
}

SpikeTable read_spike_table(ByteReader& reader) {
    SpikeTable table;
    table.bands = read_count(reader, "bands", 1, math::kMaximumBands);
    table.spikes = read_count(reader, "spikes", 1, kMaximumSpikes);
    table.theta_nodes = read_count(reader, "theta nodes", 1, kMaximumAngleNodes);
    table.phi_nodes = read_count(reader, "phi nodes", 1, kMaximumAngleNodes);
    table.layers_per_spike = spike_layers(table.bands);
    const auto choices = reader.value<std::uint8_t>();
    table.storage = to_storage(reader, choices & ((1U << kMappingShift) - 1U));
    table.mapping = to_view_mapping(reader, choices >> kMappingShift);
    if (!is_valid(table.grid()))
        reader.fail(fmt::format("{} x {} nodes", table.phi_nodes, table.theta_nodes),
                    fmt::format("a {} table's", view_mapping_name(table.mapping)));
    read_packed_texels(reader, static_cast<std::size_t>(table.layers()), table.grid().texels(), table);
    return table;
}

const RepresentationInfo& SpikeTableSettings::info() {
    static const RepresentationInfo info{
        .name = "spikes",
        .summary = "the paper's: a few wavelengths for each view, light as SH at the vertices",
        .lattices = true,
        .takes_harmonics = true,
        .key_lights = KeyLightUse::OnRequest,
        .settings = {bands_setting({2, 3, 4, 6, 8, 10, 12, 16}, {3, 5, 8}),
                     {.key = "spikes",
                      .label = "Spikes",
                      .help = "Wavelengths of the composite model for each view.",
                      .minimum = 1,
                      .maximum = 64,
                      .default_value = SpikeSettings().spikes,
                      .sweep = {1, 2, 3, 6, 8, 12, 16},
                      .details = {4, 4, 8}},
                     view_mapping_setting(),
                     view_resolution_setting({8, 16, 64, 128}),
                     storage_setting(SpikeTableSettings().storage, {"fp32", "fp16", "unorm8"})},
        .editor_start = {"bands", "spikes"},
        .sweep_tier = "bands=5/spikes=4/view_resolution=32/storage=unorm16/view_mapping=spherical",
        .sweep_key_lights = {4, 8, 16, 32, 64},
        .sweep_windows = {math::SphericalWindow::Lanczos, math::SphericalWindow::Hann},
        .sweep_more = {"bands=5/spikes=4/view_resolution=64/storage=unorm16/view_mapping=parabolic",
                       "bands=5/spikes=4/view_resolution=256/storage=unorm16/view_mapping=one-dimensional"},
        .budget = [](bool flat_lobe, SurfaceShape) -> std::vector<std::string> {
            if (!flat_lobe) return {"bands=5/spikes=4"};
            return {"bands=5/spikes=4", "bands=5/spikes=8", "bands=5/spikes=16"};
        }};
    return info;
}

std::optional<Refusal> SpikeTableSettings::refusal(const SettingValues& values, const Grating& grating) {
    if (auto refused = view_grid_refusal(values, grating)) return refused;
    return layer_refusal("spikes", values.number("spikes") * spike_layers(values.number("bands")));
}

SpikeTableSettings SpikeTableSettings::from(const SettingValues& values, const Grating&) {
    SpikeTableSettings settings;
    const ViewGrid grid =
        view_grid(values, {.mapping = settings.mapping, .columns = settings.phi_nodes, .rows = settings.theta_nodes});
    settings.spikes.bands = values.number("bands");
    settings.spikes.spikes = values.number("spikes");
    settings.mapping = grid.mapping;
    settings.phi_nodes = grid.columns;
    settings.theta_nodes = grid.rows;
    settings.storage = values.storage();
    return settings;
}

SpikeTable read(ByteReader& reader, const SpikeTableSettings& settings) {
    SpikeTable table = read_spike_table(reader);
    const ViewGrid grid{.mapping = settings.mapping, .columns = settings.phi_nodes, .rows = settings.theta_nodes};
    require_as_asked(reader, table.bands == settings.spikes.bands && table.spikes == settings.spikes.spikes &&
                                 table.grid() == grid && table.storage == settings.storage);
    return table;
}

ShadingCost cost(const SpikeTable& table) {
    const int coefficients = math::sh_count(table.bands);
    return {.fetches_per_vertex = table.layers() + 3 * table.spikes,
            .multiply_adds_per_vertex = 4 * table.layers() + 3 * table.spikes * coefficients + 9 * table.spikes,
            .table_bytes = table.bytes(),
            .vertex_bytes = harmonics_bytes(table.bands)};
}

Facts facts(const SpikeTable& table) {
    return with_view_table({{"bands", fmt::to_string(table.bands)}, {"spikes", fmt::to_string(table.spikes)}},
                           table.grid(), table);
}

}  // namespace rowland::diffraction
