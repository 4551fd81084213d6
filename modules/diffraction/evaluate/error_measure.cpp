#include "modules/diffraction/evaluate/error_measure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
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

constexpr int kSide = 32;
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

}  // namespace

std::vector<ShadingPoint> measured_points(ErrorMeasure measure, SurfaceShape surface) {
    return measure == ErrorMeasure::HdrFlip ? measured_picture(surface).points : measured_frames(surface);
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
