#include "engine/lighting/procedural_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "engine/colour/colour_space.h"
#include "engine/core/check.h"
#include "engine/core/parallel.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// Perez' five parameters of one quantity.
struct Perez {
    double a, b, c, d, e;

    /// F(θ, γ): θ from the zenith, γ from the sun.
    double operator()(double cos_theta, double gamma) const {
        const double cos_gamma = std::cos(gamma);
        return (1 + a * std::exp(b / std::max(cos_theta, 0.01))) *
               (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
    }
};

/// Y, x and y as linear functions of turbidity [Preetham et al. 1999, A.2].
std::array<Perez, 3> perez_parameters(double t) {
    return {Perez{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                  -0.0670 * t + 0.3703},
            Perez{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                  -0.0033 * t + 0.0452},
            Perez{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                  -0.0109 * t + 0.0529}};
}

/// Zenith luminance in kcd/m² and chromaticity; `s` is the sun's angle from the zenith [Preetham et al. 1999, A.2].
std::array<double, 3> zenith_values(double t, double s) {
    const double chi = (4.0 / 9 - t / 120) * (pi - 2 * s);
    const double luminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    const auto cubic = [s](double k3, double k2, double k1, double k0) { return ((k3 * s + k2) * s + k1) * s + k0; };
    const double x = t * t * cubic(0.00166, -0.00375, 0.00209, 0) + t * cubic(-0.02903, 0.06377, -0.03202, 0.00394) +
                     cubic(0.11693, -0.21196, 0.06052, 0.25886);
    const double y = t * t * cubic(0.00275, -0.00610, 0.00317, 0) + t * cubic(-0.04214, 0.08970, -0.04153, 0.00516) +
                     cubic(0.15346, -0.26756, 0.06670, 0.26688);
    return {luminance, x, y};
}

/// Linear Rec.709 of a colour, negative components cut [ITU-R BT.709-6; the inverse of its primaries' matrix].
glm::dvec3 rec709(double luminance, double x, double y) {
    const double big_x = luminance * x / y;
    const double big_z = luminance * (1 - x - y) / y;
    const glm::dvec3 rgb(3.2404542 * big_x - 1.5371385 * luminance - 0.4985314 * big_z,
                         -0.9692660 * big_x + 1.8760108 * luminance + 0.0415560 * big_z,
                         0.0556434 * big_x - 0.2040259 * luminance + 1.0572252 * big_z);
    return glm::max(rgb, glm::dvec3(0.0));
}

glm::dvec3 sun_direction(const ClearSkyRecipe& recipe) {
    return direction_at(glm::radians(recipe.sun_azimuth_deg), glm::radians(recipe.sun_elevation_deg));
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Fraction of a texel that the sun's disc covers above the horizon, by a grid of points.
double disc_coverage(const glm::dvec3& sun, double radius, int column, int row, int width) {
    constexpr int kSteps = 32;
    int hits = 0;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const glm::dvec3 d =
                equirectangular_direction(column + (i + 0.5) / kSteps, row + (j + 0.5) / kSteps, width);
            if (d.y > 0 && angle_between(d, sun) <= radius) ++hits;
        }
    return static_cast<double>(hits) / (kSteps * kSteps);
}

double texel_solid_angle(int row, int width) {
    const double theta = 2 * pi * (row + 0.5) / width;
    return 2 * pi / width * 2 * std::sin(theta) * std::sin(pi / width);
}

void add_sun(const ClearSkyRecipe& recipe, image::Image& image) {
    struct Covered {
        int column, row;
        double fraction;
    };
    const glm::dvec3 sun = sun_direction(recipe);
    const double radius = glm::radians(recipe.sun_angular_diameter_deg) / 2;
    const double reach = radius + 2 * pi / image.width;  // a texel's half diagonal is less
    std::vector<Covered> covered;
    double solid_angle = 0;
    for (int row = 0; row < image.height / 2; ++row)
        for (int column = 0; column < image.width; ++column) {
            const glm::dvec3 centre = equirectangular_direction(column + 0.5, row + 0.5, image.width);
            if (angle_between(centre, sun) > reach) continue;
            const double fraction = disc_coverage(sun, radius, column, row, image.width);
            if (fraction == 0) continue;
            covered.push_back({column, row, fraction});
            solid_angle += fraction * texel_solid_angle(row, image.width);
        }
    ROWLAND_CHECK_OP(solid_angle, >, 0.0);
    // Division by the solid angle that is covered makes the irradiance exact at any resolution.
    const glm::dvec3 radiance = sun_irradiance(recipe) / solid_angle;
    for (const Covered& texel : covered) image.at(texel.column, texel.row) += glm::vec3(texel.fraction * radiance);
}

}  // namespace

glm::dvec3 sky_radiance(const ClearSkyRecipe& recipe, const glm::dvec3& direction) {
    const double from_zenith = pi / 2 - glm::radians(recipe.sun_elevation_deg);
    const double gamma = angle_between(direction, sun_direction(recipe));
    const auto perez = perez_parameters(recipe.turbidity);
    const auto zenith = zenith_values(recipe.turbidity, from_zenith);
    std::array<double, 3> value{};
    for (std::size_t i = 0; i < 3; ++i) value[i] = zenith[i] * perez[i](direction.y, gamma) / perez[i](1, from_zenith);
    return rec709(std::max(value[0], 0.0), value[1], value[2]);
}

glm::dvec3 sun_irradiance(const ClearSkyRecipe& recipe) {
    const double elevation = recipe.sun_elevation_deg;
    const double air_mass =
        1 / (std::sin(glm::radians(elevation)) + 0.15 * std::pow(93.885 - (90 - elevation), -1.253));
    const double aerosol = 0.04608 * recipe.turbidity - 0.04586;
    glm::dvec3 colour(0.0);
    const glm::dvec3 wavelength_um(0.610, 0.550, 0.465);  // where Rec.709's primaries lie
    for (int c = 0; c < 3; ++c)
        colour[c] = std::exp(
            -air_mass * (0.008735 * std::pow(wavelength_um[c], -4.08) + aerosol * std::pow(wavelength_um[c], -1.3)));
    return colour / colour::luminance(colour) * 127.5 * std::exp(-0.21 * air_mass);
}

image::Image render_clear_sky(const ClearSkyRecipe& recipe, int width) {
    const int height = width / 2;
    ROWLAND_CHECK(width % 4 == 0, "the horizon lies between two rows");
    image::Image image{width, height, {}};
    image.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    parallel_for(static_cast<std::size_t>(height / 2), [&](std::size_t task) {
        const int row = static_cast<int>(task);
        for (int column = 0; column < width; ++column)
            image.at(column, row) =
                glm::vec3(sky_radiance(recipe, equirectangular_direction(column + 0.5, row + 0.5, width)));
    });
    glm::dvec3 irradiance = sun_irradiance(recipe) * std::sin(glm::radians(recipe.sun_elevation_deg));
    for (int row = 0; row < height / 2; ++row) {
        const double cosine = equirectangular_direction(0.5, row + 0.5, width).y;
        for (int column = 0; column < width; ++column)
            irradiance += texel_solid_angle(row, width) * cosine * glm::dvec3(image.at(column, row));
    }
    const glm::vec3 ground(recipe.ground_albedo * irradiance / pi);
    std::fill(image.texels.begin() + static_cast<std::ptrdiff_t>(image.texels.size() / 2), image.texels.end(), ground);
    add_sun(recipe, image);
    return image;
}

namespace {

/// A soft box in radians, with its frame.
struct OrientedBox {
    glm::dvec3 forward;  ///< toward its centre
    glm::dvec3 right;    ///< as the object sees it
    glm::dvec3 up;
    double half_width = 0;  ///< radians
    double half_height = 0;
    double soft_edge = 0;
    double cosine = 0;  ///< of the cone around it
    glm::dvec3 radiance = {};
};

OrientedBox orient(const SoftBox& box) {
    const double azimuth = glm::radians(box.azimuth_deg);
    const double elevation = glm::radians(box.elevation_deg);
    const double roll = glm::radians(box.roll_deg);
    const glm::dvec3 right(std::cos(azimuth), 0, std::sin(azimuth));
    OrientedBox oriented;
    oriented.forward = direction_at(azimuth, elevation);
    const glm::dvec3 up = glm::cross(right, oriented.forward);
    oriented.right = std::cos(roll) * right + std::sin(roll) * up;
    oriented.up = std::cos(roll) * up - std::sin(roll) * right;
    oriented.half_width = glm::radians(box.half_width_deg);
    oriented.half_height = glm::radians(box.half_height_deg);
    oriented.soft_edge = glm::radians(box.soft_edge_deg);
    oriented.cosine =
        1 / std::sqrt(1 + std::pow(std::tan(oriented.half_width), 2) + std::pow(std::tan(oriented.half_height), 2));
    oriented.radiance = box.radiance;
    return oriented;
}

/// 1 well inside a half extent, 0 outside, falling smoothly over `soft_edge`.
double inside(double angle, double half_extent, double soft_edge) {
    const double depth = half_extent - std::abs(angle);
    if (depth <= 0) return 0;
    if (depth >= soft_edge) return 1;
    const double x = depth / soft_edge;
    return x * x * (3 - 2 * x);
}

glm::dvec3 box_radiance(const OrientedBox& box, const glm::dvec3& d) {
    const double along = glm::dot(d, box.forward);
    if (along < box.cosine) return glm::dvec3(0.0);
    const double x = std::atan(glm::dot(d, box.right) / along);
    const double y = std::atan(glm::dot(d, box.up) / along);
    return inside(x, box.half_width, box.soft_edge) * inside(y, box.half_height, box.soft_edge) * box.radiance;
}

glm::dvec3 room_radiance(const StudioRecipe& recipe, double height) {
    // Linear in the angle from the horizon.
    const double fraction = std::abs(std::asin(std::clamp(height, -1.0, 1.0))) / (std::numbers::pi / 2);
    return glm::mix(recipe.wall, height > 0 ? recipe.ceiling : recipe.floor, fraction);
}

}  // namespace

image::Image render_studio(const StudioRecipe& recipe, int width) {
    constexpr int kSteps = 4;
    const int height = width / 2;
    std::vector<OrientedBox> boxes;
    for (const SoftBox& box : recipe.boxes) boxes.push_back(orient(box));
    image::Image image{width, height, {}};
    image.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t task) {
        const int row = static_cast<int>(task);
        for (int column = 0; column < width; ++column) {
            glm::dvec3 sum(0.0);
            for (int j = 0; j < kSteps; ++j)
                for (int i = 0; i < kSteps; ++i) {
                    const glm::dvec3 d =
                        equirectangular_direction(column + (i + 0.5) / kSteps, row + (j + 0.5) / kSteps, width);
                    sum += room_radiance(recipe, d.y);
                    for (const OrientedBox& box : boxes) sum += box_radiance(box, d);
                }
            image.at(column, row) = glm::vec3(sum / static_cast<double>(kSteps * kSteps));
        }
    });
    return image;
}

}  // namespace rowland::lighting
