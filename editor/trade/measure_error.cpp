#include "editor/trade/measure_error.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "editor/trade/hdr_flip.h"
#include "engine/colour/delta_e.h"
#include "engine/colour/srgb.h"
#include "engine/colour/working_space.h"
#include "engine/core/check.h"
#include "engine/post/display_transform.h"
#include "engine/post/working_space.h"
#include "modules/diffraction/evaluate/radiance_error.h"

namespace rowland::trade {

namespace {

constexpr double kMiddleGrey = 0.18;

glm::dvec3 srgb_to_linear(const glm::vec3& encoded) {
    glm::dvec3 linear;
    for (int i = 0; i < 3; ++i) linear[i] = colour::srgb_linear(static_cast<double>(encoded[i]));
    return linear;
}

glm::dvec3 display_lab(const glm::vec3& encoded) {
    return colour::xyz_to_lab(colour::rec709_to_xyz() * srgb_to_linear(encoded), colour::white_d65());
}

double quantile(const std::vector<double>& sorted, double fraction) {
    if (sorted.empty()) return 0.0;
    const auto index = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
    return sorted[std::clamp<std::size_t>(index, 1, sorted.size()) - 1];
}

double largest_error(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference) {
    double error = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        error = std::max(error, glm::length(radiance[i] - reference[i]));
        scale = std::max(scale, glm::length(reference[i]));
    }
    return error == 0.0 ? 0.0 : error / scale;
}

double dark_error(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference) {
    double mean = 0.0;
    for (const glm::dvec3& xyz : reference) mean += xyz.y / static_cast<double>(reference.size());
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        if (reference[i].y >= kDark * mean) continue;
        sum += std::abs(radiance[i].y - reference[i].y);
        ++count;
    }
    return count == 0 ? 0.0 : sum / count / mean;
}

}  // namespace

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

std::vector<glm::vec3> displayed(std::span<const glm::dvec3> xyz, float exposure_stops) {
    const auto config = post::OcioConfig::shipped();
    const glm::dmat3 to_working = post::xyz_to_scene_linear(config);
    std::vector<glm::vec3> pixels;
    for (const glm::dvec3& value : xyz) pixels.emplace_back(to_working * value);
    post::DisplayTransform(config).apply_cpu(pixels, exposure_stops);
    for (glm::vec3& pixel : pixels) pixel = glm::clamp(pixel, 0.0F, 1.0F);
    return pixels;
}

std::vector<double> display_differences(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    ROWLAND_CHECK_OP(a.size(), ==, b.size());
    std::vector<double> result;
    for (std::size_t i = 0; i < a.size(); ++i)
        result.push_back(colour::delta_e_2000(display_lab(a[i]), display_lab(b[i])));
    return result;
}

MethodError compare(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference) {
    ROWLAND_CHECK_OP(radiance.size(), ==, reference.size());
    const float stops = exposure_for(reference);
    std::vector<double> differences = display_differences(displayed(radiance, stops), displayed(reference, stops));
    std::sort(differences.begin(), differences.end());
    return {.relative_rms = diffraction::relative_rms(radiance, reference),
            .largest = largest_error(radiance, reference),
            .dark_absolute = dark_error(radiance, reference),
            .median_delta_e = quantile(differences, 0.5),
            .high_delta_e = quantile(differences, 0.95)};
}

MethodError compare_pictures(const PictureFrames& frames, std::span<const glm::dvec3> radiance,
                             std::span<const glm::dvec3> reference) {
    MethodError error = compare(radiance, reference);
    const std::vector<double> map =
        hdr_flip(picture(frames, radiance), picture(frames, reference), frames.width, frames.height);
    double sum = 0.0;
    for (const std::size_t pixel : frames.pixels) sum += map[pixel];
    error.flip = frames.pixels.empty() ? 0.0 : sum / static_cast<double>(frames.pixels.size());
    return error;
}

}  // namespace rowland::trade
