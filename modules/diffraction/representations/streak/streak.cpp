#include "modules/diffraction/representations/streak/streak.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/matrix.hpp>
#include <numbers>
#include <span>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/representations/streak/streak_fit.h"
#include "modules/diffraction/representations/streak/streak_path.h"

namespace rowland::diffraction {

namespace {

/// A lobe of more than this deviation has twice as many directions in its map.
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
                 .found = is_flat(lobe) ? "flat" : "pits without a coherent part",
                 .expected = "a narrow lobe: sigma, or pits with a coherent part, for the representation \"streak\"",
                 .remedy = "use \"arc\", \"transfer\" or \"spikes\""});
}

/// On one side of x = 0, as far as a direction can see.
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

/// The same for all points of a view.
struct StreakView {
    const Streak& streak;
    const glm::dmat3& axes;
    glm::dvec3 view{0.0};
    double length_scale = 1.0;  ///< the lobe's deviation over the map's
    std::optional<Cover> cover = std::nullopt;

    double side() const { return std::abs(view.y); }
    /// Radii √(1 − s_g²) from which on some and all of the lobe is above the horizon.
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
    StreakMapSize size{.side = map_resolution / 4 * 4, .turns = streak.sigma > kWideLobe ? 32 : 16};
    size.length = std::max(streak.sigma, size.width());
    return size;
}

std::optional<Grating> incoherent_rest(const Grating& grating) {
    const auto* pits = std::get_if<PitsLobe>(&grating.lobe);
    if (pits == nullptr || pits->coherent >= 1.0) return std::nullopt;
    Grating rest = grating;
    rest.lobe = PitsLobe{.length_nm = pits->length_nm, .coherent = 0.0};
    return rest;
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
    streak.segments = read_segments<StreakSegment>(reader, "finite numbers, a step of 0 or more");
    return streak;
}

}  // namespace rowland::diffraction
