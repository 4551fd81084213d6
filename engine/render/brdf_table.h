#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/gpu/texture.h"

namespace rowland::render {

/// Split-sum table of the GGX lobe [Karis 2013]: for n·v along columns and perceptual roughness along rows, texel
/// centres at (i + ½)/size, (scale, bias) such that the directional albedo is f0·scale + bias. Deterministic
/// quasi-Monte Carlo, error < 5e-3.
std::vector<glm::vec2> bake_brdf_table(int size);

/// The table as shaders read it.
gpu::Texture brdf_texture();

/// lighting::lobe_node_table() as shaders read it, its planes one upon another.
gpu::Texture lobe_nodes_texture();

}  // namespace rowland::render
