#include "modules/diffraction/representations/arc/arc_table.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/math/last_bits.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/bake/view_spectrum.h"

namespace rowland::diffraction {

namespace {

using Eigen::MatrixXd;

constexpr Eigen::Index kTermColumns = 9;  ///< columns a light term takes: light's channel · 3 + tristimulus
constexpr int kMaximumPitchNodes = 1 << 12;

/// A model of light: its power falls with the band about as 1/(l+1)², and its channels are mostly grey (eight probes:
/// l = 2 has .04 … .6 of the power of l = 0, channels correlate by .6 … 1). Other values change the error by a quarter
/// at most.
constexpr double kChannelCorrelation = 0.9;
double band_power(int l) {
    return 1.0 / ((l + 1.0) * (l + 1.0));
}

/// A square root L of the covariance L Lᵀ of the light's numbers: (2n−1)² entries for moments q = M l, else diagonal.
MatrixXd light_deviation(LightTerms terms, int bands) {
    const int count = math::sh_count(bands);
    Eigen::VectorXd deviation(count);
    for (int l = 0; l < bands; ++l)
        for (int m = -l; m <= l; ++m) deviation(math::sh_index(l, m)) = std::sqrt(band_power(l));
    if (terms == LightTerms::Harmonics) return deviation.asDiagonal();
    const ArcMoments moments(bands);
    const MatrixXd map = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        moments.matrix().data(), arc_moment_count(bands), count);
    // M S = (Q R)ᵀ: M S² Mᵀ = Rᵀ R.
    const MatrixXd transposed = (map * deviation.asDiagonal()).transpose();
    const MatrixXd upper =
        transposed.householderQr().matrixQR().topRows(arc_moment_count(bands)).template triangularView<Eigen::Upper>();
    return upper.transpose();
}

Eigen::Matrix3d channel_deviation() {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Constant(kChannelCorrelation);
    covariance.diagonal().setOnes();
    return covariance.llt().matrixL();
}

/// The table's columns weighted by the light's deviations.
MatrixXd weighed(const MatrixXd& table, LightTerms terms, int bands) {
    const MatrixXd light = light_deviation(terms, bands);
    const Eigen::Matrix3d channel = channel_deviation();
    const Eigen::Index count = light.rows();
    MatrixXd result = MatrixXd::Zero(table.rows(), table.cols());
    for (Eigen::Index o = 0; o < 3; ++o)
        for (Eigen::Index c = 0; c < 3; ++c) {
            MatrixXd mixed = MatrixXd::Zero(table.rows(), count);
            for (Eigen::Index from = 0; from < 3; ++from) {
                if (channel(from, c) == 0.0) continue;
                for (Eigen::Index k = 0; k < count; ++k)
                    mixed.col(k) += channel(from, c) * table.col(k * kTermColumns + from * 3 + o);
            }
            const MatrixXd scaled = mixed * light;
            for (Eigen::Index k = 0; k < count; ++k)
                result.col(k * kTermColumns + Eigen::Index{3} * c + o) = scaled.col(k);
        }
    return result;
}

/// The first `rank` left singular vectors.
MatrixXd leading_weights(const MatrixXd& table, Eigen::Index rank) {
    const Eigen::BDCSVD<MatrixXd> decomposition(table, Eigen::ComputeThinU);
    return decomposition.matrixU().leftCols(rank);
}

/// The index of the largest magnitude, the first of those that differ by rounding alone: mirrored views have equal
/// ones.
Eigen::Index largest_of(const Eigen::VectorXd& values) {
    const double most = values.cwiseAbs().maxCoeff();
    Eigen::Index first = 0;
    while (std::abs(values(first)) < (1.0 - 1e-9) * most) ++first;
    return first;
}

void put(const std::vector<glm::dmat3>& terms, std::span<const double> signs, Eigen::Index row, MatrixXd& table) {
    for (std::size_t k = 0; k < terms.size(); ++k)
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o)
                table(row, static_cast<Eigen::Index>(k) * kTermColumns + Eigen::Index{3} * c + o) =
                    (signs.empty() ? 1.0 : signs[k]) * terms[k][c][o];
}

/// One row per texel of the weights' texture, nine columns per light term.
MatrixXd tabulate(const Grating& grating, const ArcTable& table, const colour::Illuminant& illuminant) {
    const TransferTerms terms(grating, colour::LightSpectra(illuminant), table.bands);
    const auto columns = static_cast<std::size_t>(table.grid.columns);
    const std::size_t rows = static_cast<std::size_t>(table.rows());
    MatrixXd result(static_cast<Eigen::Index>(columns * rows),
                    light_term_count(table.terms, table.bands) * kTermColumns);
    if (sees_v_g_alone(grating)) {
        parallel_for(columns * rows, [&](std::size_t texel) {
            const double factor = table.pitch ? table.pitch->factor_at(static_cast<int>(texel / columns)) : 1.0;
            const double v_g = node_view(table.grid, static_cast<int>(texel % columns), 0).x;
            put(table.terms == LightTerms::ArcMoments ? terms.moments(v_g, factor)
                                                      : terms.coefficients(v_g, 0.0, factor),
                {}, static_cast<Eigen::Index>(texel), result);
        });
        return result;
    }
    const std::vector<double> signs = mirror_signs(table.bands);
    for_each_view("baking arcs", table.grid, grating,
                  [&](const glm::dvec2& view, std::size_t texel, std::size_t mirror) {
                      const std::vector<glm::dmat3> coefficients = terms.coefficients(view.x, view.y);
                      put(coefficients, {}, static_cast<Eigen::Index>(texel), result);
                      if (mirror != texel) put(coefficients, signs, static_cast<Eigen::Index>(mirror), result);
                  });
    return result;
}

void check_settings(const Grating& grating, const ArcSettings& settings) {
    ROWLAND_CHECK_OP(settings.rank, >=, 1);
    if (!settings.pitch) return;
    ROWLAND_CHECK(settings.pitch->smallest > 0.0 && settings.pitch->largest > settings.pitch->smallest &&
                      settings.pitch->nodes >= 2,
                  "a pitch axis ascends");
    if (sees_v_g_alone(grating)) return;
    throw Error({.file = {},
                 .location = "groove_lobe",
                 .found = "a lobe that is not flat, with a pitch that varies over the surface",
                 .expected = "the flat lobe: weights over views and pitches would take three dimensions",
                 .remedy = "drop the pitch variation"});
}

}  // namespace

int light_term_count(LightTerms terms, int bands) {
    return terms == LightTerms::ArcMoments ? arc_moment_count(bands) : math::sh_count(bands);
}

ArcTable bake(const Grating& grating, const ArcSettings& settings) {
    check_settings(grating, settings);
    ArcTable table;
    table.bands = settings.bands;
    table.terms = has_arc_moments(grating) ? LightTerms::ArcMoments : LightTerms::Harmonics;
    table.grid = settings.grid.value_or(default_view_grid(grating));
    table.pitch = settings.pitch;
    table.storage = settings.storage;
    check_view_grid(table.grid, grating);
    ROWLAND_CHECK(!sees_v_g_alone(grating) || table.grid.mapping == ViewMapping::OneDimensional,
                  "the flat lobe's weights are one-dimensional");

    const MatrixXd values = tabulate(grating, table, settings.illuminant);
    table.rank = static_cast<int>(std::min({static_cast<Eigen::Index>(settings.rank), values.rows(), values.cols()}));
    MatrixXd weights = leading_weights(weighed(values, table.terms, table.bands), table.rank);
    // The weights' columns are orthonormal, so these are the best factors for them, whatever the light.
    MatrixXd factors = weights.transpose() * values;
    for (Eigen::Index r = 0; r < table.rank; ++r) {
        const double scale = weights(largest_of(weights.col(r)), r);
        weights.col(r) /= scale;
        factors.row(r) *= scale;
    }
    // All at once: later factors are smaller, and their last bits are those of the first. Both are stored as floats.
    constexpr int kBits = 36;
    math::drop_last_bits({factors.data(), static_cast<std::size_t>(factors.size())}, kBits);
    math::drop_last_bits({weights.data(), static_cast<std::size_t>(weights.size())}, kBits);
    for (Eigen::Index r = 0; r < table.rank; ++r)
        for (Eigen::Index k = 0; k < values.cols() / kTermColumns; ++k) {
            glm::mat3 factor;
            for (int c = 0; c < 3; ++c)
                for (int o = 0; o < 3; ++o)
                    factor[c][o] = static_cast<float>(factors(r, k * kTermColumns + Eigen::Index{3} * c + o));
            table.factors.push_back(factor);
        }
    const std::size_t layers = weight_layers(table.rank);
    const auto texels = static_cast<std::size_t>(values.rows());
    std::vector<double> packed(layers * texels * kTexelComponents, 0.0);
    for (std::size_t r = 0; r < static_cast<std::size_t>(table.rank); ++r)
        for (std::size_t texel = 0; texel < texels; ++texel)
            packed[(r / kTexelComponents * texels + texel) * kTexelComponents + r % kTexelComponents] =
                weights(static_cast<Eigen::Index>(texel), static_cast<Eigen::Index>(r));
    pack(packed, layers, table);
    return table;
}

std::vector<glm::dvec3> light_products(const ArcTable& table, std::span<const glm::dvec3> light_terms) {
    const auto stride = static_cast<std::size_t>(light_term_count(table.terms, table.bands));
    const std::size_t common = std::min(stride, light_terms.size());
    std::vector<glm::dvec3> products(static_cast<std::size_t>(table.rank), glm::dvec3(0.0));
    for (std::size_t r = 0; r < products.size(); ++r)
        for (std::size_t k = 0; k < common; ++k)
            products[r] += glm::dmat3(table.factors[r * stride + k]) * light_terms[k];
    return products;
}

glm::dvec3 shade(const ArcTable& table, std::span<const glm::dvec3> products, const glm::dvec3& view,
                 double pitch_factor) {
    glm::dvec3 xyz(0.0);
    if (!(view.z > 0.0)) return xyz;
    const auto columns = static_cast<std::size_t>(table.grid.columns);
    BilinearLookup lookup = look_up(table.grid, view.x, view.y, view.z);
    if (table.pitch) {
        lookup =
            combine(look_up_axis(0.5 + 0.5 * view.x, columns),
                    look_up_axis(table.pitch->position_of(pitch_factor), static_cast<std::size_t>(table.pitch->nodes)),
                    columns);
    }
    const std::size_t texels = columns * static_cast<std::size_t>(table.rows());
    for (std::size_t r = 0; r < products.size(); ++r)
        xyz += filtered(table, r / kTexelComponents, texels, r % kTexelComponents, lookup) * products[r];
    return xyz;
}

glm::dvec3 evaluate(const ArcTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view,
                    double pitch_factor) {
    if (table.terms == LightTerms::Harmonics)
        return shade(table, light_products(table, tangent_light.coefficients), view, pitch_factor);
    return shade(table, light_products(table, ArcMoments(table.bands)(tangent_light)), view, pitch_factor);
}

void write(const ArcTable& table, ByteWriter& writer) {
    writer.value<std::int32_t>(table.bands);
    writer.value<std::int32_t>(table.rank);
    writer.value(static_cast<std::uint8_t>(table.terms));
    write_view_grid(table.grid, writer);
    writer.value<std::int32_t>(table.pitch ? table.pitch->nodes : 0);
    if (table.pitch) {
        writer.value(table.pitch->smallest);
        writer.value(table.pitch->largest);
    }
    writer.value(static_cast<std::uint8_t>(table.storage));
    write_matrices(table.factors, writer);
    write_packed_texels(table, writer);
}

namespace {

LightTerms read_light_terms(ByteReader& reader) {
    const auto terms = reader.value<std::uint8_t>();
    if (terms > static_cast<unsigned>(LightTerms::Harmonics))
        reader.fail(fmt::format("light terms {}", terms), "0 (arc moments) or 1 (harmonics)");
    return static_cast<LightTerms>(terms);
}

std::optional<PitchAxis> read_pitch_axis(ByteReader& reader) {
    PitchAxis axis;
    axis.nodes = read_count(reader, "pitch nodes", 0, kMaximumPitchNodes);
    if (axis.nodes == 0) return std::nullopt;
    axis.smallest = reader.value<double>();
    axis.largest = reader.value<double>();
    const bool ascends = std::isfinite(axis.largest) && axis.smallest > 0.0 && axis.largest > axis.smallest;
    if (axis.nodes < 2 || !ascends)
        reader.fail(fmt::format("{} pitches from {} to {}", axis.nodes, axis.smallest, axis.largest),
                    "at least 2, ascending from a factor above 0");
    return axis;
}

}  // namespace

ArcTable read_arc_table(ByteReader& reader) {
    ArcTable table;
    table.bands = read_count(reader, "bands", 1, math::kMaximumBands);
    table.rank = read_count(reader, "rank", 1, math::sh_count(math::kMaximumBands) * static_cast<int>(kTermColumns));
    table.terms = read_light_terms(reader);
    table.grid = read_view_grid(reader);
    table.pitch = read_pitch_axis(reader);
    const bool flat = table.grid.mapping == ViewMapping::OneDimensional;
    if (!flat && (table.terms == LightTerms::ArcMoments || table.pitch))
        reader.fail(fmt::format("a {} grid", view_mapping_name(table.grid.mapping)),
                    "one-dimensional for arc moments and beside a pitch axis");
    table.storage = to_storage(reader, reader.value<std::uint8_t>());
    const std::size_t count =
        static_cast<std::size_t>(table.rank) * static_cast<std::size_t>(light_term_count(table.terms, table.bands));
    table.factors = read_matrices(reader, "factors", count, count);
    read_packed_texels(reader, weight_layers(table.rank),
                       static_cast<std::size_t>(table.grid.columns) * static_cast<std::size_t>(table.rows()), table);
    return table;
}

ArcTable read(ByteReader& reader, const ArcSettings& settings) {
    ArcTable table = read_arc_table(reader);
    require_as_asked(reader, table.bands == settings.bands && table.rank <= settings.rank &&
                                 table.pitch == settings.pitch && (!settings.grid || table.grid == *settings.grid) &&
                                 table.storage == settings.storage);
    return table;
}

const RepresentationInfo& ArcSettings::info() {
    static const RepresentationInfo info{
        .name = "arc",
        .file_number = 2,
        .summary = "a few products of table and light: light at the vertices, views in the pixels",
        .lattices = true,
        .takes_harmonics = true,
        .settings = {bands_setting(), rank_setting(), view_mapping_setting(), view_resolution_setting(),
                     storage_setting(ArcSettings().storage)},
        .budget = [](const Grating& grating, SurfaceShape) -> std::vector<std::string> {
            if (!sees_v_g_alone(grating)) return {"bands=5/rank=8", "bands=8/rank=16"};
            std::vector<std::string> settings;
            for (const int n : {3, 5, 8, 12, 16})
                for (const int r : {4, 8, 12, 16})
                    if (r <= 2 * n + 2) settings.push_back(fmt::format("bands={}/rank={}", n, r));
            return settings;
        }};
    return info;
}

std::optional<Refusal> ArcSettings::refusal(const SettingValues& values, const Grating& grating) {
    const std::string mapping = values.word_or("view_mapping", "one-dimensional");
    if (sees_v_g_alone(grating) && mapping != "one-dimensional")
        return Refusal{"view_mapping", fmt::format("\"{}\"", mapping),
                       "\"one-dimensional\" for arc with the flat groove_lobe",
                       "leave view_mapping out; arc moments depend on v_g alone"};
    return view_grid_refusal(values, grating);
}

ArcSettings ArcSettings::from(const SettingValues& values, const Grating& grating) {
    return {.bands = values.number("bands"),
            .rank = values.number("rank"),
            .grid = view_grid(values, default_view_grid(grating)),
            .storage = values.storage()};
}

ShadingCost cost(const ArcTable& table) {
    const auto layers = static_cast<int>(weight_layers(table.rank));
    return {.fetches_per_pixel = layers,
            .multiply_adds_per_pixel = (4 + 12) * layers,
            .table_bytes = table.bytes() + table.factors.size() * sizeof(glm::mat3),
            .vertex_bytes = weight_layers(table.rank) * 3 * sizeof(glm::vec4)};
}

Facts facts(const ArcTable& table) {
    return with_view_table({{"bands", fmt::to_string(table.bands)}, {"rank", fmt::to_string(table.rank)}}, table.grid,
                           table);
}

}  // namespace rowland::diffraction
