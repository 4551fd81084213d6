#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "engine/scene/mesh.h"

namespace rowland::inspector {

/// What the material is shown on.
enum class PreviewShape { Disc, Sphere, Card, Sheet, Model };
inline constexpr std::array kPreviewShapes = {PreviewShape::Disc, PreviewShape::Sphere, PreviewShape::Card,
                                              PreviewShape::Sheet, PreviewShape::Model};

/// "disc", "sphere", "card", "sheet", "model".
const char* preview_shape_name(PreviewShape shape);
std::optional<PreviewShape> parse_preview_shape(std::string_view name);

/// The mesh of a shape other than Model, about 0.1 m in size, at the origin. The disc is the demo's and lies in XZ; the
/// card stands in XY; the sheet is a card bent around the vertical by 120°, with the grating vector around the bend.
scene::Mesh preview_mesh(PreviewShape shape);

/// The factor by which what fills a box gets the size of the other shapes.
float fitting_scale(const scene::Bounds& box);

}  // namespace rowland::inspector
