#include "tests/evidence/peers/properties.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "engine/colour/colour_space.h"
#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"

namespace rowland::evidence {

namespace {

constexpr double kDegree = glm::pi<double>() / 180.0;
constexpr double kPitch_nm = 1600.0;

/// A point whose tangent frame is the world's axes.
diffraction::ShadingPoint seen_from(const glm::dvec3& view) {
    return {.view = view, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
}

/// The hemisphere in cells of equal solid angle, each a light.
std::vector<render::DistantLight> white_hemisphere() {
    constexpr int kRings = 128;
    constexpr int kSectors = 512;
    std::vector<render::DistantLight> lights;
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector) {
            const double z = (ring + 0.5) / kRings;
            const double r = std::sqrt(1.0 - z * z);
            const double azimuth = 2.0 * glm::pi<double>() * (sector + 0.5 * (ring % 2)) / kSectors;
            lights.push_back({glm::vec3(r * std::cos(azimuth), r * std::sin(azimuth), z),
                              glm::vec3(static_cast<float>(2.0 * glm::pi<double>() / (kRings * kSectors)))});
        }
    return lights;
}

/// Where the disc's own green is brightest: light of a white lamp in one order, equal efficiency.
double green_wavelength_nm() {
    const colour::LightSpectra spectra;
    const glm::dmat3 to_rgb = colour::xyz_to_rec709();
    double best = 0.0;
    double most = 0.0;
    for (double nm = 450.0; nm <= 650.0; nm += 0.25) {
        const glm::dvec3 light = spectra(nm);
        const double green = (to_rgb * (colour::cie_xyz(nm) * (light.x + light.y + light.z))).y;
        if (green > most) {
            most = green;
            best = nm;
        }
    }
    return best;
}

constexpr std::ptrdiff_t kNearMirror = 66;  ///< steps of a sweep: 1.5 degrees

/// Green of views along a sweep.
using Green =
    std::function<std::vector<double>(const std::vector<diffraction::ShadingPoint>&, const glm::dvec3& light)>;

/// The first peak from `start` on, outward: after green has stopped falling, the largest value until it has fallen to
/// half of it. Peaks below a tenth of the sweep's largest value do not count.
std::optional<std::size_t> first_peak(const std::vector<double>& green, std::size_t start, int step) {
    const double floor = 0.1 * *std::max_element(green.begin(), green.end());
    const auto inside = [&](std::ptrdiff_t i) { return i >= 0 && i < static_cast<std::ptrdiff_t>(green.size()); };
    const auto at = [&](std::ptrdiff_t i) { return green[static_cast<std::size_t>(i)]; };
    auto i = static_cast<std::ptrdiff_t>(start);
    while (inside(i + step) && at(i + step) <= at(i)) i += step;
    std::ptrdiff_t best = i;
    std::ptrdiff_t last = i;  // of equal values
    for (; inside(i) && (at(best) <= floor || at(i) > 0.5 * at(best)); i += step) {
        if (at(i) > at(best)) best = last = i;
        if (at(i) == at(best) && i == last + step) last = i;
    }
    // A value that still rises at the horizon is no peak, nor is the mirror's direction.
    if (std::abs(best - static_cast<std::ptrdiff_t>(start)) < kNearMirror) return std::nullopt;
    if (at(best) <= floor || !inside(last + step) || !inside(last + step + step)) return std::nullopt;
    return static_cast<std::size_t>((best + last) / 2);
}

/// The largest error of both first orders along the sweep of direction cosines v_x, v_y fixed.
std::optional<double> sweep_error(const Green& green, const glm::dvec3& light) {
    constexpr int kSteps = 8000;
    std::vector<diffraction::ShadingPoint> points;
    std::vector<double> cosines;
    const double reach = std::sqrt(1.0 - light.y * light.y);
    for (int i = 1; i < kSteps; ++i) {
        const double x = reach * std::sin((2.0 * i / kSteps - 1.0) * 0.5 * glm::pi<double>());
        cosines.push_back(x);
        points.push_back(seen_from({x, -light.y, std::sqrt(std::max(reach * reach - x * x, 0.0))}));
    }
    const std::vector<double> values = green(points, light);
    if (*std::max_element(values.begin(), values.end()) <= 0.0) return std::nullopt;
    const auto mirror =
        static_cast<std::size_t>(std::lower_bound(cosines.begin(), cosines.end(), -light.x) - cosines.begin());
    const double shift = green_wavelength_nm() / kPitch_nm;
    double worst = 0.0;
    for (const int side : {-1, 1}) {
        const double expected = side * shift - light.x;
        if (std::abs(expected) >= 0.97 * reach) continue;  // behind the horizon, or cut by it
        const auto peak = first_peak(values, mirror, side);
        if (!peak) return std::nullopt;
        const glm::dvec3 true_view(expected, -light.y, std::sqrt(reach * reach - expected * expected));
        worst = std::max(worst, std::acos(std::min(glm::dot(true_view, points[*peak].view), 1.0)) / kDegree);
    }
    return worst;
}

DirectionError measured(const Green& green) {
    DirectionError result;
    result.across = 0.0;
    for (const double incidence : {0.0, 30.0, 60.0}) {
        const auto error = sweep_error(green, {std::sin(incidence * kDegree), 0.0, std::cos(incidence * kDegree)});
        if (!error) result.across = std::nullopt;
        if (result.across) result.across = std::max(*result.across, *error);
    }
    result.along = sweep_error(green, {0.0, std::sin(45.0 * kDegree), std::cos(45.0 * kDegree)});
    return result;
}

}  // namespace

ReturnedEnergy returned_energy(const PeerSetting& setting) {
    std::vector<diffraction::ShadingPoint> points;
    for (const double angle : {0.0, 30.0, 60.0}) {
        points.push_back(seen_from({std::sin(angle * kDegree), 0.0, std::cos(angle * kDegree)}));
        points.push_back(seen_from({0.0, std::sin(angle * kDegree), std::cos(angle * kDegree)}));
    }
    std::vector<double> luminances;
    for (const glm::dvec3& rgb : PointPass(points).draw(setting, white_hemisphere()))
        luminances.push_back(colour::luminance(rgb));
    const auto [least, most] = std::minmax_element(luminances.begin(), luminances.end());
    return {*least, *most};
}

DirectionError direction_error(const PeerSetting& setting) {
    return measured([&](const std::vector<diffraction::ShadingPoint>& points, const glm::dvec3& light) {
        const std::vector<render::DistantLight> lights{{glm::vec3(light), glm::vec3(1.0F)}};
        std::vector<double> green;
        for (const glm::dvec3& rgb : PointPass(points).draw(setting, lights)) green.push_back(rgb.y);
        return green;
    });
}

DirectionError direction_error_of_direct() {
    return measured([&](const std::vector<diffraction::ShadingPoint>& points, const glm::dvec3& light) {
        const glm::dmat3 to_rgb = colour::xyz_to_rec709();
        std::vector<double> green;
        for (const glm::dvec3& xyz : disc_by_direct(points, light)) green.push_back((to_rgb * xyz).y);
        return green;
    });
}

}  // namespace rowland::evidence
