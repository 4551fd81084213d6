#include "editor/trade/measure_error.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/colour/delta_e.h"
#include "engine/colour/srgb.h"
#include "engine/colour/working_space.h"
#include "engine/core/check.h"
#include "engine/post/display_transform.h"
#include "engine/post/working_space.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/radiance_error.h"

namespace rowland::trade {

namespace {

glm::dvec3 srgb_to_linear(const glm::vec3& encoded) {
    glm::dvec3 linear;
    for (int i = 0; i < 3; ++i) linear[i] = colour::srgb_linear(static_cast<double>(encoded[i]));
    return linear;
}

glm::dvec3 display_lab(const glm::vec3& encoded) {
    return colour::xyz_to_lab(colour::rec709_to_xyz() * srgb_to_linear(encoded), colour::white_d65());
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
    const float stops = diffraction::exposure_for(reference);
    const std::vector<double> differences =
        display_differences(displayed(radiance, stops), displayed(reference, stops));
    return {.relative_rms = diffraction::relative_rms(radiance, reference),
            .largest = largest_error(radiance, reference),
            .dark_absolute = dark_error(radiance, reference),
            .median_delta_e = diffraction::quantile(differences, 0.5),
            .high_delta_e = diffraction::quantile(differences, 0.95)};
}

MethodError compare_pictures(const PictureFrames& frames, std::span<const glm::dvec3> radiance,
                             std::span<const glm::dvec3> reference) {
    MethodError error = compare(radiance, reference);
    error.flip = mean_hdr_flip(frames, radiance, reference);
    return error;
}

}  // namespace rowland::trade
