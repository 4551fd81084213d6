#include "engine/view/probe_capture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec4.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/lighting/environment_map.h"
#include "engine/scene/camera.h"

namespace rowland::view {

namespace {

constexpr int kFaces = 6;
constexpr float kNearest_m = 0.02F;
constexpr float kFarthest_m = 1000.0F;

/// Looks through a face; its picture's columns run against s, its rows along t.
scene::Camera camera_of(int face, const glm::vec3& position) {
    const glm::dvec3 forward = lighting::cube_direction(face, 0.0, 0.0);
    return {.eye = position,
            .target = position + glm::vec3(forward),
            .up = glm::vec3(lighting::cube_direction(face, 0.0, -1.0) - forward),
            .vertical_field_of_view = std::numbers::pi_v<float> / 2.0F,
            .near_plane = kNearest_m,
            .far_plane = kFarthest_m};
}

/// Means of two by two pixels.
std::vector<glm::vec3> halved(const std::vector<glm::vec4>& pixels, int size) {
    std::vector<glm::vec3> result;
    result.reserve(pixels.size() / 4);
    const auto at = [&](int column, int row) {
        return glm::vec3(
            pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column)]);
    };
    for (int row = 0; row < size; row += 2)
        for (int column = 0; column < size; column += 2)
            result.push_back(0.25F *
                             (at(column, row) + at(column + 1, row) + at(column, row + 1) + at(column + 1, row + 1)));
    return result;
}

/// Bilinear within the face.
glm::vec3 sample(const std::vector<glm::vec3>& face, int size, double s, double t) {
    const double x = std::clamp((1.0 - s) * 0.5 * size - 0.5, 0.0, size - 1.0);
    const double y = std::clamp((1.0 + t) * 0.5 * size - 0.5, 0.0, size - 1.0);
    const int column = std::min(static_cast<int>(x), size - 2);
    const int row = std::min(static_cast<int>(y), size - 2);
    const auto at = [&](int i, int j) { return face[static_cast<std::size_t>((row + j) * size + column + i)]; };
    const auto across = static_cast<float>(x - column);
    return glm::mix(glm::mix(at(0, 0), at(1, 0), across), glm::mix(at(0, 1), at(1, 1), across),
                    static_cast<float>(y - row));
}

}  // namespace

lighting::ProbeImage capture_surroundings(render::Renderer& renderer, ecs::World& world, const glm::vec3& position,
                                          int face_size) {
    const int drawn_size = 2 * face_size;
    const gpu::Framebuffer target(
        {.width = drawn_size, .height = drawn_size, .colours = {gpu::Format::RGBA32F}, .depth = true});
    std::array<std::vector<glm::vec3>, kFaces> faces;
    for (int face = 0; face < kFaces; ++face) {
        renderer.render(world, camera_of(face, position), target);
        faces.at(static_cast<std::size_t>(face)) = halved(target.read_rgba_float(), drawn_size);
    }
    image::Image picture{.width = 4 * face_size, .height = 2 * face_size, .texels = {}};
    picture.texels.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column) {
            const double theta = std::numbers::pi * (row + 0.5) / picture.height;
            const double phi = 2.0 * std::numbers::pi * ((column + 0.5) / picture.width - 0.5);
            const glm::dvec3 direction(std::sin(theta) * std::sin(phi), std::cos(theta),
                                       -std::sin(theta) * std::cos(phi));
            const lighting::CubePoint point = lighting::cube_point(direction);
            picture.texels.push_back(
                sample(faces.at(static_cast<std::size_t>(point.face)), face_size, point.s, point.t));
        }
    return {std::move(picture), lighting::Mapping::Equirectangular};
}

}  // namespace rowland::view
