#include "editor/trade/measure_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/colour/colour_difference.h"
#include "engine/colour/colour_space.h"
#include "engine/core/check.h"
#include "engine/image/byte_image.h"
#include "engine/post/display_pass.h"
#include "engine/post/ocio_config.h"
#include "modules/diffraction/evaluate/error_measure.h"

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

constexpr int kPanels = 3;
constexpr int kGap = 2;  ///< pixels between panels, before they are magnified

std::vector<glm::vec3> difference_colours(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    std::vector<glm::vec3> colours;
    for (const double difference : display_differences(a, b))
        colours.push_back(difference_colour(difference / kFullDifference));
    return colours;
}

void draw_panel(const std::vector<glm::vec3>& panel, int width, int left, int magnified, RgbPicture& picture) {
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < width * magnified; ++column) {
            const glm::vec3 colour = panel[static_cast<std::size_t>(row / magnified * width + column / magnified)];
            for (int c = 0; c < 3; ++c)
                picture.rgb[static_cast<std::size_t>(3 * (row * picture.width + left + column) + c)] =
                    static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(colour[c], 0.0F, 1.0F)));
        }
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t j) { return j < bytes.size() ? std::to_integer<unsigned>(bytes[j]) : 0U; };
        const unsigned triple = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
        for (unsigned digit = 0; digit < 4; ++digit)
            text += i + digit > bytes.size() ? '=' : kDigits[triple >> (18U - 6U * digit) & 63U];
    }
    return text;
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

// Even steps of lightness, distinct for colour-blind readers as well: after matplotlib's viridis, from black.
glm::vec3 difference_colour(double fraction) {
    constexpr std::array<std::array<float, 3>, 6> kStops = {{{0.0F, 0.0F, 0.0F},
                                                             {0.267F, 0.005F, 0.329F},
                                                             {0.229F, 0.322F, 0.546F},
                                                             {0.128F, 0.567F, 0.551F},
                                                             {0.369F, 0.789F, 0.383F},
                                                             {0.993F, 0.906F, 0.144F}}};
    const double at = std::clamp(fraction, 0.0, 1.0) * (kStops.size() - 1);
    const auto first = std::min<std::size_t>(static_cast<std::size_t>(at), kStops.size() - 2);
    const auto stop = [&](std::size_t i) { return glm::vec3(kStops[i][0], kStops[i][1], kStops[i][2]); };
    return glm::mix(stop(first), stop(first + 1), static_cast<float>(at - static_cast<double>(first)));
}

RgbPicture difference_image(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, int width, int height,
                            int magnified) {
    ROWLAND_CHECK_OP(a.size(), ==, b.size());
    ROWLAND_CHECK_OP(a.size(), ==, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const float stops = diffraction::exposure_for(b);
    const std::vector<glm::vec3> shown_a = displayed(a, stops);
    const std::vector<glm::vec3> shown_b = displayed(b, stops);
    RgbPicture picture{
        .width = (kPanels * width + (kPanels - 1) * kGap) * magnified, .height = height * magnified, .rgb = {}};
    picture.rgb.assign(
        std::size_t{3} * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 128);
    draw_panel(shown_a, width, 0, magnified, picture);
    draw_panel(shown_b, width, (width + kGap) * magnified, magnified, picture);
    draw_panel(difference_colours(shown_a, shown_b), width, 2 * (width + kGap) * magnified, magnified, picture);
    return picture;
}

std::string data_url(const RgbPicture& picture) {
    return "data:image/png;base64," + base64(image::encode_png(picture.width, picture.height, 3, picture.rgb));
}

}  // namespace rowland::trade
