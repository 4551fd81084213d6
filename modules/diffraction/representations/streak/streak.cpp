#include "modules/diffraction/representations/streak/streak.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>
#include <string_view>

#include "engine/core/error.h"
#include "engine/lighting/light_samples.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/representations/streak/streak_map.h"

namespace rowland::diffraction {

namespace {

/// Lobes wider than this deviation have twice as many directions in their map.
constexpr double kWideLobe = 0.08;

struct NarrowLobe {
    double sigma = 0.0;
    double power = 1.0;
};

NarrowLobe narrow_lobe(const GrooveLobe& lobe) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) return {gaussian->sigma, 1.0};
    if (const auto* pits = std::get_if<PitsLobe>(&lobe))
        if (pits->coherent > 0.0) return {kCoherentSigma, pits->coherent};
    throw Error({.file = {},
                 .location = "groove_lobe",
                 .found = is_flat(lobe)                                   ? "flat"
                          : std::holds_alternative<PitSequenceLobe>(lobe) ? "a pit_sequence"
                                                                          : "pits without a coherent part",
                 .expected = "a narrow lobe: sigma, or pits with a coherent part, for the representation \"streak\"",
                 .remedy = "use \"arc\" or \"spikes\""});
}

/// The kernel's sums over a raster of x.
struct KernelRaster {
    double first_nm = 0.0;  ///< middle of the first interval
    double step_nm = 1.0;
    std::vector<glm::dmat3> sums;  ///< ∫ k dx over each interval

    double middle_nm(std::size_t i) const { return first_nm + static_cast<double>(i) * step_nm; }
};

/// Distance of nodes over their width. At 2 the sum of the nodes' curves has ripples of 1.5 %.
constexpr double kNodeDistance = 5.0 / 3.0;

/// The kernel on one side of x = 0, for |x| ≤ 2d.
KernelRaster raster_of(const ColourKernel& kernel, double pitch_nm, bool positive) {
    const double begin = positive ? std::max(kernel.begin_nm(), 0.0) : std::max(kernel.begin_nm(), -2.0 * pitch_nm);
    const double end = positive ? std::min(kernel.end_nm(), 2.0 * pitch_nm) : std::min(kernel.end_nm(), 0.0);
    KernelRaster raster;
    if (begin >= end) return raster;
    const auto count = static_cast<std::size_t>(std::ceil(end - begin));
    raster.step_nm = (end - begin) / static_cast<double>(count);
    raster.first_nm = begin + 0.5 * raster.step_nm;
    glm::dmat3 before = kernel.antiderivative(begin);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dmat3 after = kernel.antiderivative(begin + static_cast<double>(i + 1) * raster.step_nm);
        raster.sums.push_back(after - before);
        before = after;
    }
    return raster;
}

/// Fraction of the kernel's sum on each side of x = 0 that lies beyond the first and the last node.
constexpr double kBeyondNodes = 0.015;
/// Regularisation of the fit, as a fraction of its diagonal.
constexpr double kRidge = 1e-3;

/// Non-negative least squares: the weights with which the nodes' normal distributions add up to one element of the
/// kernel. The kernel is not negative, and a light narrower than a node would show a negative weight as a dark spot.
/// Coordinate descent; neighbours overlap by half, so that five sweeps leave an eighth of the error. `products`: inner
/// products of the nodes' distributions with the kernel.
std::vector<double> fit_element(const std::vector<double>& nodes, double width_nm,
                                const std::vector<double>& products) {
    constexpr int kSweeps = 100;
    constexpr double kReach = 8.0;  // in widths, where the product of two nodes is 1e-7
    std::vector<double> weights(nodes.size(), 0.0);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            double residual = products[i];
            for (std::size_t j = 0; j < nodes.size(); ++j) {
                const double z = (nodes[i] - nodes[j]) / width_nm;
                if (j != i && std::abs(z) < kReach) residual -= std::exp(-0.25 * z * z) * weights[j];
            }
            weights[i] = std::max(residual / (1.0 + kRidge), 0.0);
        }
    return weights;
}

/// The sum of all elements.
double element_sum(const glm::dmat3& matrix) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) sum += matrix[c][0] + matrix[c][1] + matrix[c][2];
    return sum;
}

/// Adds segments without weights over the interval where the kernel is.
void add_segments(const KernelRaster& raster, double distance_nm, std::vector<StreakSegment>& segments) {
    double whole = 0.0;
    for (const glm::dmat3& sum : raster.sums) whole += element_sum(sum);
    if (!(whole > 0.0)) return;
    double below = 0.0;
    std::size_t first = raster.sums.size();
    std::size_t last = 0;
    for (std::size_t i = 0; i < raster.sums.size(); ++i) {
        below += element_sum(raster.sums[i]);
        if (below >= kBeyondNodes * whole) first = std::min(first, i);
        if (below <= (1.0 - kBeyondNodes) * whole) last = i;
    }
    const double begin = raster.middle_nm(first);
    const double extent = raster.middle_nm(std::max(first, last)) - begin;
    const int count = std::max(1, static_cast<int>(std::lround((extent / distance_nm + 1.0) / kSegmentNodes)));
    const double step = extent / (count * kSegmentNodes - 1);
    for (int i = 0; i < count; ++i)
        segments.push_back({.first_nm = static_cast<float>(begin + i * kSegmentNodes * step),
                            .step_nm = static_cast<float>(step),
                            .weights = {}});
}

/// Sets the weights so that the sum of the nodes' normal distributions is the closest to the kernel.
void fit_weights(std::span<const KernelRaster> rasters, double width_nm, std::vector<StreakSegment>& segments) {
    std::vector<double> nodes;
    for (const StreakSegment& segment : segments)
        for (int j = 0; j < kSegmentNodes; ++j) nodes.push_back(segment.path_nm(j));
    for (int e = 0; e < 9; ++e) {
        std::vector<double> products(nodes.size(), 0.0);
        double whole = 0.0;
        for (const KernelRaster& raster : rasters)
            for (std::size_t k = 0; k < raster.sums.size(); ++k) {
                const double part = raster.sums[k][e / 3][e % 3];
                whole += part;
                for (std::size_t i = 0; i < nodes.size(); ++i) {
                    const double z = (raster.middle_nm(k) - nodes[i]) / width_nm;
                    if (std::abs(z) < 6.0) products[i] += std::numbers::sqrt2 * std::exp(-0.5 * z * z) * part;
                }
            }
        const std::vector<double> weights = fit_element(nodes, width_nm, products);
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        for (std::size_t i = 0; i < nodes.size() && sum > 0.0; ++i)  // uniform light is exact
            segments[i / kSegmentNodes].weights[i % kSegmentNodes][e / 3][e % 3] =
                static_cast<float>(weights[i] * whole / sum);
    }
}

/// Values that are the same for all points of a view.
struct StreakView {
    const Streak& streak;
    const glm::dmat3& axes;
    glm::dvec3 view{0.0};
    double length_scale = 1.0;  ///< the lobe's deviation over the map's
    std::optional<Cover> cover = std::nullopt;

    double side() const { return std::abs(view.y); }
    /// Radii √(1 − s_g²) from which on some of the lobe, and all of it, is above the horizon.
    double some() const { return std::max(side() - streak.reach(), 0.0); }
    double all() const { return side() + streak.reach(); }
};

/// s_h of a segment whose middle is at s_g: the middle of the lobe's part above the horizon.
double lobe_middle(const StreakView& at, double s_g) {
    const double r = std::sqrt(std::max(1.0 - s_g * s_g, 0.0));
    return (at.view.y > 0.0 ? -1.0 : 1.0) * (at.side() + 0.5 * std::min(r - at.all(), 0.0));
}

/// The light at (s_g, s_h).
LobePoint lobe_point(const StreakView& at, double s_g, double s_h) {
    const double square = std::max(1.0 - s_g * s_g, 1e-6);
    const double s_n = std::sqrt(std::max(square - s_h * s_h, kLeastSquare));
    return {.direction = at.axes * glm::dvec3(s_g, s_h, s_n),
            .along = at.axes * glm::dvec3(0.0, s_n, -s_h),
            .level = std::log2(at.length_scale * std::sqrt(square) / s_n)};
}

glm::dvec3 segment_xyz(const StreakSegment& segment, const StreakMap& map, const StreakView& at) {
    const double first = static_cast<double>(segment.first_nm) / at.streak.pitch_nm - at.view.x;
    const double step = static_cast<double>(segment.step_nm) / at.streak.pitch_nm;
    const double limit = std::sqrt(std::max(1.0 - at.some() * at.some(), 0.0));
    const double low = std::max(first, -limit);
    const double high = std::min(first + (kSegmentNodes - 1) * step, limit);
    if (low > high) return glm::dvec3(0.0);
    const double middle = 0.5 * (low + high);
    const double s_h = lobe_middle(at, middle);
    const StreakPath path(low, high, lobe_point(at, low, s_h), lobe_point(at, middle, s_h), lobe_point(at, high, s_h));
    glm::dvec3 xyz(0.0);
    for (int j = 0; j < kSegmentNodes; ++j) {
        const double s_g = first + j * step;
        // Fraction of the lobe above the horizon, linear in r².
        const double fraction = std::clamp(
            (1.0 - s_g * s_g - at.some() * at.some()) / (at.all() * at.all() - at.some() * at.some()), 0.0, 1.0);
        if (fraction == 0.0) continue;
        const double passed = transmittance(at.cover, std::sqrt(std::max(1.0 - s_g * s_g - s_h * s_h, kLeastSquare)));
        xyz +=
            fraction * passed * (glm::dmat3(segment.weights[static_cast<std::size_t>(j)]) * sample(map, path.at(s_g)));
    }
    return xyz;
}

/// Whether all numbers are finite, and the step is 0 or more.
bool is_valid(const StreakSegment& segment) {
    bool valid = std::isfinite(segment.first_nm) && std::isfinite(segment.step_nm) && segment.step_nm >= 0.0F;
    for (const glm::mat3& weight : segment.weights)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 3; ++i) valid = valid && std::isfinite(weight[c][i]);
    return valid;
}

/// Throws Error (input) if the number is not finite or not above 0.
double read_positive(ByteReader& reader, std::string_view name) {
    const auto x = reader.value<double>();
    if (!std::isfinite(x) || !(x > 0.0)) reader.fail(fmt::format("{} {}", name, x), "a number above 0");
    return x;
}

}  // namespace

Streak make_streak(const Grating& grating, const StreakSettings& settings) {
    require_many_grooves(grating);
    const NarrowLobe lobe = narrow_lobe(grating.lobe);
    Streak streak{.pitch_nm = grating.pitch_nm, .sigma = lobe.sigma, .power = lobe.power, .segments = {}};
    const ColourKernel kernel(grating, colour::LightSpectra(settings.illuminant));
    // Across the lobe a node's s_g is about .97 of the angle.
    const double width_nm = 0.97 * map_size(streak, settings.map_resolution).width() * grating.pitch_nm;
    std::vector<KernelRaster> rasters;
    for (const bool positive : {false, true}) {
        rasters.push_back(raster_of(kernel, grating.pitch_nm, positive));
        add_segments(rasters.back(), kNodeDistance * width_nm, streak.segments);
    }
    fit_weights(rasters, width_nm, streak.segments);
    if (kernel.zero_order_xyz() != glm::dmat3(0.0)) {
        streak.segments.emplace_back();
        streak.segments.back().weights[0] = glm::mat3(kernel.zero_order_xyz());
    }
    return streak;
}

StreakMapSize map_size(const Streak& streak, int map_resolution) {
    StreakMapSize size{.side = map_resolution / 4 * 4, .directions = streak.sigma > kWideLobe ? 32 : 16};
    size.length = std::max(streak.sigma, size.width());
    return size;
}

std::optional<Grating> incoherent_part(const Grating& grating) {
    const auto* pits = std::get_if<PitsLobe>(&grating.lobe);
    if (pits == nullptr || pits->coherent >= 1.0) return std::nullopt;
    Grating part = grating;
    part.lobe = PitsLobe{.length_nm = pits->length_nm, .coherent = 0.0};
    return part;
}

glm::dvec3 evaluate(const Streak& streak, const StreakMap& map, const glm::dmat3& axes, const glm::dvec3& view,
                    const std::optional<Cover>& cover) {
    glm::dvec3 xyz(0.0);
    if (!(view.z > 0.0)) return xyz;
    const StreakView at{
        .streak = streak, .axes = axes, .view = view, .length_scale = streak.sigma / map.size.length, .cover = cover};
    for (const StreakSegment& segment : streak.segments) xyz += segment_xyz(segment, map, at);
    return streak.power / std::erf(1.0 / (streak.sigma * std::numbers::sqrt2)) * xyz;
}

int most_seen_nodes(const Streak& streak) {
    std::vector<double> nodes;
    for (const StreakSegment& segment : streak.segments)
        for (int j = 0; j < kSegmentNodes; ++j)
            nodes.push_back(static_cast<double>(segment.path_nm(j)) / streak.pitch_nm);
    std::sort(nodes.begin(), nodes.end());
    std::ptrdiff_t most = 0;
    // A node is visible where x/d − 1 ≤ v_g ≤ x/d + 1. The count has its maximum where a node becomes visible.
    for (auto from = nodes.begin(); from != nodes.end(); ++from)
        most = std::max(most, std::upper_bound(from, nodes.end(), *from + 2.0) - from);
    return static_cast<int>(most);
}

void write(const Streak& streak, ByteWriter& writer) {
    writer.value(streak.pitch_nm);
    writer.value(streak.sigma);
    writer.value(streak.power);
    writer.array(std::span<const StreakSegment>(streak.segments));
}

Streak read_streak(ByteReader& reader) {
    Streak streak;
    streak.pitch_nm = read_positive(reader, "pitch");
    streak.sigma = read_positive(reader, "sigma");
    streak.power = reader.value<double>();
    if (!(streak.power >= 0.0 && streak.power <= 1.0)) reader.fail(fmt::format("power {}", streak.power), "0 to 1");
    streak.segments = reader.array<StreakSegment>();
    if (streak.segments.size() > kMostStreakSegments)
        reader.fail(fmt::format("{} segments", streak.segments.size()), fmt::format("at most {}", kMostStreakSegments));
    for (const StreakSegment& segment : streak.segments)
        if (!is_valid(segment)) reader.fail("a segment with an invalid number", "finite numbers, a step of 0 or more");
    return streak;
}

const RepresentationInfo& StreakSurfaceSettings::info() {
    static const RepresentationInfo info{
        .name = "streak",
        .file_number = 6,
        .summary = "narrow lobes: the whole probe, mirrored along the grooves",
        .lobes = Lobes::Mirroring,
        .key_lights = KeyLightUse::Always,
        .settings = {map_resolution_setting(StreakSettings().map_resolution, 512), bands_setting(), rank_setting(),
                     view_resolution_setting()},
        .replaced = {{"nodes", "map_resolution"}, {"taps", "map_resolution"}},
        .budget = [](const Grating& grating, SurfaceShape) -> std::vector<std::string> {
            if (sees_v_g_alone(grating)) return {};
            return {"map_resolution=128", "map_resolution=192", "map_resolution=320"};
        }};
    return info;
}

StreakSurfaceSettings StreakSurfaceSettings::from(const SettingValues& values, const Grating& grating) {
    StreakSurfaceSettings settings{.streak = {.map_resolution = values.number("map_resolution")}};
    if (incoherent_part(grating))
        settings.incoherent = ArcSettings{.bands = values.number("bands"),
                                          .rank = values.number("rank"),
                                          .grid = view_grid(values, default_view_grid(grating))};
    return settings;
}

void StreakSurfaceSettings::set_illuminant(const colour::Illuminant& white) {
    streak.illuminant = white;
    if (incoherent) incoherent->illuminant = white;
}

StreakTables bake(const Grating& grating, const StreakSurfaceSettings& settings) {
    StreakTables tables{.streak = make_streak(grating, settings.streak), .map = {}};
    tables.map = map_size(tables.streak, settings.streak.map_resolution);
    if (settings.incoherent) tables.incoherent = bake(incoherent_part(grating).value(), *settings.incoherent);
    return tables;
}

void write(const StreakTables& tables, ByteWriter& writer) {
    write(tables.streak, writer);
    if (tables.incoherent) write(*tables.incoherent, writer);
}

StreakTables read(ByteReader& reader, const StreakSurfaceSettings& settings) {
    StreakTables tables{.streak = read_streak(reader), .map = {}};
    tables.map = map_size(tables.streak, settings.streak.map_resolution);
    if (settings.incoherent) tables.incoherent = read(reader, *settings.incoherent);
    return tables;
}

ShadingCost cost(const StreakTables& tables) {
    constexpr std::size_t kHalfTexel = 8;
    constexpr int kLevelsPerLookUp = 2;
    const std::size_t segments = tables.streak.segments.size();
    const int nodes = most_seen_nodes(tables.streak);
    ShadingCost result = tables.incoherent ? cost(*tables.incoherent) : ShadingCost{};
    result.fetches_per_pixel += kLevelsPerLookUp * nodes;
    result.multiply_adds_per_pixel += 22 * nodes + 150 * static_cast<int>(segments);
    const auto side = static_cast<std::size_t>(tables.map.side);
    const std::size_t finest = 2 * side * side * static_cast<std::size_t>(tables.map.directions) * kHalfTexel;
    result.table_bytes += finest + finest / 8 + finest / 64 + segments * sizeof(StreakSegment);
    return result;
}

Facts facts(const StreakTables& tables) {
    Facts result{{"streak", fmt::format("{} nodes, map {} x {} x {}", kSegmentNodes * tables.streak.segments.size(),
                                        2 * tables.map.side, tables.map.side, tables.map.directions)}};
    if (tables.incoherent)
        for (auto& fact : facts(*tables.incoherent)) result.push_back(std::move(fact));
    return result;
}

PointShader point_shader(const StreakTables& tables, const MaterialKernel& material, const EvaluationLight& light) {
    if (!light.probe())
        throw Error({.file = "--probe-sh",
                     .location = {},
                     .found = "band-limited light",
                     .expected = "a probe for streaks",
                     .remedy = "give --probe"});
    PointShader incoherent = [](const ShadingPoint&) { return glm::dvec3(0.0); };
    if (tables.incoherent) incoherent = point_shader(*tables.incoherent, material, light);
    return [map =
                std::make_shared<const StreakMap>(fill_streak_map(lighting::light_samples(*light.probe()), tables.map)),
            streak = tables.streak, incoherent, cover = material.cover](const ShadingPoint& frame) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        const glm::dvec3 view = tangent * glm::normalize(frame.view);
        return evaluate(streak, *map, glm::transpose(tangent), view, cover) + (1.0 - streak.power) * incoherent(frame);
    };
}

}  // namespace rowland::diffraction
