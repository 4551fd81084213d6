#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/lighting/sh_light.h"
#include "engine/render/material.h"
#include "engine/render/shaders/light_block.h"
#include "engine/render/surface_features.h"

namespace rowland::render {

/// The lights of a world, as shaders read them.
struct SceneLights {
    LightBlock block = {};                  ///< the shadow's light first
    std::vector<glm::vec3> colours;         ///< see FrameLight::light_colours
    std::optional<glm::vec3> shadow_light;  ///< direction toward it
    int left_out = 0;                       ///< those beyond ROWLAND_MAXIMUM_LIGHTS

    /// Those of feature::kLights that these ask for.
    SurfaceFeatures features() const;
};

/// Lights that stand at or are turned by a WorldMatrix use it.
SceneLights gather_lights(ecs::World& world, const glm::dmat3& rec709_to_working);

/// All directional lights, also those that gather_lights() leaves out.
std::vector<DistantLight> distant_lights(ecs::World& world);

/// Adds distant lights to a probe's raw radiance: L(s) = E δ(s − d), so l_i += E Y_i(d).
void add_distant_lights(std::span<const DistantLight> lights, lighting::ShLight& sh);

}  // namespace rowland::render
