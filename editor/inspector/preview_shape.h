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

/// The mesh of a shape but Model, about 0.1 m large around the origin. The disc is the demo's, flat in XZ; the card
/// stands in XY; the sheet is a card bent around the vertical by 120°, the grating vector around the bend.
scene::Mesh preview_mesh(PreviewShape shape);

/// A user's model, scaled to the size of the other shapes around the origin.
scene::Mesh fitted_model(scene::Mesh mesh);

}  // namespace rowland::inspector
