#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "engine/core/json_reader.h"
#include "engine/scene/mesh.h"

namespace rowland::scene {

/// Flat annulus around the origin in the XZ plane, normal +Y: a compact disc. The tangent is radial, outward, exactly;
/// u grows from the inner to the outer edge, v = angle / 2π, the angle from +X towards −Z, counter-clockwise seen from
/// above. (rings + 1)(segments + 1) vertices; the default has the 25 000 of Lindsay & Agu 2006.
struct DiscRecipe {
    double inner_radius = 0.0;  ///< metres, >= 0
    double outer_radius = 0.0;  ///< metres, > inner_radius
    int rings = 99;             ///< rows of quads between the edges, 1 … 2048
    int segments = 249;         ///< sectors, 3 … 2048; the seam's vertices are doubled, with v = 0 and v = 1
};

/// Sphere around the origin, poles on ±Y. The tangent points along growing longitude (+X towards −Z); u = longitude /
/// 2π, v grows linearly with latitude from the south to the north pole.
struct SphereRecipe {
    double radius = 0.0;  ///< metres, > 0
    int rings = 64;       ///< bands of latitude, 2 … 2048
    int segments = 128;   ///< sectors of longitude, 3 … 2048
};

/// Rectangle around the origin in the XZ plane, normal +Y, tangent +X, v towards −Z.
struct PlaneRecipe {
    double width = 0.0;    ///< metres along X, > 0
    double depth = 0.0;    ///< metres along Z, > 0
    int subdivisions = 1;  ///< quads along either side, 1 … 2048
};

using MeshRecipe = std::variant<DiscRecipe, SphereRecipe, PlaneRecipe>;

/// Whether a JSON document is a mesh recipe: an object with the key "mesh".
bool is_mesh_recipe(const nlohmann::json& document);

/// Reads `{"mesh": {"type": "disc", …}}`. Throws Error (input).
MeshRecipe parse_mesh_recipe(const nlohmann::json& document, const std::string& file);
MeshRecipe parse_mesh_recipe(JsonReader& root);

/// The mesh of a recipe, counter-clockwise from outside (from +Y where it is flat). v grows along cross(normal,
/// tangent), so the tangent's w is −1.
Mesh build_mesh(const MeshRecipe& recipe);

}  // namespace rowland::scene
