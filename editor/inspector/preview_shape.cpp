#include "editor/inspector/preview_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/check.h"
#include "engine/scene/mesh_recipe.h"

namespace rowland::inspector {

namespace {

constexpr double kSize = 0.116;  ///< metres: a compact disc's diameter

/// Turns a plane in XZ with normal +Y into one in XY with normal +Z.
scene::Mesh stood_up(scene::Mesh mesh) {
    const auto up = [](const glm::vec3& v) { return glm::vec3(v.x, -v.z, v.y); };
    for (glm::vec3& position : mesh.positions) position = up(position);
    for (glm::vec3& normal : mesh.normals) normal = up(normal);
    for (glm::vec4& tangent : mesh.tangents) tangent = glm::vec4(up(glm::vec3(tangent)), tangent.w);
    return mesh;
}

/// Bends a plane in XY around a vertical axis behind it, so that its width spans `angle` radians.
scene::Mesh bent(scene::Mesh mesh, double width, double angle) {
    const auto radius = static_cast<float>(width / angle);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const float turn = mesh.positions[i].x / radius;
        const float sine = std::sin(turn);
        const float cosine = std::cos(turn);
        mesh.positions[i] = {radius * sine, mesh.positions[i].y, radius * (cosine - 1.0F)};
        mesh.normals[i] = {sine, 0.0F, cosine};
        mesh.tangents[i] = {cosine, 0.0F, -sine, mesh.tangents[i].w};
    }
    return mesh;
}

}  // namespace

const char* preview_shape_name(PreviewShape shape) {
    constexpr std::array kNames = {"disc", "sphere", "card", "sheet", "model"};
    return kNames.at(static_cast<std::size_t>(shape));
}

std::optional<PreviewShape> parse_preview_shape(std::string_view name) {
    for (const PreviewShape shape : kPreviewShapes)
        if (name == preview_shape_name(shape)) return shape;
    return std::nullopt;
}

scene::Mesh preview_mesh(PreviewShape shape) {
    switch (shape) {
        case PreviewShape::Disc:
            return scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.0235, .outer_radius = 0.058});
        case PreviewShape::Sphere:
            return scene::build_mesh(scene::SphereRecipe{.radius = 0.05});
        case PreviewShape::Card:
            return stood_up(
                scene::build_mesh(scene::PlaneRecipe{.width = kSize, .depth = 0.64 * kSize, .subdivisions = 64}));
        case PreviewShape::Sheet: {
            constexpr double kAngle = 120.0 * std::numbers::pi / 180.0;
            constexpr double kWidth = 1.3 * kSize;
            return bent(
                stood_up(scene::build_mesh(scene::PlaneRecipe{.width = kWidth, .depth = kSize, .subdivisions = 96})),
                kWidth, kAngle);
        }
        case PreviewShape::Model:
            break;
    }
    check_failed(__FILE__, __LINE__, "a model's mesh is the user's");
}

float fitting_scale(const scene::Bounds& box) {
    const glm::vec3 extent = box.maximum - box.minimum;
    const float largest = std::max({extent.x, extent.y, extent.z});
    return largest > 0.0F ? static_cast<float>(kSize) / largest : 1.0F;
}

}  // namespace rowland::inspector
