#include "modules/diffraction/representations/spikes/spikes.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <span>

#include "engine/colour/spectrum.h"
#include "engine/core/check.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::diffraction {

namespace {

/// Fraction of q in the weight w, relative to the material's response. It keeps the spikes' wavelengths defined and
/// continuous where nothing is visible, and moves the others by no more than this fraction of an interval.
constexpr double kWeightFloor = 1e-6;

/// The lamp counts as dark at wavelengths below this fraction of its brightest.
constexpr double kDarkFraction = 1e-6;

double sum_of(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

/// Integral from 0 to t ∈ [0, 1] of the line from `begin` to `end`.
double partial_cell(double begin, double end, double t) {
    return t * (begin + 0.5 * t * (end - begin));
}

/// The t ∈ [0, 1] at which partial_cell() reaches `area`, for begin, end ≥ 0 and 0 ≤ area ≤ (begin+end)/2.
double invert_cell(double begin, double end, double area) {
    // The root of ½(end−begin)t² + begin·t = area, in the form that does not cancel.
    const double discriminant = std::max(begin * begin + 2.0 * (end - begin) * area, 0.0);
    const double denominator = begin + std::sqrt(discriminant);
    return denominator > 0.0 ? std::clamp(2.0 * area / denominator, 0.0, 1.0) : 0.0;
}

/// Positions in [0, 400] nm above 380 that cut the piecewise linear `weight` (401 nodes) into `parts` of equal
/// integral.
std::vector<double> equal_cuts(std::span<const double> weight, int parts) {
    std::vector<double> cumulative(weight.size(), 0.0);
    for (std::size_t j = 1; j < weight.size(); ++j)
        cumulative[j] = cumulative[j - 1] + 0.5 * (weight[j - 1] + weight[j]);
    std::vector<double> cuts = {0.0};
    for (int k = 1; k < parts; ++k) {
        const double target = cumulative.back() * k / parts;
        const auto above = std::upper_bound(cumulative.begin(), cumulative.end() - 1, target);
        const auto j = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - cumulative.begin() - 1, 0));
        const double t = invert_cell(weight[j], weight[j + 1], target - cumulative[j]);
        cuts.push_back(static_cast<double>(j) + t);
    }
    cuts.push_back(static_cast<double>(weight.size() - 1));
    return cuts;
}

/// Weights of the nodes whose sum Σ weight_j f_j is the exact integral of the piecewise linear f over [begin, end].
/// Calls use(j, weight_j), each j once or twice.
template <typename Use>
void integrate_linear(double begin, double end, std::size_t nodes, const Use& use) {
    const auto first = std::min(static_cast<std::size_t>(begin), nodes - 2);
    for (std::size_t j = first; j + 1 < nodes && static_cast<double>(j) < end; ++j) {
        const double t0 = std::max(begin - static_cast<double>(j), 0.0);
        const double t1 = std::min(end - static_cast<double>(j), 1.0);
        const double right = partial_cell(0.0, 1.0, t1) - partial_cell(0.0, 1.0, t0);
        use(j, (t1 - t0) - right);
        use(j + 1, right);
    }
}

/// ∫ x w dx / ∫ w dx over [begin, end] for the piecewise linear w: exact by Simpson's rule on every cell.
double mean_position(std::span<const double> weight, double begin, double end) {
    double integral = 0.0;
    double moment = 0.0;
    const auto value = [&](std::size_t j, double t) { return weight[j] + t * (weight[j + 1] - weight[j]); };
    const auto first = std::min(static_cast<std::size_t>(begin), weight.size() - 2);
    for (std::size_t j = first; j + 1 < weight.size() && static_cast<double>(j) < end; ++j) {
        const double x = static_cast<double>(j);
        const double t0 = std::max(begin - x, 0.0);
        const double t1 = std::min(end - x, 1.0);
        const double middle = 0.5 * (t0 + t1);
        const double sixth = (t1 - t0) / 6.0;
        integral += sixth * (value(j, t0) + 4.0 * value(j, middle) + value(j, t1));
        moment += sixth * ((x + t0) * value(j, t0) + 4.0 * (x + middle) * value(j, middle) + (x + t1) * value(j, t1));
    }
    return integral > 0.0 ? std::clamp(moment / integral, begin, end) : 0.5 * (begin + end);
}

}  // namespace

SpikeBaker::SpikeBaker(const Grating& grating, const SpikeSettings& settings)
    : spectrum_(grating, settings.bands), spikes_(settings.spikes) {
    ROWLAND_CHECK_OP(settings.spikes, >=, 1);
    const double scale = 1.0 / colour::luminous_power(settings.illuminant);
    for (std::size_t j = 0; j < kWavelengths; ++j) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
        sensitivity_.push_back(scale * settings.illuminant.power(wavelength_nm) *
                               sum_of(colour::cie_xyz(wavelength_nm)));
    }
}

double SpikeBaker::visible_wavelength(double mean_position, double begin, double end) const {
    const auto cell = std::min(static_cast<std::size_t>(mean_position), kWavelengths - 2);
    const double dark = kDarkFraction * *std::max_element(sensitivity_.begin(), sensitivity_.end());
    if (std::max(sensitivity_[cell], sensitivity_[cell + 1]) > dark) return mean_position;
    // Between the lines of a lamp there is no light: the spike moves to the interval's brightest line.
    const auto first = sensitivity_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = sensitivity_.begin() + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::ceil(end)) + 1,
                                                                      static_cast<std::ptrdiff_t>(kWavelengths));
    return static_cast<double>(std::max_element(first, last) - sensitivity_.begin());
}

SpikeSet SpikeBaker::bake(double v_g, double v_h) const {
    const auto count = static_cast<std::size_t>(math::sh_count(spectrum_.bands()));
    const std::vector<double> coefficients = spectrum_.coefficients(v_g, v_h);
    const double floor = spectrum_.largest_efficiency() > 0.0 ? kWeightFloor * spectrum_.largest_efficiency() : 1.0;
    std::vector<double> weight(kWavelengths);
    for (std::size_t j = 0; j < kWavelengths; ++j) {
        double norm_squared = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            norm_squared += coefficients[j * count + i] * coefficients[j * count + i];
        weight[j] = (std::sqrt(norm_squared) + floor) * sensitivity_[j];
    }

    const std::vector<double> cuts = equal_cuts(weight, spikes_);
    SpikeSet result{.bands = spectrum_.bands(), .wavelengths_nm = {}, .coefficients = {}};
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const double position = visible_wavelength(mean_position(weight, cuts[k], cuts[k + 1]), cuts[k], cuts[k + 1]);
        std::vector<double> spike(count, 0.0);
        integrate_linear(cuts[k], cuts[k + 1], kWavelengths, [&](std::size_t j, double cell) {
            for (std::size_t i = 0; i < count; ++i) spike[i] += cell * sensitivity_[j] * coefficients[j * count + i];
        });
        result.wavelengths_nm.push_back(colour::kVisibleMin + position);
        result.coefficients.insert(result.coefficients.end(), spike.begin(), spike.end());
    }
    return result;
}

SpikeSet bake_spikes(const Grating& grating, double v_g, double v_h, const SpikeSettings& settings) {
    return SpikeBaker(grating, settings).bake(v_g, v_h);
}

glm::dmat3 spike_colour(double wavelength_nm) {
    const glm::dvec3 cmf = colour::cie_xyz(wavelength_nm);
    return glm::outerProduct(cmf / sum_of(cmf), colour::rgb_basis(wavelength_nm));
}

glm::dvec3 evaluate_spikes(const SpikeSet& spikes, const lighting::ShLight& tangent_light) {
    const auto stride = static_cast<std::size_t>(math::sh_count(spikes.bands));
    const std::size_t common = std::min(stride, tangent_light.coefficients.size());
    glm::dvec3 xyz(0.0);
    for (std::size_t k = 0; k < spikes.wavelengths_nm.size(); ++k) {
        glm::dvec3 rgb(0.0);
        for (std::size_t i = 0; i < common; ++i)
            rgb += spikes.coefficients[k * stride + i] * tangent_light.coefficients[i];
        xyz += spike_colour(spikes.wavelengths_nm[k]) * rgb;
    }
    return xyz;
}

namespace {

constexpr double kWavelengthRange_nm = colour::kVisibleMax - colour::kVisibleMin;

// Limits for files: far above any use, and small enough that no product of them overflows.
constexpr int kMaximumNodes = 1 << 14;
constexpr int kMaximumSpikes = 512;

/// Storage and mapping are in one byte.
constexpr unsigned kMappingShift = 4;

double normalized(double wavelength_nm) {
    return (wavelength_nm - colour::kVisibleMin) / kWavelengthRange_nm;
}

/// Writes a view's spikes into unquantised texels.
void store(const SpikeSet& spikes, const SpikeTable& table, std::size_t texel, std::vector<double>& values) {
    const std::size_t texels_per_layer = table.grid.texels();
    const auto count = static_cast<std::size_t>(math::sh_count(table.bands));
    for (std::size_t k = 0; k < spikes.wavelengths_nm.size(); ++k) {
        const std::size_t first_layer = k * static_cast<std::size_t>(table.layers_per_spike());
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
    table.grid = settings.grid;
    table.storage = settings.storage;
    check_view_grid(table.grid, grating);

    const SpikeBaker baker(grating, settings.spikes);
    const std::vector<double> signs = mirror_signs(table.bands);
    std::vector<double> values(static_cast<std::size_t>(table.layers()) * table.grid.texels() * kTexelComponents, 0.0);
    for_each_view("baking spikes", table.grid, grating,
                  [&](const glm::dvec2& view, std::size_t texel, std::size_t mirror) {
                      const SpikeSet spikes = baker.bake(view.x, view.y);
                      store(spikes, table, texel, values);
                      if (mirror != texel) store(mirrored(spikes, signs), table, mirror, values);
                  });
    pack(values, static_cast<std::size_t>(table.layers()), table);
    return table;
}

SpikeSet sample(const SpikeTable& table, double v_g, double v_h, double v_n) {
    const BilinearLookup lookup = look_up(table.grid, v_g, v_h, v_n);
    const std::size_t texels_per_layer = table.grid.texels();
    const auto entry = [&](std::size_t spike, std::size_t i) {
        const std::size_t layer = spike * static_cast<std::size_t>(table.layers_per_spike()) + i / kTexelComponents;
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
    writer.value<std::int32_t>(table.grid.rows);
    writer.value<std::int32_t>(table.grid.columns);
    writer.value(static_cast<std::uint8_t>(static_cast<unsigned>(table.storage) |
                                           static_cast<unsigned>(table.grid.mapping) << kMappingShift));
    write_packed_texels(table, writer);
}

SpikeTable read_spike_table(ByteReader& reader) {
    SpikeTable table;
    table.bands = read_count(reader, "bands", 1, math::kMaximumBands);
    table.spikes = read_count(reader, "spikes", 1, kMaximumSpikes);
    table.grid.rows = read_count(reader, "rows", 1, kMaximumNodes);
    table.grid.columns = read_count(reader, "columns", 1, kMaximumNodes);
    const auto choices = reader.value<std::uint8_t>();
    table.storage = to_storage(reader, choices & ((1U << kMappingShift) - 1U));
    table.grid.mapping = to_view_mapping(reader, choices >> kMappingShift);
    if (!is_valid(table.grid))
        reader.fail(fmt::format("{} x {} nodes", table.grid.columns, table.grid.rows),
                    fmt::format("a {} table's", view_mapping_name(table.grid.mapping)));
    read_packed_texels(reader, static_cast<std::size_t>(table.layers()), table.grid.texels(), table);
    return table;
}

const RepresentationInfo& SpikeTableSettings::info() {
    static const RepresentationInfo info{
        .name = "spikes",
        .file_number = 0,
        .summary = "the paper's: a few wavelengths for each view, light as SH at the vertices",
        .lattices = true,
        .takes_harmonics = true,
        .key_lights = KeyLightUse::OnRequest,
        .settings = {bands_setting(),
                     {.key = "spikes",
                      .label = "Spikes",
                      .help = "Wavelengths of the composite model for each view.",
                      .minimum = 1,
                      .maximum = 64,
                      .default_value = SpikeSettings().spikes},
                     view_mapping_setting(),
                     view_resolution_setting(),
                     storage_setting(SpikeTableSettings().storage)},
        .budget = [](const Grating& grating, SurfaceShape) -> std::vector<std::string> {
            if (!sees_v_g_alone(grating)) return {"bands=5/spikes=4"};
            return {"bands=5/spikes=4", "bands=5/spikes=8", "bands=5/spikes=16"};
        }};
    return info;
}

std::optional<Refusal> SpikeTableSettings::refusal(const SettingValues& values, const Grating& grating) {
    if (auto refused = view_grid_refusal(values, grating)) return refused;
    SpikeTable table;
    table.bands = values.number("bands");
    table.spikes = values.number("spikes");
    return layer_refusal("spikes", table.layers());
}

SpikeTableSettings SpikeTableSettings::from(const SettingValues& values, const Grating&) {
    return {.spikes = {.bands = values.number("bands"), .spikes = values.number("spikes")},
            .grid = view_grid(values, ViewGrid{}),
            .storage = values.storage()};
}

SpikeTable read(ByteReader& reader, const SpikeTableSettings& settings) {
    SpikeTable table = read_spike_table(reader);
    require_as_asked(reader, table.bands == settings.spikes.bands && table.spikes == settings.spikes.spikes &&
                                 table.grid == settings.grid && table.storage == settings.storage);
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
                           table.grid, table);
}

}  // namespace rowland::diffraction
