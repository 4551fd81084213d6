#include "modules/diffraction/bake/bin_table.h"

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

std::size_t blocks_of(int bands) {
    return (static_cast<std::size_t>(math::sh_count(bands)) + kTexelComponents - 1) / kTexelComponents;
}

/// One bin: what to multiply the coefficients at its wavelengths with for their mean, and its colour.
struct Bin {
    std::size_t begin = 0;
    std::vector<double> shares;  ///< from node `begin` on
    glm::dmat3 colour{0.0};
};

std::vector<Bin> make_bins(const colour::LightSpectra& spectra, int count) {
    std::vector<glm::dmat3> observed;
    std::vector<double> sensitivity;
    for (std::size_t j = 0; j < kWavelengths; ++j) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
        const glm::dvec3 cmf = colour::cie_xyz(wavelength_nm);
        observed.push_back(glm::outerProduct(cmf, spectra(wavelength_nm)));
        // A trace of evenness, so that a bin between a lamp's lines has a mean too.
        sensitivity.push_back((cmf.x + cmf.y + cmf.z) * spectra.illuminant().power(wavelength_nm));
    }
    const double largest = *std::max_element(sensitivity.begin(), sensitivity.end());
    for (double& q : sensitivity) q += 1e-9 * largest;

    std::vector<Bin> bins;
    const std::vector<std::size_t> cuts = equal_weight_cuts(sensitivity, count);
    for (std::size_t b = 0; b + 1 < cuts.size(); ++b) {
        Bin bin{.begin = cuts[b], .shares = {}};
        double total = 0.0;
        each_node(cuts[b], cuts[b + 1], [&](std::size_t j, double share) {
            bin.shares.push_back(share * sensitivity[j]);
            bin.colour += share * observed[j];
            total += bin.shares.back();
        });
        for (double& share : bin.shares) share /= total;
        bins.push_back(std::move(bin));
    }
    return bins;
}

}  // namespace

BinTable bake_bin_table(const Grating& grating, const BinSettings& settings) {
    ROWLAND_CHECK(settings.bins >= 1 && settings.bins <= kMaximumBins, "1 to 400 bins");
    check_view_grid(settings.grid, grating.lobe);
    BinTable table;
    table.bands = settings.bands;
    table.grid = settings.grid;
    table.storage = settings.storage;
    const std::vector<Bin> bins = make_bins(colour::LightSpectra(settings.illuminant), settings.bins);
    for (const Bin& bin : bins) table.colours.emplace_back(bin.colour);

    const ViewSpectrum spectrum(grating, table.bands);
    const std::vector<double> signs = mirror_signs(table.bands);
    const std::size_t blocks = blocks_of(table.bands);
    const std::size_t texels = table.grid.texels();
    std::vector<double> values(bins.size() * blocks * texels * kTexelComponents, 0.0);
    for_each_view("baking bins", table.grid, [&](const glm::dvec2& view, std::size_t texel, std::size_t mirror) {
        const std::vector<double> coefficients = spectrum.coefficients(view.x, view.y);
        for (std::size_t b = 0; b < bins.size(); ++b)
            for (std::size_t i = 0; i < signs.size(); ++i) {
                double mean = 0.0;
                for (std::size_t j = 0; j < bins[b].shares.size(); ++j)
                    mean += bins[b].shares[j] * coefficients[(bins[b].begin + j) * signs.size() + i];
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
    const BilinearLookup place = look_up(table.grid, view.x, view.y, view.z);
    const std::size_t blocks = blocks_of(table.bands);
    const std::size_t common =
        std::min(static_cast<std::size_t>(math::sh_count(table.bands)), tangent_light.coefficients.size());
    for (std::size_t b = 0; b < table.colours.size(); ++b) {
        glm::dvec3 rgb(0.0);
        for (std::size_t i = 0; i < common; ++i)
            rgb += tangent_light.coefficients[i] *
                   filtered(table, b * blocks + i / kTexelComponents, table.grid.texels(), i % kTexelComponents, place);
        xyz += glm::dmat3(table.colours[b]) * rgb;
    }
    return xyz;
}

void write_bin_table(const BinTable& table, ByteWriter& writer) {
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
    read_packed_texels(reader, table.colours.size() * blocks_of(table.bands), table.grid.texels(), table);
    return table;
}

}  // namespace rowland::diffraction
