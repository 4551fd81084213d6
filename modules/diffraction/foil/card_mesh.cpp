#include "modules/diffraction/foil/card_mesh.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/last_bits.h"

namespace rowland::diffraction::foil {

namespace {

/// A point of the card's outline, seen from the front.
struct OutlinePoint {
    glm::dvec2 at{0.0};       ///< metres
    glm::dvec2 outward{0.0};  ///< unit
    double length = 0.0;      ///< of the outline up to here, metres
};

/// Counter-clockwise from the lower right corner's beginning; the first point comes again at the end. Corners are arcs
/// of `kCornerSteps` steps; a sharp corner is one point with the normals of both sides.
std::vector<OutlinePoint> outline_of(const CardShape& shape) {
    constexpr int kCornerSteps = 12;
    const glm::dvec2 half(0.5e-3 * shape.width_mm, 0.5e-3 * shape.height_mm);
    const double radius = 1e-3 * shape.corner_mm;
    const int steps = radius > 0.0 ? kCornerSteps : 1;
    const std::array<glm::dvec2, 4> signs = {glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1),
                                             glm::dvec2(-1, -1)};
    std::vector<OutlinePoint> outline;
    const auto add = [&](const glm::dvec2& at, const glm::dvec2& outward) {
        const double step = outline.empty() ? 0.0 : glm::length(at - outline.back().at);
        outline.push_back({at, outward, (outline.empty() ? 0.0 : outline.back().length) + step});
    };
    for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec2 centre = signs[static_cast<std::size_t>(corner)] * (half - radius);
        for (int step = 0; step <= steps; ++step) {
            const double angle = std::numbers::pi / 2.0 * (corner - 1 + static_cast<double>(step) / steps);
            glm::dvec2 outward(std::cos(angle), std::sin(angle));
            math::drop_last_bits({&outward.x, 2});
            add(centre + radius * outward, outward);
        }
    }
    add(outline.front().at, outline.front().outward);
    return outline;
}

void add_vertex(scene::Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                const glm::dvec2& uv) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    mesh.tangents.emplace_back(glm::vec3(tangent), 1.0F);
    mesh.uvs.emplace_back(uv);
}

/// A fan of triangles about the middle. `side`: 1 for the front, −1 for the back.
scene::Mesh face_of(const CardShape& shape, const std::vector<OutlinePoint>& outline, double side) {
    scene::Mesh mesh;
    const auto add = [&](const glm::dvec2& at) {
        const glm::dvec2 uv(0.5 + side * at.x / (1e-3 * shape.width_mm), 0.5 - at.y / (1e-3 * shape.height_mm));
        add_vertex(mesh, {at, side * 0.5e-3 * shape.thickness_mm}, {0.0, 0.0, side}, {side, 0.0, 0.0}, uv);
    };
    add(glm::dvec2(0.0));
    // Without those that stand where the one before them does, or the first.
    const double whole = outline.back().length;
    for (std::size_t i = 0; i + 1 < outline.size(); ++i)
        if (i == 0 || (outline[i].length > outline[i - 1].length && outline[i].length < whole)) add(outline[i].at);
    const auto count = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t here = 1 + i;
        const std::uint32_t next = 1 + (i + 1) % count;
        if (side > 0.0)
            mesh.indices.insert(mesh.indices.end(), {0, here, next});
        else
            mesh.indices.insert(mesh.indices.end(), {0, next, here});
    }
    return mesh;
}

scene::Mesh edge_of(const CardShape& shape, const std::vector<OutlinePoint>& outline) {
    scene::Mesh mesh;
    const double whole = outline.back().length;
    for (const OutlinePoint& point : outline) {
        const glm::dvec3 outward(point.outward, 0.0);
        const glm::dvec3 along(-point.outward.y, point.outward.x, 0.0);
        for (const double side : {1.0, -1.0})
            add_vertex(mesh, {point.at, side * 0.5e-3 * shape.thickness_mm}, outward, along,
                       {point.length / whole, 0.5 - 0.5 * side});
    }
    for (std::uint32_t i = 0; i + 1 < outline.size(); ++i) {
        if (outline[i + 1].length == outline[i].length) continue;  // a sharp corner
        const std::uint32_t front = 2 * i;
        mesh.indices.insert(mesh.indices.end(), {front, front + 1, front + 2, front + 2, front + 1, front + 3});
    }
    return mesh;
}

}  // namespace

CardMesh card_mesh(const CardShape& shape) {
    const std::vector<OutlinePoint> outline = outline_of(shape);
    return {face_of(shape, outline, 1.0), face_of(shape, outline, -1.0), edge_of(shape, outline)};
}

}  // namespace rowland::diffraction::foil
