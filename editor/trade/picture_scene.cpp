#include "editor/trade/picture_scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "engine/scene/mesh_recipe.h"

namespace rowland::trade {

namespace {

constexpr double kInnerRadius = 0.0235;
constexpr double kOuterRadius = 0.058;
constexpr double kSphereRadius = 0.019;

/// Distance along a ray to the sphere.
std::optional<double> hit_sphere(const glm::dvec3& eye, const glm::dvec3& ray) {
    const glm::dvec3 from_centre = eye - glm::dvec3(kSphereCentre);
    const double b = glm::dot(from_centre, ray);
    const double under_root = b * b - glm::dot(from_centre, from_centre) + kSphereRadius * kSphereRadius;
    if (under_root <= 0.0) return std::nullopt;
    const double distance = -b - std::sqrt(under_root);
    return distance > 0.0 ? std::optional(distance) : std::nullopt;
}

std::optional<double> hit_disc(const glm::dvec3& eye, const glm::dvec3& ray) {
    if (ray.y >= 0.0) return std::nullopt;
    const double distance = -eye.y / ray.y;
    const glm::dvec3 at = eye + distance * ray;
    const double radius = std::hypot(at.x, at.z);
    return radius >= kInnerRadius && radius <= kOuterRadius ? std::optional(distance) : std::nullopt;
}

/// The grating vectors are the tangents of the meshes.
diffraction::ShadingPoint disc_frame(const glm::dvec3& eye, const glm::dvec3& ray, double distance) {
    const glm::dvec3 at = eye + distance * ray;
    return {.view = -ray, .normal = {0.0, 1.0, 0.0}, .grating = glm::normalize(glm::dvec3(at.x, 0.0, at.z))};
}
diffraction::ShadingPoint sphere_frame(const glm::dvec3& eye, const glm::dvec3& ray, double distance) {
    const glm::dvec3 normal = glm::normalize(eye + distance * ray - glm::dvec3(kSphereCentre));
    return {.view = -ray, .normal = normal, .grating = glm::normalize(glm::dvec3(normal.z, 0.0, -normal.x))};
}

}  // namespace

scene::Mesh disc_mesh() {
    return scene::build_mesh(scene::DiscRecipe{.inner_radius = kInnerRadius, .outer_radius = kOuterRadius});
}

scene::Mesh sphere_mesh() {
    return scene::build_mesh(scene::SphereRecipe{.radius = kSphereRadius});
}

scene::Camera close_camera() {
    scene::Camera camera;
    camera.eye = {0.0F, 0.096F, 0.03F};
    camera.vertical_field_of_view = 0.9F;
    return camera;
}

scene::Camera far_camera() {
    scene::Camera camera;
    camera.eye = {0.0F, 0.2F, 0.19F};
    camera.target = {0.0F, 0.005F, 0.0F};
    camera.vertical_field_of_view = 0.5F;
    return camera;
}

PictureFrames picture_frames(const scene::Camera& camera, int width, int height) {
    const glm::dmat4 to_world = glm::inverse(
        glm::dmat4(camera.projection(static_cast<float>(width) / static_cast<float>(height)) * camera.view()));
    const glm::dvec3 eye(camera.eye);
    std::vector<diffraction::ShadingPoint> disc;
    std::vector<diffraction::ShadingPoint> sphere;
    std::vector<std::size_t> disc_pixels;
    std::vector<std::size_t> sphere_pixels;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const glm::dvec4 far_point =
                to_world * glm::dvec4(2.0 * (column + 0.5) / width - 1.0, 1.0 - 2.0 * (row + 0.5) / height, 1.0, 1.0);
            const glm::dvec3 ray = glm::normalize(glm::dvec3(far_point) / far_point.w - eye);
            const auto on_sphere = hit_sphere(eye, ray);
            const auto on_disc = hit_disc(eye, ray);
            const auto pixel = static_cast<std::size_t>(row * width + column);
            if (on_sphere && (!on_disc || *on_sphere < *on_disc)) {
                sphere.push_back(sphere_frame(eye, ray, *on_sphere));
                sphere_pixels.push_back(pixel);
            } else if (on_disc) {
                disc.push_back(disc_frame(eye, ray, *on_disc));
                disc_pixels.push_back(pixel);
            }
        }
    PictureFrames result{{.width = width, .height = height, .pixels = disc_pixels},
                         {.name = "picture", .surfaces = {disc, sphere}}};
    result.pixels.insert(result.pixels.end(), sphere_pixels.begin(), sphere_pixels.end());
    return result;
}

}  // namespace rowland::trade
