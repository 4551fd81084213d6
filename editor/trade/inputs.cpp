#include "editor/trade/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/math/spherical_harmonics.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/evaluate/error_measure.h"

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

/// Calls visit(pixel, ray) for the middle of each pixel: row · width + column, and the unit direction from the eye.
template <typename Visit>
void for_each_ray(const scene::Camera& camera, int width, int height, const Visit& visit) {
    const glm::dmat4 to_world = glm::inverse(
        glm::dmat4(camera.projection(static_cast<float>(width) / static_cast<float>(height)) * camera.view()));
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const glm::dvec4 far_point =
                to_world * glm::dvec4(2.0 * (column + 0.5) / width - 1.0, 1.0 - 2.0 * (row + 0.5) / height, 1.0, 1.0);
            visit(static_cast<std::size_t>(row * width + column),
                  glm::normalize(glm::dvec3(far_point) / far_point.w - glm::dvec3(camera.eye)));
        }
}

[[noreturn]] void fail(const NumberTable& table, std::size_t i, std::string found, std::string expected) {
    refuse_input(table.file, fmt::format("row {}", table.file_rows[i]), std::move(found), std::move(expected));
}

}  // namespace

std::vector<diffraction::ShadingPoint> all_frames(const FrameSet& set) {
    std::vector<diffraction::ShadingPoint> frames;
    for (const auto& surface : set.surfaces) frames.insert(frames.end(), surface.begin(), surface.end());
    return frames;
}

FrameSet tilted_cd_frames() {
    return {.name = "tilted_cd", .surfaces = {diffraction::measured_frames(diffraction::SurfaceShape::Flat)}};
}

FrameSet sphere_frames() {
    return {.name = "sphere", .surfaces = {diffraction::measured_frames(diffraction::SurfaceShape::Curved)}};
}

FrameSet frames_of_file(const std::string& name, const std::filesystem::path& path) {
    return {.name = name, .surfaces = {read_frames(path)}};
}

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
    const glm::dvec3 eye(camera.eye);
    std::vector<diffraction::ShadingPoint> disc;
    std::vector<diffraction::ShadingPoint> sphere;
    std::vector<std::size_t> disc_pixels;
    std::vector<std::size_t> sphere_pixels;
    for_each_ray(camera, width, height, [&](std::size_t pixel, const glm::dvec3& ray) {
        const auto on_sphere = hit_sphere(eye, ray);
        const auto on_disc = hit_disc(eye, ray);
        if (on_sphere && (!on_disc || *on_sphere < *on_disc)) {
            sphere.push_back(sphere_frame(eye, ray, *on_sphere));
            sphere_pixels.push_back(pixel);
        } else if (on_disc) {
            disc.push_back(disc_frame(eye, ray, *on_disc));
            disc_pixels.push_back(pixel);
        }
    });
    PictureFrames result{{.width = width, .height = height, .pixels = disc_pixels},
                         {.name = "picture", .surfaces = {disc, sphere}}};
    result.pixels.insert(result.pixels.end(), sphere_pixels.begin(), sphere_pixels.end());
    return result;
}

PictureFrames disc_frames(const scene::Camera& camera, int width, int height) {
    const glm::dvec3 eye(camera.eye);
    diffraction::Surface disc;
    PictureFrames result{{.width = width, .height = height, .pixels = {}}, {}};
    for_each_ray(camera, width, height, [&](std::size_t pixel, const glm::dvec3& ray) {
        const auto on_disc = hit_disc(eye, ray);
        if (!on_disc) return;
        disc.push_back(disc_frame(eye, ray, *on_disc));
        result.pixels.push_back(pixel);
    });
    result.frames = {.name = "disc", .surfaces = {disc}};
    return result;
}

std::vector<diffraction::ShadingPoint> read_frames(const std::filesystem::path& path) {
    const NumberTable table = read_number_table(path, "vx,vy,vz,nx,ny,nz,gx,gy,gz");
    std::vector<diffraction::ShadingPoint> frames;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& x = table.rows[i];
        frames.push_back({.view = {x[0], x[1], x[2]}, .normal = {x[3], x[4], x[5]}, .grating = {x[6], x[7], x[8]}});
        if (!is_valid(frames.back()))
            fail(table, i, "a frame without three directions", "v, n and g other than 0, and g not along n");
    }
    return frames;
}

lighting::ShLight read_sh_light(const std::filesystem::path& path) {
    const NumberTable table = read_number_table(path, "l,m,r,g,b");
    const int bands = static_cast<int>(std::lround(std::sqrt(static_cast<double>(table.rows.size()))));
    if (table.rows.empty() || static_cast<std::size_t>(math::sh_count(bands)) != table.rows.size() ||
        bands > math::kMaximumBands)
        throw Error(
            {.file = table.file,
             .location = {},
             .found = fmt::format("{} rows", table.rows.size()),
             .expected = fmt::format("n² rows, one for every l < n and -l <= m <= l, n <= {}", math::kMaximumBands),
             .remedy = "rowland-trade project writes such a table"});
    std::vector<std::optional<glm::dvec3>> found(table.rows.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& x = table.rows[i];
        const bool whole = x[0] == std::floor(x[0]) && x[1] == std::floor(x[1]);
        if (!whole || x[0] < 0.0 || x[0] >= bands || std::abs(x[1]) > x[0])
            fail(table, i, fmt::format("l = {}, m = {}", x[0], x[1]),
                 fmt::format("whole numbers 0 <= l < {}, -l <= m <= l", bands));
        auto& slot = found[static_cast<std::size_t>(math::sh_index(static_cast<int>(x[0]), static_cast<int>(x[1])))];
        if (slot) fail(table, i, fmt::format("l = {}, m = {} again", x[0], x[1]), "every (l, m) once");
        slot = glm::dvec3(x[2], x[3], x[4]);
    }
    // As many rows as coefficients, all different: every coefficient is set.
    lighting::ShLight light{.bands = bands, .coefficients = {}};
    for (const auto& coefficient : found) light.coefficients.push_back(*coefficient);
    return light;
}

lighting::ProbeImage read_probe(const std::filesystem::path& path, const std::string& mapping) {
    return lighting::load_probe_image(path, lighting::parse_mapping(mapping));
}

ProbeFile parse_probe_file(const std::string& text, const std::string& mapping) {
    for (const std::string known : {"angular", "equirect"})
        if (text.ends_with(":" + known)) return {text.substr(0, text.size() - known.size() - 1), known};
    return {text, mapping};
}

std::vector<std::filesystem::path> files_named_in(const nlohmann::json& material, const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (material.is_structured()) {
        for (const nlohmann::json& value : material)
            std::ranges::copy(files_named_in(value, folder), std::back_inserter(files));
    } else if (material.is_string() && material.get<std::string>().ends_with(".csv")) {
        files.push_back(folder / material.get<std::string>());
    }
    return files;
}

void write_results(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
}

}  // namespace rowland::trade
