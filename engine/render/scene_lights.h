#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/material.h"
#include "engine/render/shaders/light_block.h"
#include "engine/render/surface_features.h"

namespace rowland::render {

/// The lights of a world, as shaders read them.
struct SceneLights {
    LightBlock block = {};                  ///< the light that casts the shadow first
    std::vector<glm::vec3> strengths;       ///< see FrameLight::light_strengths
    std::optional<glm::vec3> shadow_light;  ///< direction toward it
    int dropped = 0;                        ///< number beyond ROWLAND_MAXIMUM_LIGHTS

    /// The bits of feature::kLights that they need.
    SurfaceFeatures features() const;
};

/// A light's WorldMatrix, if it has one, moves and turns it.
SceneLights gather_lights(ecs::World& world, const glm::dmat3& rec709_to_working);

/// All directional lights, also those that gather_lights() drops.
std::vector<DistantLight> distant_lights(ecs::World& world);

}  // namespace rowland::render
