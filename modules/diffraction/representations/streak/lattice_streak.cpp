#include "modules/diffraction/representations/streak/lattice_streak.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <span>

#include "modules/diffraction/bake/lattice_orders.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/representations/streak/streak_fit.h"
#include "modules/diffraction/representations/streak/streak_path.h"

namespace rowland::diffraction {

namespace {

/// A node's deviation along its ray over the map's width.
constexpr double kRayDeviation = 2.0;
constexpr double kKeptPower = 0.99;
/// Of the raster of |u|.
constexpr double kRasterStep = 0.002;
constexpr std::size_t kRasterIntervals = 1001;
constexpr double kLeastStep = 1e-6;  ///< in u

struct Ray {
    glm::dvec2 direction{1.0, 0.0};
    KernelRaster raster;
    double power = 0.0;
};

/// Adds all wavelengths of an order, each to the two intervals beside it.
void add_order(const LatticeOrder& order, const colour::LightSpectra& spectra, Ray& ray) {
    const double u_per_nm = glm::length(order.u_per_nm);
    for (std::size_t j = 0; j < kWavelengths; ++j) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
        const double at = wavelength_nm * u_per_nm / kRasterStep;
        const auto below = static_cast<std::size_t>(at);
        if (below + 1 >= ray.raster.sums.size()) break;
        const glm::dmat3 weight = (j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) * order.efficiency[j] *
                                  observed_spectra(spectra, wavelength_nm);
        const double t = at - static_cast<double>(below);
        ray.raster.sums[below] += (1.0 - t) * weight;
        ray.raster.sums[below + 1] += t * weight;
        ray.power += element_sum(weight);
    }
}

/// The orders by their direction, brightest first.
std::vector<Ray> rays_of(const Grating& grating, const colour::LightSpectra& spectra) {
    constexpr double kSameDirection = 1e-6;  // radians
    std::map<long, Ray> by_angle;
    for (const LatticeOrder& order : shaded_lattice_orders(grating)) {
        Ray& ray = by_angle[std::lround(std::atan2(order.u_per_nm.y, order.u_per_nm.x) / kSameDirection)];
        if (ray.raster.sums.empty()) {
            ray.direction = glm::normalize(order.u_per_nm);
            ray.raster = {.first_nm = 0.0, .step_nm = kRasterStep * grating.pitch_nm, .sums = {}};
            ray.raster.sums.assign(kRasterIntervals, glm::dmat3(0.0));
        }
        add_order(order, spectra, ray);
    }
    std::vector<Ray> rays;
    for (auto& [angle, ray] : by_angle) rays.push_back(std::move(ray));
    std::stable_sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.power > b.power; });
    return rays;
}

/// The same for all points of a view.
struct LatticeView {
    const glm::dmat3& axes;
    glm::dvec2 v_p{0.0};
    double length_scale = 1.0;  ///< a node's deviation in u over the map's

    /// How far a ray is above the horizon: u = 0, the mirror's direction, is.
    double horizon(const glm::dvec2& ray) const {
        const double b = glm::dot(ray, v_p);
        return b + std::sqrt(std::max(b * b + 1.0 - glm::dot(v_p, v_p), 0.0));
    }
};

/// The light at u = r · ray.
LobePoint lobe_point(const LatticeView& at, const glm::dvec2& ray, double r) {
    const glm::dvec2 s_p = r * ray - at.v_p;
    const double s_n = std::sqrt(std::max(1.0 - glm::dot(s_p, s_p), kLeastSquare));
    const double along = glm::dot(ray, s_p);
    return {.direction = at.axes * glm::dvec3(s_p, s_n),
            .along = at.axes * glm::dvec3(s_n * ray, -along),
            .level = std::log2(at.length_scale * std::sqrt(s_n * s_n + along * along) / s_n)};
}

glm::dvec3 segment_radiance(const RaySegment& segment, double pitch_nm, const StreakMap& map, const LatticeView& at,
                            const std::optional<Cover>& cover) {
    const glm::dvec2 ray(segment.direction);
    const double horizon = at.horizon(ray);
    const double first = static_cast<double>(segment.nodes.first_nm) / pitch_nm;
    const double step = std::max(static_cast<double>(segment.nodes.step_nm) / pitch_nm, kLeastStep);
    if (first > horizon + 0.5 * step) return glm::dvec3(0.0);
    const double low = std::min(first, horizon);
    const double high = std::min(first + (kSegmentNodes - 1) * step, horizon);
    const StreakPath path(low, high, lobe_point(at, ray, low), lobe_point(at, ray, 0.5 * (low + high)),
                          lobe_point(at, ray, high));
    glm::dvec3 xyz(0.0);
    for (int j = 0; j < kSegmentNodes; ++j) {
        const double distance = first + j * step;
        const double fraction = std::clamp((horizon - distance) / step + 0.5, 0.0, 1.0);
        if (fraction == 0.0) continue;
        const double r = std::min(distance, high);
        const glm::dvec2 s_p = r * ray - at.v_p;
        const double passed = transmittance(cover, std::sqrt(std::max(1.0 - glm::dot(s_p, s_p), kLeastSquare)));
        xyz += fraction * passed *
               (glm::dmat3(segment.nodes.weights[static_cast<std::size_t>(j)]) * sample(map, path.at(r)));
    }
    return xyz;
}

}  // namespace

StreakMapSize lattice_map_size(int map_resolution) {
    StreakMapSize size{.side = map_resolution / 4 * 4, .turns = 16};
    size.length = kRayDeviation * size.width();
    return size;
}

LatticeStreak make_lattice_streak(const Grating& grating, const StreakSettings& settings) {
    require_many_grooves(grating);
    LatticeStreak streak{
        .pitch_nm = grating.pitch_nm, .deviation = lattice_map_size(settings.map_resolution).length, .segments = {}};
    const double deviation_nm = streak.deviation * grating.pitch_nm;
    const std::vector<Ray> rays = rays_of(grating, colour::LightSpectra(settings.illuminant));
    double whole = 0.0;
    for (const Ray& ray : rays) whole += ray.power;
    double kept = 0.0;
    for (const Ray& ray : rays) {
        if (kept >= kKeptPower * whole) break;
        std::vector<StreakSegment> segments;
        add_segments(ray.raster, kNodeDistance * deviation_nm, segments);
        if (streak.segments.size() + segments.size() > kMostStreakSegments) break;
        fit_weights(std::span(&ray.raster, 1), deviation_nm, segments);
        for (const StreakSegment& nodes : segments)
            streak.segments.push_back({.direction = glm::vec2(ray.direction), .nodes = nodes});
        kept += ray.power;
    }
    for (RaySegment& segment : streak.segments)
        for (glm::mat3& weight : segment.nodes.weights) weight *= static_cast<float>(whole / kept);
    return streak;
}

glm::dvec3 evaluate(const LatticeStreak& streak, const StreakMap& map, const glm::dmat3& axes, const glm::dvec3& view,
                    const std::optional<Cover>& cover) {
    glm::dvec3 xyz(0.0);
    if (view.z <= 0.0) return xyz;
    const LatticeView at{.axes = axes, .v_p = glm::dvec2(view), .length_scale = streak.deviation / map.size.length};
    for (const RaySegment& segment : streak.segments) xyz += segment_radiance(segment, streak.pitch_nm, map, at, cover);
    return xyz;
}

bool is_valid(const RaySegment& segment) {
    return is_valid(segment.nodes) && std::abs(glm::length(segment.direction) - 1.0F) < 1e-3F;
}

void write(const LatticeStreak& streak, ByteWriter& writer) {
    writer.value(streak.pitch_nm);
    writer.value(streak.deviation);
    writer.array(std::span<const RaySegment>(streak.segments));
}

LatticeStreak read_lattice_streak(ByteReader& reader) {
    LatticeStreak streak;
    streak.pitch_nm = read_positive(reader, "pitch");
    streak.deviation = read_positive(reader, "deviation");
    streak.segments = read_segments<RaySegment>(reader, "finite numbers, a unit direction, a step of 0 or more");
    return streak;
}

}  // namespace rowland::diffraction
