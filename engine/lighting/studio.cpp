#include "engine/lighting/studio.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "engine/core/parallel.h"
#include "engine/lighting/sphere_angles.h"

namespace rowland::lighting {

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
