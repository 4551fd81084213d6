#include "modules/diffraction/representations/transfer/transfer_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/bake/view_spectrum.h"

namespace rowland::diffraction {

namespace {

constexpr std::size_t kColours = 9;  ///< pairs of a light's channel and a tristimulus

}  // namespace

TransferTable bake(const Grating& grating, const TransferSettings& settings) {
    TransferTable table;
    table.bands = settings.bands;
    table.grid = settings.grid.value_or(default_view_grid(grating));
    table.storage = settings.storage;
    check_view_grid(table.grid, grating);

    const TransferTerms terms(grating, colour::LightSpectra(settings.illuminant), table.bands);
    const std::vector<double> signs = mirror_signs(table.bands);
    const auto blocks = static_cast<std::size_t>(harmonic_layers(table.bands));
    const std::size_t texels = table.grid.texels();
    std::vector<double> values(kColours * blocks * texels * kTexelComponents, 0.0);
    for_each_view(
        "baking transfer", table.grid, grating, [&](const glm::dvec2& view, std::size_t texel, std::size_t mirror) {
            const std::vector<glm::dmat3> coefficients = terms.coefficients(view.x, view.y);
            for (std::size_t pair = 0; pair < kColours; ++pair)
                for (std::size_t i = 0; i < coefficients.size(); ++i) {
                    const std::size_t layer = pair * blocks + i / kTexelComponents;
                    const double value = coefficients[i][static_cast<int>(pair / 3)][static_cast<int>(pair % 3)];
                    const auto at = [&](std::size_t t) -> double& {
                        return values[(layer * texels + t) * kTexelComponents + i % kTexelComponents];
                    };
                    at(texel) = value;
                    if (mirror != texel) at(mirror) = signs[i] * value;
                }
        });
    pack(values, kColours * blocks, table);
    return table;
}

glm::dvec3 evaluate(const TransferTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view) {
    glm::dvec3 xyz(0.0);
    if (!(view.z > 0.0)) return xyz;
    const BilinearLookup lookup = look_up(table.grid, view.x, view.y, view.z);
    const auto blocks = static_cast<std::size_t>(harmonic_layers(table.bands));
    const std::size_t common =
        std::min(static_cast<std::size_t>(math::sh_count(table.bands)), tangent_light.coefficients.size());
    for (std::size_t pair = 0; pair < kColours; ++pair)
        for (std::size_t i = 0; i < common; ++i)
            xyz[static_cast<int>(pair % 3)] += tangent_light.coefficients[i][static_cast<int>(pair / 3)] *
                                               filtered(table, pair * blocks + i / kTexelComponents,
                                                        table.grid.texels(), i % kTexelComponents, lookup);
    return xyz;
}

void write(const TransferTable& table, ByteWriter& writer) {
    writer.value<std::int32_t>(table.bands);
    write_view_grid(table.grid, writer);
    writer.value(static_cast<std::uint8_t>(table.storage));
    write_packed_texels(table, writer);
}

TransferTable read_transfer_table(ByteReader& reader) {
    TransferTable table;
    table.bands = read_count(reader, "bands", 1, math::kMaximumBands);
    table.grid = read_view_grid(reader);
    table.storage = to_storage(reader, reader.value<std::uint8_t>());
    read_packed_texels(reader, kColours * static_cast<std::size_t>(harmonic_layers(table.bands)), table.grid.texels(),
                       table);
    return table;
}

const RepresentationInfo& TransferSettings::info() {
    static const RepresentationInfo info{
        .name = "transfer",
        .summary = "wavelengths summed beforehand, light as SH at the vertices",
        .lattices = true,
        .takes_harmonics = true,
        .key_lights = KeyLightUse::OnRequest,
        .settings = {bands_setting(), view_mapping_setting(), view_resolution_setting(),
                     storage_setting(TransferSettings().storage)},
        .budget = [](bool flat_lobe, SurfaceShape) -> std::vector<std::string> {
            if (!flat_lobe) return {"bands=5"};
            return {"bands=3", "bands=5", "bands=8"};
        }};
    return info;
}

std::optional<Refusal> TransferSettings::refusal(const SettingValues& values, const Grating& grating) {
    return view_grid_refusal(values, grating);
}

TransferSettings TransferSettings::from(const SettingValues& values, const Grating& grating) {
    return {.bands = values.number("bands"),
            .grid = view_grid(values, default_view_grid(grating)),
            .storage = values.storage()};
}

TransferTable read(ByteReader& reader, const TransferSettings& settings) {
    TransferTable table = read_transfer_table(reader);
    require_as_asked(reader, table.bands == settings.bands && (!settings.grid || table.grid == *settings.grid) &&
                                 table.storage == settings.storage);
    return table;
}

ShadingCost cost(const TransferTable& table) {
    const int layers = 9 * harmonic_layers(table.bands);
    return {.fetches_per_vertex = layers,
            .multiply_adds_per_vertex = 8 * layers,
            .table_bytes = table.bytes(),
            .vertex_bytes = harmonics_bytes(table.bands)};
}

Facts facts(const TransferTable& table) {
    return with_view_table({{"bands", fmt::to_string(table.bands)}}, table.grid, table);
}

}  // namespace rowland::diffraction
