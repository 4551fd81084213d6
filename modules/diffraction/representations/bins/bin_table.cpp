#include "modules/diffraction/representations/bins/bin_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "engine/colour/light_spectra.h"
#include "engine/colour/observer.h"
#include "engine/core/check.h"
#include "engine/math/sh_basis.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/bake/wavelength_cuts.h"

namespace rowland::diffraction {

namespace {

constexpr int kMaximumBins = static_cast<int>(kWavelengths) - 1;

/// One bin: the weights of its wavelengths for the mean of the coefficients, and its colour.
struct Bin {
    std::size_t begin = 0;
    std::vector<double> weights;  ///< from node `begin` on
    glm::dmat3 colour{0.0};
};

std::vector<Bin> make_bins(const colour::LightSpectra& spectra, int count) {
    std::vector<glm::dmat3> observed;
    std::vector<double> sensitivity;
    for (std::size_t j = 0; j < kWavelengths; ++j) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
        const glm::dvec3 cmf = colour::cie_xyz(wavelength_nm);
        observed.push_back(glm::outerProduct(cmf, spectra(wavelength_nm)));
        sensitivity.push_back((cmf.x + cmf.y + cmf.z) * spectra.illuminant().power(wavelength_nm));
    }
    const double largest = *std::max_element(sensitivity.begin(), sensitivity.end());
    // A bin between a lamp's lines also needs a mean.
    for (double& q : sensitivity) q += 1e-9 * largest;

    std::vector<Bin> bins;
    const std::vector<std::size_t> cuts = equal_weight_cuts(sensitivity, count);
    for (std::size_t b = 0; b + 1 < cuts.size(); ++b) {
        Bin bin{.begin = cuts[b], .weights = {}};
        double total = 0.0;
        each_node(cuts[b], cuts[b + 1], [&](std::size_t j, double step) {
            bin.weights.push_back(step * sensitivity[j]);
            bin.colour += step * observed[j];
            total += bin.weights.back();
        });
        for (double& weight : bin.weights) weight /= total;
        bins.push_back(std::move(bin));
    }
    return bins;
}

}  // namespace

BinTable bake(const Grating& grating, const BinSettings& settings) {
    ROWLAND_CHECK(settings.bins >= 1 && settings.bins <= kMaximumBins, "1 to 400 bins");
    check_view_grid(settings.grid, grating);
    BinTable table;
    table.bands = settings.bands;
    table.grid = settings.grid;
    table.storage = settings.storage;
    const std::vector<Bin> bins = make_bins(colour::LightSpectra(settings.illuminant), settings.bins);
    for (const Bin& bin : bins) table.colours.emplace_back(bin.colour);

    const ViewSpectrum spectrum(grating, table.bands);
    const std::vector<double> signs = mirror_signs(table.bands);
    const auto blocks = static_cast<std::size_t>(harmonic_layers(table.bands));
    const std::size_t texels = table.grid.texels();
    std::vector<double> values(bins.size() * blocks * texels * kTexelComponents, 0.0);
    for_each_view("baking bins", table.grid, grating,
                  [&](const glm::dvec2& view, std::size_t texel, std::size_t mirror) {
                      const std::vector<double> coefficients = spectrum.coefficients(view.x, view.y);
                      for (std::size_t b = 0; b < bins.size(); ++b)
                          for (std::size_t i = 0; i < signs.size(); ++i) {
                              double mean = 0.0;
                              for (std::size_t j = 0; j < bins[b].weights.size(); ++j)
                                  mean += bins[b].weights[j] * coefficients[(bins[b].begin + j) * signs.size() + i];
                              const auto at = [&](std::size_t t) -> double& {
                                  return values[((b * blocks + i / kTexelComponents) * texels + t) * kTexelComponents +
                                                i % kTexelComponents];
                              };
                              at(texel) = mean;
                              if (mirror != texel) at(mirror) = signs[i] * mean;
                          }
                  });
    pack(values, bins.size() * blocks, table);
    return table;
}

glm::dvec3 evaluate(const BinTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view) {
    glm::dvec3 xyz(0.0);
    if (!(view.z > 0.0)) return xyz;
    const BilinearLookup lookup = look_up(table.grid, view.x, view.y, view.z);
    const auto blocks = static_cast<std::size_t>(harmonic_layers(table.bands));
    const std::size_t common =
        std::min(static_cast<std::size_t>(math::sh_count(table.bands)), tangent_light.coefficients.size());
    for (std::size_t b = 0; b < table.colours.size(); ++b) {
        glm::dvec3 rgb(0.0);
        for (std::size_t i = 0; i < common; ++i)
            rgb += tangent_light.coefficients[i] * filtered(table, b * blocks + i / kTexelComponents,
                                                            table.grid.texels(), i % kTexelComponents, lookup);
        xyz += glm::dmat3(table.colours[b]) * rgb;
    }
    return xyz;
}

void write(const BinTable& table, ByteWriter& writer) {
    writer.value<std::int32_t>(table.bands);
    write_view_grid(table.grid, writer);
    writer.value(static_cast<std::uint8_t>(table.storage));
    write_matrices(table.colours, writer);
    write_packed_texels(table, writer);
}

BinTable read_bin_table(ByteReader& reader) {
    BinTable table;
    table.bands = read_count(reader, "bands", 1, math::kMaximumBands);
    table.grid = read_view_grid(reader);
    table.storage = to_storage(reader, reader.value<std::uint8_t>());
    table.colours = read_matrices(reader, "colours", 1, kMaximumBins);
    read_packed_texels(reader, table.colours.size() * static_cast<std::size_t>(harmonic_layers(table.bands)),
                       table.grid.texels(), table);
    return table;
}

const RepresentationInfo& BinSettings::info() {
    static const RepresentationInfo info{
        .name = "bins",
        .summary = "fixed wavelength bins, light as SH at the vertices",
        .lattices = true,
        .takes_harmonics = true,
        .in_demo = false,
        .key_lights = KeyLightUse::OnRequest,
        .settings = {bands_setting({3, 8}),
                     {.key = "bins",
                      .label = "Bins",
                      .help = "Fixed wavelength bins.",
                      .minimum = 1,
                      .maximum = 64,
                      .default_value = BinSettings().bins,
                      .sweep = {4, 8, 32}},
                     view_mapping_setting(),
                     view_resolution_setting({16, 64}),
                     storage_setting(BinSettings().storage)},
        .editor_start = {"bands", "bins"},
        .sweep_tier = "bands=5/bins=16/view_resolution=32",
        // Budgets try transfer tables instead: as large as eight bins, with fewer fetches and smaller errors.
        .budget = [](bool, SurfaceShape) { return std::vector<std::string>(); }};
    return info;
}

std::optional<Refusal> BinSettings::refusal(const SettingValues& values, const Grating& grating) {
    if (auto refused = view_grid_refusal(values, grating)) return refused;
    return layer_refusal("bins", values.number("bins") * harmonic_layers(values.number("bands")));
}

BinSettings BinSettings::from(const SettingValues& values, const Grating&) {
    return {.bands = values.number("bands"),
            .bins = values.number("bins"),
            .grid = view_grid(values, BinSettings().grid),
            .storage = values.storage()};
}

BinTable read(ByteReader& reader, const BinSettings& settings) {
    BinTable table = read_bin_table(reader);
    require_as_asked(reader, table.bands == settings.bands && table.bins() == settings.bins &&
                                 table.grid == settings.grid && table.storage == settings.storage);
    return table;
}

ShadingCost cost(const BinTable& table) {
    const int layers = table.bins() * harmonic_layers(table.bands);
    return {.fetches_per_vertex = layers,
            .multiply_adds_per_vertex = 4 * layers + 3 * table.bins() * math::sh_count(table.bands) + 9 * table.bins(),
            .table_bytes = table.bytes(),
            .vertex_bytes = harmonics_bytes(table.bands)};
}

Facts facts(const BinTable& table) {
    return with_view_table({{"bands", fmt::to_string(table.bands)}, {"bins", fmt::to_string(table.bins())}}, table.grid,
                           table);
}

}  // namespace rowland::diffraction
