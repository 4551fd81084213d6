#include "engine/scene/mesh_recipe.h"

#include <cmath>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/json_reader.h"

namespace rowland::scene {

namespace {

constexpr int kMaximumCount = 2048;
// Metres: from a tenth of a micron to a thousand kilometres, well inside what float positions resolve.
constexpr NumberRange kLength{.minimum = 1e-7, .maximum = 1e6};

void add_vertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                const glm::dvec2& uv) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    mesh.tangents.emplace_back(glm::vec3(tangent), -1.0F);  // v grows along cross(normal, tangent) in all of them
    mesh.uvs.emplace_back(uv);
}

/// Triangulates rows of `columns` vertices each, beginning at vertex `first`. Counter-clockwise seen from where growing
/// rows point right and growing columns point up.
void add_grid(Mesh& mesh, std::uint32_t first, std::uint32_t rows, std::uint32_t columns) {
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = first + row * columns + column;
            const std::uint32_t b = a + columns;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
}

/// i-th of `count` steps around the circle; the last is exactly the first again.
struct Angle {
    double cosine;
    double sine;
};
Angle angle(int i, int count) {
    const double radians = 2.0 * std::numbers::pi * (i % count) / count;
    return {std::cos(radians), std::sin(radians)};
}

Mesh build(const DiscRecipe& recipe) {
    Mesh mesh;
    for (int ring = 0; ring <= recipe.rings; ++ring) {
        const double share = static_cast<double>(ring) / recipe.rings;
        const double radius = std::lerp(recipe.inner_radius, recipe.outer_radius, share);
        for (int segment = 0; segment <= recipe.segments; ++segment) {
            const Angle at = angle(segment, recipe.segments);
            const glm::dvec3 radial(at.cosine, 0.0, -at.sine);
            add_vertex(mesh, radius * radial, {0.0, 1.0, 0.0}, radial,
                       {share, static_cast<double>(segment) / recipe.segments});
        }
    }
    add_grid(mesh, 0, static_cast<std::uint32_t>(recipe.rings + 1), static_cast<std::uint32_t>(recipe.segments + 1));
    return mesh;
}

/// One vertex of a sphere; `segment` may lie between two sectors.
void add_sphere_vertex(Mesh& mesh, const SphereRecipe& recipe, double polar_sine, double polar_cosine, Angle at,
                       const glm::dvec2& uv) {
    const glm::dvec3 normal(polar_sine * at.cosine, polar_cosine, -polar_sine * at.sine);
    add_vertex(mesh, recipe.radius * normal, normal, {-at.sine, 0.0, -at.cosine}, uv);
}

/// A pole has a vertex a sector, in the sector's middle, so that each triangle there has a tangent of its own.
void add_pole(Mesh& mesh, const SphereRecipe& recipe, bool north) {
    const auto row = static_cast<std::uint32_t>(recipe.segments + 1);
    const std::uint32_t first = north ? static_cast<std::uint32_t>(recipe.rings - 2) * row : 0;
    for (int segment = 0; segment < recipe.segments; ++segment) {
        const auto apex = static_cast<std::uint32_t>(mesh.positions.size());
        const double u = (segment + 0.5) / recipe.segments;
        add_sphere_vertex(mesh, recipe, 0.0, north ? 1.0 : -1.0, angle(2 * segment + 1, 2 * recipe.segments),
                          {u, north ? 1.0 : 0.0});
        const std::uint32_t a = first + static_cast<std::uint32_t>(segment);
        if (north)
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, apex});
        else
            mesh.indices.insert(mesh.indices.end(), {a + 1, a, apex});
    }
}

Mesh build(const SphereRecipe& recipe) {
    Mesh mesh;
    for (int ring = 1; ring < recipe.rings; ++ring) {
        const double latitude = static_cast<double>(ring) / recipe.rings;
        const double polar = std::numbers::pi * (1.0 - latitude);
        for (int segment = 0; segment <= recipe.segments; ++segment)
            add_sphere_vertex(mesh, recipe, std::sin(polar), std::cos(polar), angle(segment, recipe.segments),
                              {static_cast<double>(segment) / recipe.segments, latitude});
    }
    const auto rows = static_cast<std::uint32_t>(recipe.rings - 1);
    const auto columns = static_cast<std::uint32_t>(recipe.segments + 1);
    // Here columns run right and rows run up, the other way round from what add_grid expects.
    add_grid(mesh, 0, rows, columns);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    add_pole(mesh, recipe, false);
    add_pole(mesh, recipe, true);
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
    add_grid(mesh, 0, static_cast<std::uint32_t>(n + 1), static_cast<std::uint32_t>(n + 1));
    return mesh;
}

int count_or(JsonReader& reader, const std::string& key, int fallback, int minimum) {
    return static_cast<int>(reader.integer_or(key, fallback, minimum, kMaximumCount));
}

DiscRecipe parse_disc(JsonReader& reader) {
    DiscRecipe recipe;
    recipe.inner_radius = reader.number("inner_radius", {.minimum = 0.0, .maximum = kLength.maximum});
    recipe.outer_radius = reader.number("outer_radius", kLength);
    if (recipe.outer_radius <= recipe.inner_radius)
        reader.fail("outer_radius", fmt::format("{}", recipe.outer_radius),
                    fmt::format("more than inner_radius, {}", recipe.inner_radius));
    recipe.rings = count_or(reader, "rings", recipe.rings, 1);
    recipe.segments = count_or(reader, "segments", recipe.segments, 3);
    return recipe;
}

SphereRecipe parse_sphere(JsonReader& reader) {
    SphereRecipe recipe;
    recipe.radius = reader.number("radius", kLength);
    recipe.rings = count_or(reader, "rings", recipe.rings, 2);
    recipe.segments = count_or(reader, "segments", recipe.segments, 3);
    return recipe;
}

PlaneRecipe parse_plane(JsonReader& reader) {
    PlaneRecipe recipe;
    const std::vector<double> size = reader.numbers("size", 2, kLength);
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
    JsonReader reader = root.object("mesh");
    root.finish();
    const std::string type = reader.choice("type", {"disc", "sphere", "plane"});
    MeshRecipe recipe;
    if (type == "disc")
        recipe = parse_disc(reader);
    else if (type == "sphere")
        recipe = parse_sphere(reader);
    else
        recipe = parse_plane(reader);
    reader.finish();
    return recipe;
}

Mesh build_mesh(const MeshRecipe& recipe) {
    return std::visit([](const auto& shape) { return build(shape); }, recipe);
}

}  // namespace rowland::scene
