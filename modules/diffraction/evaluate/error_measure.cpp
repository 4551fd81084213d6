#include "modules/diffraction/evaluate/error_measure.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "engine/colour/colour_difference.h"
#include "engine/colour/colour_space.h"
#include "engine/core/check.h"
#include "engine/core/file.h"
#include "engine/core/text.h"

namespace rowland::diffraction {

double relative_rms(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference) {
    ROWLAND_CHECK(radiance.size() == reference.size(), "one value per frame in both");
    double difference = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        const glm::dvec3 error = radiance[i] - reference[i];
        difference += glm::dot(error, error);
        scale += glm::dot(reference[i], reference[i]);
    }
    if (difference == 0.0) return 0.0;
    return scale > 0.0 ? std::sqrt(difference / scale) : std::numeric_limits<double>::infinity();
}

/// The files of frames/.
std::span<const EmbeddedFile> frame_files();

std::vector<ShadingPoint> measured_frames(SurfaceShape surface) {
    const std::string file = std::string("modules/diffraction/evaluate/frames/") +
                             (surface == SurfaceShape::Flat ? "tilted_disc.csv" : "sphere.csv");
    const NumberTable table =
        parse_number_table(embedded_text(frame_files(), file), file, "vx,vy,vz,nx,ny,nz,gx,gy,gz");
    std::vector<ShadingPoint> frames;
    for (const std::vector<double>& x : table.rows) {
        frames.push_back({.view = {x[0], x[1], x[2]}, .normal = {x[3], x[4], x[5]}, .grating = {x[6], x[7], x[8]}});
        ROWLAND_CHECK(is_valid(frames.back()), "a built-in frame has three directions");
    }
    return frames;
}

namespace {

constexpr int kSide = 16;                 // of the picture, in pixels
constexpr double kEyeDistance = 3.0;      // radii
constexpr double kHalfExtent = 1.07;      // of the picture, in the plane of the centre; the sphere's outline is 1.061
constexpr double kInnerRadius = 0.405;    // of a compact disc's grooves, 23.5 of 58 mm
constexpr double kLeastViewCosine = 0.1;  // v_n

std::optional<ShadingPoint> on_disc(const glm::dvec3& eye, const glm::dvec3& ray) {
    const glm::dvec3 normal(0.0, std::cos(glm::radians(35.0)), std::sin(glm::radians(35.0)));
    const glm::dvec3 at = eye - glm::dot(eye, normal) / glm::dot(ray, normal) * ray;
    const double radius = glm::length(at);
    if (radius < kInnerRadius || radius > 1.0) return std::nullopt;
    return ShadingPoint{.view = -ray, .normal = normal, .grating = at / radius};
}

std::optional<ShadingPoint> on_sphere(const glm::dvec3& eye, const glm::dvec3& ray) {
    const double b = glm::dot(eye, ray);
    const double under_root = b * b - glm::dot(eye, eye) + 1.0;
    if (under_root <= 0.0) return std::nullopt;
    const glm::dvec3 normal = glm::normalize(eye - (b + std::sqrt(under_root)) * ray);
    if (-glm::dot(ray, normal) < kLeastViewCosine) return std::nullopt;
    return ShadingPoint{
        .view = -ray, .normal = normal, .grating = glm::normalize(glm::dvec3(normal.z, 0.0, -normal.x))};
}

}  // namespace

std::vector<glm::dvec3> picture(const PictureLayout& layout, std::span<const glm::dvec3> radiance) {
    ROWLAND_CHECK_OP(radiance.size(), ==, layout.pixels.size());
    std::vector<glm::dvec3> pixels(static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height),
                                   glm::dvec3(0.0));
    for (std::size_t i = 0; i < radiance.size(); ++i) pixels[layout.pixels[i]] = radiance[i];
    return pixels;
}

double mean_hdr_flip(const PictureLayout& layout, std::span<const glm::dvec3> radiance,
                     std::span<const glm::dvec3> reference) {
    if (layout.pixels.empty()) return 0.0;
    const std::vector<double> map =
        colour::hdr_flip(picture(layout, radiance), picture(layout, reference), layout.width, layout.height);
    double sum = 0.0;
    for (const std::size_t pixel : layout.pixels) sum += map[pixel];
    return sum / static_cast<double>(layout.pixels.size());
}

MeasuredPicture measured_picture(SurfaceShape surface) {
    const bool flat = surface == SurfaceShape::Flat;
    const glm::dvec3 toward_eye = flat ? glm::normalize(glm::dvec3(0.0, 0.7, 0.7)) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 right(1.0, 0.0, 0.0);
    const glm::dvec3 up = glm::cross(toward_eye, right);
    const glm::dvec3 eye = kEyeDistance * toward_eye;
    MeasuredPicture result{.layout = {.width = kSide, .height = kSide, .pixels = {}}, .points = {}};
    for (int row = 0; row < kSide; ++row)
        for (int column = 0; column < kSide; ++column) {
            const double x = kHalfExtent * (2.0 * (column + 0.5) / kSide - 1.0);
            const double y = kHalfExtent * (1.0 - 2.0 * (row + 0.5) / kSide);
            const glm::dvec3 ray = glm::normalize(x * right + y * up - eye);
            const std::optional<ShadingPoint> point = flat ? on_disc(eye, ray) : on_sphere(eye, ray);
            if (!point) continue;
            result.points.push_back(*point);
            result.layout.pixels.push_back(static_cast<std::size_t>(row * kSide + column));
        }
    return result;
}

namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kSeenFraction = 0.95;

/// CIEDE2000 that 95 % of the points do not exceed, both exposed for the reference and clipped to Rec. 709.
double high_delta_e(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference) {
    ROWLAND_CHECK_OP(radiance.size(), ==, reference.size());
    const glm::dmat3 to_xyz = colour::rec709_to_xyz();
    const glm::dmat3 to_rgb = std::exp2(double{exposure_for(reference)}) * glm::inverse(to_xyz);
    const auto lab = [&](const glm::dvec3& xyz) {
        return colour::xyz_to_lab(to_xyz * glm::clamp(to_rgb * xyz, 0.0, 1.0), colour::white_d65());
    };
    std::vector<double> differences;
    for (std::size_t i = 0; i < reference.size(); ++i)
        differences.push_back(colour::delta_e_2000(lab(radiance[i]), lab(reference[i])));
    return quantile(std::move(differences), kSeenFraction);
}

constexpr std::size_t kPointsPerPart = 30;
constexpr std::size_t kAimedOf = 5;  ///< one point of so many has its g toward a bright texel

/// Gratings of different colours get different views.
std::uint64_t seed_of(const Grating& grating) {
    std::uint64_t seed = std::bit_cast<std::uint64_t>(grating.pitch_nm);
    for (const double nm : {450.0, 550.0, 650.0}) {
        std::vector<double> efficiencies;
        if (grating.lattice)
            efficiencies = lattice_order_efficiencies(grating, nm);
        else
            for (const int order : grating.orders) efficiencies.push_back(order_efficiency(grating, order, nm));
        for (const double efficiency : efficiencies) seed = 31 * seed + std::bit_cast<std::uint64_t>(efficiency);
    }
    return seed;
}

/// Random directions, the same with every compiler.
class Draw {
 public:
    Draw(std::uint64_t seed, const lighting::ProbeImage& probe) : random_(seed), probe_(probe) {
        const image::Image& image = probe.image();
        for (int row = 0; row < image.height; ++row)
            for (int column = 0; column < image.width; ++column) {
                const glm::dvec3 texel(image.texels[brightness_.size()]);
                const double brightness = glm::dot(texel, texel) * probe.solid_angle(column, row);
                brightness_.push_back((brightness_.empty() ? 0.0 : brightness_.back()) + brightness);
            }
    }

    double fraction() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
    glm::dvec3 direction() {
        const double z = 2.0 * fraction() - 1.0;
        const double azimuth = 2.0 * std::numbers::pi * fraction();
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(azimuth), r * std::sin(azimuth), z};
    }
    /// A direction perpendicular to n; `aimed`: as near as possible to a texel, drawn in proportion to its solid angle
    /// times the square of its radiance.
    glm::dvec3 grating(const glm::dvec3& n, bool aimed) {
        for (;;) {
            const glm::dvec3 toward = aimed && brightness_.back() > 0.0 ? bright() : direction();
            const glm::dvec3 across = toward - glm::dot(toward, n) * n;
            if (glm::length(across) > 1e-3) return glm::normalize(across);
            aimed = false;
        }
    }
    /// Drawn in proportion to the projected area that the eye sees, down to v_n = kLeastViewCosine.
    glm::dvec3 view(const glm::dvec3& n) {
        const double cosine = std::sqrt(1.0 - fraction() * (1.0 - kLeastViewCosine * kLeastViewCosine));
        return cosine * n + std::sqrt(1.0 - cosine * cosine) * grating(n, false);
    }

 private:
    glm::dvec3 bright() {
        const auto found = std::upper_bound(brightness_.begin(), brightness_.end(), fraction() * brightness_.back());
        const auto texel = static_cast<int>(std::min(found, brightness_.end() - 1) - brightness_.begin());
        const int width = probe_.image().width;
        const int row = texel / width;
        return probe_.direction(texel % width + 0.5, row + 0.5);
    }

    std::mt19937_64 random_;
    const lighting::ProbeImage& probe_;
    std::vector<double> brightness_;  ///< cumulative: sum over the texels up to each one
};

/// Poses come in pairs of opposite normals. A point of a curved object is a pose of its own.
std::vector<ShadingPoint> drawn_part(GrooveLayout layout, std::size_t points_per_pose, Draw& draw) {
    std::vector<ShadingPoint> points;
    glm::dvec3 n(0.0);
    for (std::size_t i = 0; i < kPointsPerPart; ++i) {
        const std::size_t pose = i / points_per_pose;
        const bool starts = i % points_per_pose == 0;
        if (starts) n = pose % 2 == 0 ? draw.direction() : -n;
        const bool aimed = (layout == GrooveLayout::FlatUniform ? pose : i) % kAimedOf == 0;
        const bool same_g = layout == GrooveLayout::FlatUniform && !starts;
        const glm::dvec3 g = same_g ? points.back().grating : draw.grating(n, aimed);
        points.push_back({.view = draw.view(n), .normal = n, .grating = g});
    }
    return points;
}

/// The picture with its camera, rotated at random.
std::vector<ShadingPoint> drawn_picture(GrooveLayout layout, std::vector<ShadingPoint> points, Draw& draw) {
    const glm::dvec3 n = draw.direction();
    const glm::dvec3 g = draw.grating(n, false);
    const glm::dmat3 rotation(g, glm::cross(n, g), n);
    for (ShadingPoint& point : points)
        point = {.view = rotation * point.view,
                 .normal = rotation * point.normal,
                 .grating = layout == GrooveLayout::FlatUniform ? g : rotation * point.grating};
    return points;
}

}  // namespace

MeasuredViews drawn_views(const Material& material, const lighting::ProbeImage& probe) {
    const bool curved = material.quality.surface == SurfaceShape::Curved;
    const GrooveLayout flat = material.grating.lattice ? GrooveLayout::FlatUniform : GrooveLayout::Flat;
    MeasuredViews views{.layout = curved ? GrooveLayout::Curved : flat, .parts = {}};
    // Few poses: each fills a map of all azimuths and views, which takes a second.
    const bool has_volume = views.layout == GrooveLayout::Flat && !sees_v_g_alone(material.grating);
    const std::size_t points_per_pose = curved ? 1 : has_volume ? 15 : 5;
    const bool pictures = material.quality.measure == ErrorMeasure::HdrFlip;
    const std::vector<ShadingPoint> picture =
        pictures ? measured_picture(material.quality.surface).points : std::vector<ShadingPoint>();
    Draw draw(seed_of(material.grating), probe);
    for (std::size_t i = 0; i < kViewParts; ++i)
        views.parts.push_back(pictures ? drawn_picture(views.layout, picture, draw)
                                       : drawn_part(views.layout, points_per_pose, draw));
    return views;
}

ErrorFunction error_function(ErrorMeasure measure, SurfaceShape surface) {
    if (measure == ErrorMeasure::DeltaE) return high_delta_e;
    if (measure == ErrorMeasure::RelativeRms) return relative_rms;
    return [layout = measured_picture(surface).layout](std::span<const glm::dvec3> radiance,
                                                       std::span<const glm::dvec3> reference) {
        return mean_hdr_flip(layout, radiance, reference);
    };
}

float exposure_for(std::span<const glm::dvec3> xyz) {
    double sum = 0.0;
    int lit = 0;
    for (const glm::dvec3& value : xyz)
        if (value.y > 0.0) {
            sum += value.y;
            ++lit;
        }
    return lit == 0 ? 0.0F : static_cast<float>(std::log2(kMiddleGrey * lit / sum));
}

double quantile(std::vector<double> values, double fraction) {
    if (values.empty()) return 0.0;
    const auto count = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
    const std::size_t index = std::clamp<std::size_t>(count, 1, values.size()) - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values.end());
    return values[index];
}

}  // namespace rowland::diffraction
