#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "engine/gpu/texture.h"
#include "engine/lighting/light_probe.h"

namespace rowland::render {

/// Light by direction: a cube map of half floats in the working space, times `scale`.
struct LightMap {
    gpu::Texture map;
    float scale = 1.0F;
};

/// A probe's prefiltered environment.
LightMap environment_map(const lighting::LightProbe& probe, const glm::dmat3& rec709_to_working);

/// The environment as a mirror shows it, in units of environment_map()'s scale. Its levels are averages over 2×2
/// texels, for pixels that cover many, and not the levels of increasing roughness of environment_map().
gpu::Texture mirror_map(const lighting::LightProbe& probe, const glm::dmat3& rec709_to_working);

/// Irradiance from a probe's key lights as a function of the surface's normal, so that all key lights cost one look-up
/// per pixel. With 64² texels per face the error is at most 6e-3 of a point light's irradiance (where its cosine is
/// clamped at the horizon), and less for wider lobes.
LightMap key_irradiance_map(std::span<const lighting::KeyLight> keys, const glm::dmat3& rec709_to_working);

/// Split-sum table of the GGX lobe [Karis 2013]: for n·v along columns and perceptual roughness along rows, texel
/// centres at (i + ½)/size, (scale, bias) such that the directional albedo is f0·scale + bias. Deterministic
/// quasi-Monte Carlo, error < 5e-3.
std::vector<glm::vec2> bake_brdf_table(int size);

/// The table as shaders read it.
gpu::Texture brdf_texture();

/// lighting::lobe_node_table() as shaders read it, its planes stacked along y.
gpu::Texture lobe_nodes_texture();

}  // namespace rowland::render
