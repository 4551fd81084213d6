#include "engine/scene/mesh_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/scene/surface_grid.h"

namespace rowland::scene {

namespace {

constexpr int kMaximumSegments = 2048;
// Metres: from a tenth of a micron to a thousand kilometres, well inside what float positions resolve.
constexpr NumberRange kMeshLength{.minimum = 1e-7, .maximum = 1e6};

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
    add_grid(mesh, 0, static_cast<std::uint32_t>(recipe.rings + 1), static_cast<std::uint32_t>(recipe.segments + 1));
    return mesh;
}

Mesh build(const SphereRecipe& recipe) {
    return build_sphere(recipe);
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

Mesh build(const LatheRecipe& recipe) {
    return build_lathe(recipe);
}

Mesh build(const BoxRecipe& recipe) {
    return build_box(recipe);
}

int count_or(JsonReader& reader, const std::string& key, int fallback, int minimum) {
    return static_cast<int>(reader.integer_or(key, fallback, minimum, kMaximumSegments));
}

MeshRecipe parse_disc(JsonReader& reader) {
    DiscRecipe recipe;
    recipe.inner_radius = reader.number("inner_radius", {.minimum = 0.0, .maximum = kMeshLength.maximum});
    recipe.outer_radius = reader.number("outer_radius", kMeshLength);
    if (recipe.outer_radius <= recipe.inner_radius)
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

std::vector<glm::dvec2> parse_profile(JsonReader& reader) {
    constexpr std::size_t kMostPoints = 256;
    const std::string key = "profile";
    const nlohmann::json& points = reader.raw(key);
    if (!points.is_array() || points.size() < 2 || points.size() > kMostPoints)
        reader.fail(key, points.is_array() ? fmt::format("{} points", points.size()) : points.type_name(),
                    fmt::format("2 to {} points [radius, height]", kMostPoints));
    std::vector<glm::dvec2> profile;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::string pointer = fmt::format("{}/{}", key, i);
        const nlohmann::json& point = points[i];
        if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number())
            reader.fail(pointer, point.type_name(), "[radius, height]");
        const auto radius = point[0].get<double>();
        const auto height = point[1].get<double>();
        const bool end = i == 0 || i + 1 == points.size();
        if (!(radius == 0.0 ? end : radius >= kMeshLength.minimum && radius <= kMeshLength.maximum))
            reader.fail(
                pointer + "/0", fmt::format("{}", radius),
                fmt::format("a number in [{}, {}]{}", kMeshLength.minimum, kMeshLength.maximum, end ? " or 0" : ""),
                end ? "" : "only the first and the last point may lie on the axis");
        if (!(std::abs(height) <= kMeshLength.maximum))
            reader.fail(pointer + "/1", fmt::format("{}", height),
                        fmt::format("a number in [{}, {}]", -kMeshLength.maximum, kMeshLength.maximum));
        profile.emplace_back(radius, height);
        if (i > 0 && glm::distance(profile[i], profile[i - 1]) < kMeshLength.minimum)
            reader.fail(pointer, "the point before it again",
                        fmt::format("one at least {} m away", kMeshLength.minimum));
    }
    if (profile.size() == 2 && profile[0].x == 0.0 && profile[1].x == 0.0)
        reader.fail(key, "both points on the axis", "a radius");
    return profile;
}

MeshRecipe parse_lathe(JsonReader& reader) {
    LatheRecipe recipe;
    recipe.profile = parse_profile(reader);
    recipe.smooth = reader.boolean_or("smooth", recipe.smooth);
    recipe.steps = static_cast<int>(reader.integer_or("steps", recipe.steps, 1, 256));
    recipe.segments = count_or(reader, "segments", recipe.segments, 3);
    const std::vector<double> turn =
        reader.numbers_or("longitude_deg", {recipe.from_deg, recipe.to_deg}, {.minimum = 0.0, .maximum = 360.0});
    recipe.from_deg = turn[0];
    recipe.to_deg = turn[1];
    if (!(recipe.to_deg - recipe.from_deg >= 1.0))
        reader.fail("longitude_deg/1", fmt::format("{}", turn[1]), fmt::format("at least {}", turn[0] + 1.0));
    recipe.flatten = reader.number_or("flatten", recipe.flatten, {.minimum = 1e-3, .maximum = 1e3});
    if (reader.choice_or("tangent", "around", {"around", "along"}) == "along")
        recipe.tangent = LatheRecipe::Tangent::Along;
    return recipe;
}

void parse_faces(JsonReader& reader, BoxRecipe& recipe) {
    if (!reader.has("faces")) return;
    const nlohmann::json& faces = reader.raw("faces");
    const auto refuse = [&](const std::string& found) {
        reader.fail("faces", found, "one or more of \"top\", \"sides\", \"bottom\", each once");
    };
    if (!faces.is_array() || faces.empty()) refuse(faces.is_array() ? "none" : faces.type_name());
    recipe.top = recipe.sides = recipe.bottom = false;
    for (const nlohmann::json& face : faces) {
        bool& wanted = face == "top" ? recipe.top : face == "sides" ? recipe.sides : recipe.bottom;
        if ((face != "top" && face != "sides" && face != "bottom") || wanted)
            refuse(face.is_string() ? fmt::format("\"{:.20}\"", face.get<std::string>()) : face.type_name());
        wanted = true;
    }
}

MeshRecipe parse_box(JsonReader& reader) {
    BoxRecipe recipe;
    const std::vector<double> size = reader.numbers("size", 3, kMeshLength);
    recipe.width = size[0];
    recipe.height = size[1];
    recipe.depth = size[2];
    const double half = std::min(recipe.width, recipe.depth) / 2.0;
    recipe.corner_radius = reader.number_or("corner_radius", 0.0, {.minimum = 0.0, .maximum = half});
    recipe.corner_steps = static_cast<int>(reader.integer_or("corner_steps", recipe.corner_steps, 1, 256));
    double most = std::min(half, recipe.height / 2.0);
    if (recipe.corner_radius > 0.0) most = std::min(most, recipe.corner_radius);
    recipe.bevel = reader.number_or("bevel", 0.0, {.minimum = 0.0, .maximum = most, .maximum_open = true});
    parse_faces(reader, recipe);
    return recipe;
}

}  // namespace

bool is_mesh_recipe(const nlohmann::json& document) {
    return document.is_object() && document.contains("mesh");
}

MeshRecipe parse_mesh_recipe(const nlohmann::json& document, const std::string& file) {
    JsonReader root(document, file);
    MeshRecipe recipe = parse_shape(root.object("mesh"));
    root.finish();
    return recipe;
}

MeshRecipe parse_shape(JsonReader reader) {
    using Parse = MeshRecipe (*)(JsonReader&);
    const auto parse = reader.choice<Parse>("type", {{"disc", parse_disc},
                                                     {"sphere", parse_sphere},
                                                     {"plane", parse_plane},
                                                     {"lathe", parse_lathe},
                                                     {"box", parse_box}});
    MeshRecipe recipe = parse(reader);
    reader.finish();
    return recipe;
}

Mesh build_mesh(const MeshRecipe& recipe) {
    return std::visit([](const auto& shape) { return build(shape); }, recipe);
}

}  // namespace rowland::scene
