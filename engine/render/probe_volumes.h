#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/light_probe.h"
#include "engine/render/light_maps.h"
#include "engine/render/material.h"

namespace rowland::render {

/// Component of an entity with a WorldMatrix: the light in a box about the entity's origin, where the probe was
/// captured. Objects in the box have this light instead of the renderer's probe. Where boxes overlap, the smaller one
/// comes first.
struct ProbeVolume {
    std::shared_ptr<const lighting::LightProbe> probe;
    glm::vec3 half{1.0F};  ///< of the box's sides, along the entity's axes
    float fade_m = 1.0F;   ///< width of the zone around the box in which its light fades to other light
};

/// The box of a ProbeVolume in the world.
struct ProbeBox {
    glm::mat4 box_to_world{1.0F};  ///< from the cube between −1 and 1
    glm::mat4 world_to_box{1.0F};
    float fade_m = 0.0F;

    float volume_m3() const;
    /// 1 in the box, 0 at `fade_m` from it and beyond; linear between.
    float weight(const glm::vec3& point) const;
};

/// The frame's volumes in the order of their entities. Volumes without a probe or with a singular matrix are left out.
struct ProbeVolumes {
    std::vector<ProbeBox> boxes;
    std::vector<std::shared_ptr<const lighting::LightProbe>> probes;
};
ProbeVolumes gather_volumes(ecs::World& world);

/// The light at a point. From the smallest box to the largest, each takes the fraction weight() of the light that the
/// smaller ones left; the renderer's probe takes the remainder. Of more than two parts the two largest are kept, less
/// the third largest, and normalised. Continuous in the point, except where three parts are equal.
LightMix light_at(const glm::vec3& point, std::span<const ProbeBox> boxes);

/// A probe as shaders and material types read it.
struct LitProbe {
    FrameLight light;
    lighting::AmbientLight ambient;  ///< without the analytic key lights
    /// Set once the probe lights a drawn surface.
    std::optional<LightMap> environment;
    gpu::Texture mirror;                     ///< set with `environment`, in units of its scale
    std::optional<LightMap> key_irradiance;  ///< set once a lit surface reads KEY_LIGHTS
};

/// Makes `environment` and `mirror`.
void put_on_gpu(LitProbe& probe, const glm::dmat3& rec709_to_working);

}  // namespace rowland::render
