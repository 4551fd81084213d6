#pragma once

#include <optional>

namespace rowland::render {

/// Occlusion by what the picture shows, from its depth: of ambient light, and of the light that casts shadows close to
/// where things touch.
struct AmbientOcclusionSettings {
    float radius_m = 0.1F;    ///< farthest occluder of ambient light; above 0
    float contact_m = 0.01F;  ///< length of a contact shadow's ray; 0: none

    friend bool operator==(const AmbientOcclusionSettings&, const AmbientOcclusionSettings&) = default;
};

/// The light that casts shadows is a disc, whose shadows' edges widen with the distance from what casts them.
struct SoftShadowSettings {
    float angular_radius = 0.03F;  ///< of the light, radians

    friend bool operator==(const SoftShadowSettings&, const SoftShadowSettings&) = default;
};

/// Effects on a surface's light that the renderer adds. Each that is off costs nothing.
struct Effects {
    std::optional<AmbientOcclusionSettings> ambient_occlusion = std::nullopt;
    std::optional<SoftShadowSettings> soft_shadows = std::nullopt;
    bool local_reflections = false;   ///< mirrors show what has a ReflectedTop
    bool object_reflections = false;  ///< what has ReflectsObjects mirrors the objects around it
    bool rough_reflections = false;   ///< a rough surface looks the environment up in four directions, not in one

    friend bool operator==(const Effects&, const Effects&) = default;
};

}  // namespace rowland::render
