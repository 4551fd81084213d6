#include "modules/diffraction/evaluate/measured_picture.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "engine/colour/hdr_flip.h"
#include "engine/core/check.h"

namespace rowland::diffraction {

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

}  // namespace rowland::diffraction
