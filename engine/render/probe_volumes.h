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
    float fade_m = 1.0F;   ///< beyond the box, over which its light gives way to other light; 0: at once
};

/// Where a volume's light holds, in the world.
struct ProbeBox {
    glm::mat4 box_to_world{1.0F};  ///< from the box between −1 and 1
    glm::mat4 world_to_box{1.0F};
    float fade_m = 0.0F;

    float volume_m3() const;
    /// 1 in the box, 0 at `fade_m` from it and beyond; linear between.
    float weight(const glm::vec3& point) const;
};

/// The frame's volumes in the order of their entities. A volume of a matrix that is singular is left out.
struct ProbeVolumes {
    std::vector<ProbeBox> boxes;
    std::vector<std::shared_ptr<const lighting::LightProbe>> probes;
};
ProbeVolumes gather_volumes(ecs::World& world);

/// The light at a point. A smaller box takes its weight() of what the boxes before it left, and the renderer's probe
/// takes the remainder; of more than two parts the third largest is subtracted from the larger two. Continuous in the
/// point, but where three parts are equal.
LightMix light_at(const glm::vec3& point, std::span<const ProbeBox> boxes);

/// A probe as shaders and material types read it.
struct LitProbe {
    FrameLight light;
    lighting::AmbientLight ambient;  ///< without the analytic key lights
    /// Of a probe that lights something that is drawn.
    std::optional<LightMap> environment;
    gpu::Texture mirror;                     ///< in units of environment's scale
    std::optional<LightMap> key_irradiance;  ///< none without analytic key lights
};

/// Makes its environment and mirror.
void put_on_gpu(LitProbe& probe, const glm::dmat3& rec709_to_working);

}  // namespace rowland::render
