#include "engine/render/capture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/procedural_probe.h"
#include "engine/render/reflections.h"
#include "engine/scene/camera.h"

namespace rowland::render {

namespace {

constexpr float kNearest_m = 0.02F;
constexpr float kFarthest_m = 1000.0F;

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

/// Bilinear within a face, whose rows come from the top down.
glm::vec3 sample(const std::vector<glm::vec3>& face, int size, const lighting::CubePoint& point) {
    const double x = std::clamp((1.0 + point.s) * 0.5 * size - 0.5, 0.0, size - 1.0);
    const double y = std::clamp((1.0 - point.t) * 0.5 * size - 0.5, 0.0, size - 1.0);
    const int column = std::min(static_cast<int>(x), size - 2);
    const int row = std::min(static_cast<int>(y), size - 2);
    const auto at = [&](int i, int j) { return face[static_cast<std::size_t>((row + j) * size + column + i)]; };
    const auto across = static_cast<float>(x - column);
    return glm::mix(glm::mix(at(0, 0), at(1, 0), across), glm::mix(at(0, 1), at(1, 1), across),
                    static_cast<float>(y - row));
}

}  // namespace

lighting::ProbeImage capture_surroundings(Renderer& renderer, ecs::World& world, const glm::vec3& position,
                                          int face_size) {
    const int drawn_size = 2 * face_size;
    const gpu::Framebuffer target(
        {.width = drawn_size, .height = drawn_size, .colours = {gpu::Format::RGBA32F}, .depth = true});
    std::array<std::vector<glm::vec3>, ObjectReflection::kFaces> faces;
    for (std::size_t face = 0; face < faces.size(); ++face) {
        scene::Camera camera = cube_face_camera(static_cast<int>(face), position);
        camera.near_plane = kNearest_m;
        camera.far_plane = kFarthest_m;
        renderer.render(world, camera, target);
        faces[face] = halved(target.read_rgba_float(), drawn_size);
    }
    image::Image picture{.width = 4 * face_size, .height = 2 * face_size, .texels = {}};
    picture.texels.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column) {
            const lighting::CubePoint point =
                lighting::cube_point(lighting::equirectangular_direction(column + 0.5, row + 0.5, picture.width));
            picture.texels.push_back(sample(faces.at(static_cast<std::size_t>(point.face)), face_size, point));
        }
    return {std::move(picture), lighting::Mapping::Equirectangular};
}

}  // namespace rowland::render
