#include "engine/scene/mesh_recipe.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "engine/core/json_reader.h"

namespace rowland::scene {

namespace {

constexpr int kMaximumSegments = 2048;
// Metres: from a tenth of a micron to a thousand kilometres, well inside what float positions resolve.
constexpr NumberRange kMeshLength{.minimum = 1e-7, .maximum = 1e6};

/// The i-th of `count` equal steps around the circle; step `count` equals step 0 exactly.
struct Angle {
    double cosine;
    double sine;
};
Angle angle(int i, int count) {
    const double radians = 2.0 * std::numbers::pi * (i % count) / count;
    return {std::cos(radians), std::sin(radians)};
}

void add_vertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                const glm::dvec2& uv) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    mesh.tangents.emplace_back(glm::vec3(tangent), -1.0F);
    mesh.uvs.emplace_back(uv);
}

/// Triangulates a grid of vertices, row by row. Counter-clockwise where the row index grows to the right and the column
/// index upwards.
void add_grid(Mesh& mesh, int row_count, int column_count) {
    const auto rows = static_cast<std::uint32_t>(row_count);
    const auto columns = static_cast<std::uint32_t>(column_count);
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = row * columns + column;
            const std::uint32_t b = a + columns;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
}

Mesh build(const DiscRecipe& recipe) {
    Mesh mesh;
    for (int ring = 0; ring <= recipe.rings; ++ring) {
        const double u = static_cast<double>(ring) / recipe.rings;
        const double radius = std::lerp(recipe.inner_radius, recipe.outer_radius, u);
        for (int segment = 0; segment <= recipe.segments; ++segment) {
            const Angle at = angle(segment, recipe.segments);
            const glm::dvec3 radial(at.cosine, 0.0, -at.sine);
            add_vertex(mesh, radius * radial, {0.0, 1.0, 0.0}, radial,
                       {u, static_cast<double>(segment) / recipe.segments});
        }
    }
    add_grid(mesh, recipe.rings + 1, recipe.segments + 1);
    return mesh;
}

/// A pole has one vertex per sector, in the sector's middle, so that each triangle has its own tangent.
Mesh build(const SphereRecipe& recipe) {
    Mesh mesh;
    const auto add_row = [&](int ring) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const double v = static_cast<double>(ring) / recipe.rings;
        const double polar = std::numbers::pi * (1.0 - v);
        const bool is_pole = ring == 0 || ring == recipe.rings;
        const glm::dvec2 outward(is_pole ? 0.0 : std::sin(polar), std::cos(polar));
        const glm::dvec2 at = recipe.radius * outward;
        for (int segment = 0; segment < recipe.segments + (is_pole ? 0 : 1); ++segment) {
            const int half_sectors = 2 * segment + (is_pole ? 1 : 0);
            const auto [c, s] = angle(half_sectors, 2 * recipe.segments);
            add_vertex(mesh, {at.x * c, at.y, -at.x * s},
                       glm::normalize(glm::dvec3(outward.x * c, outward.y, -outward.x * s)),
                       glm::normalize(glm::dvec3(-s, 0.0, -c)),
                       {static_cast<double>(half_sectors) / (2 * recipe.segments), v});
        }
        return first;
    };
    std::uint32_t below = add_row(0);
    for (int ring = 1; ring <= recipe.rings; ++ring) {
        const std::uint32_t above = add_row(ring);
        const bool is_top = ring == recipe.rings;
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(recipe.segments); ++i) {
            const std::uint32_t a = below + i;
            const std::uint32_t b = above + i;
            if (ring > 1) mesh.indices.insert(mesh.indices.end(), {a, a + 1, is_top ? b : b + 1});
            if (!is_top) mesh.indices.insert(mesh.indices.end(), {a, b + 1, b});
        }
        below = above;
    }
    return mesh;
}

Mesh build(const PlaneRecipe& recipe) {
    Mesh mesh;
    const int n = recipe.subdivisions;
    for (int column = 0; column <= n; ++column) {
        const double u = static_cast<double>(column) / n;
        for (int row = 0; row <= n; ++row) {
            const double v = static_cast<double>(row) / n;
            add_vertex(mesh, {(u - 0.5) * recipe.width, 0.0, (0.5 - v) * recipe.depth}, {0.0, 1.0, 0.0},
                       {1.0, 0.0, 0.0}, {u, v});
        }
    }
    add_grid(mesh, n + 1, n + 1);
    return mesh;
}

int count_or(JsonReader& reader, const std::string& key, int fallback, int minimum) {
    return static_cast<int>(reader.integer_or(key, fallback, minimum, kMaximumSegments));
}

MeshRecipe parse_disc(JsonReader& reader) {
    DiscRecipe recipe;
    recipe.inner_radius = reader.number("inner_radius", {.minimum = 0.0, .maximum = kMeshLength.maximum});
    recipe.outer_radius = reader.number("outer_radius", kMeshLength);
    if (recipe.outer_radius <= recipe.inner_radius && !reader.is_recording_schema())
        reader.fail("outer_radius", fmt::format("{}", recipe.outer_radius),
                    fmt::format("more than inner_radius, {}", recipe.inner_radius));
    recipe.rings = count_or(reader, "rings", recipe.rings, 1);
    recipe.segments = count_or(reader, "segments", recipe.segments, 3);
    return recipe;
}

MeshRecipe parse_sphere(JsonReader& reader) {
    SphereRecipe recipe;
    recipe.radius = reader.number("radius", kMeshLength);
    recipe.rings = count_or(reader, "rings", recipe.rings, 2);
    recipe.segments = count_or(reader, "segments", recipe.segments, 3);
    return recipe;
}

MeshRecipe parse_plane(JsonReader& reader) {
    PlaneRecipe recipe;
    const std::vector<double> size = reader.numbers("size", 2, kMeshLength);
    recipe.width = size[0];
    recipe.depth = size[1];
    recipe.subdivisions = count_or(reader, "subdivisions", recipe.subdivisions, 1);
    return recipe;
}

}  // namespace

bool is_mesh_recipe(const nlohmann::json& document) {
    return document.is_object() && document.contains("mesh");
}

MeshRecipe parse_mesh_recipe(const nlohmann::json& document, const std::string& file) {
    JsonReader root(document, file);
    return parse_mesh_recipe(root);
}

MeshRecipe parse_mesh_recipe(JsonReader& root) {
    JsonReader shape = root.object("mesh");
    MeshRecipe recipe;
    shape.variant("type", {"disc", "sphere", "plane"}, [&](JsonReader& reader, std::size_t type) {
        constexpr std::array parse = {parse_disc, parse_sphere, parse_plane};
        recipe = parse[type](reader);
    });
    shape.finish();
    root.finish();
    return recipe;
}

Mesh build_mesh(const MeshRecipe& recipe) {
    return std::visit([](const auto& shape) { return build(shape); }, recipe);
}

}  // namespace rowland::scene
