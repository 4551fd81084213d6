#pragma once

#include <span>

#include "engine/core/text.h"

namespace rowland::render {

// As in shaders/. Texture units 8 to 14 and buffer bindings from 4 on belong to material types.
inline constexpr unsigned kEnvironmentUnit = 0;
inline constexpr unsigned kBrdfUnit = 1;
inline constexpr unsigned kShadowUnit = 2;
inline constexpr unsigned kFirstMapUnit = 3;  ///< of the first five kSurfaceMaps
inline constexpr unsigned kKeyIrradianceUnit = 15;
inline constexpr unsigned kVisibilityUnit = 16;
inline constexpr unsigned kPlaneMapUnit = 17;
inline constexpr unsigned kMirrorUnit = 18;
inline constexpr unsigned kSurroundingLightUnit = 19;
inline constexpr unsigned kSurroundingNearnessUnit = 20;
inline constexpr unsigned kLobeNodesUnit = 21;
inline constexpr unsigned kWearUnit = 22;

inline constexpr unsigned kFrameBinding = 0;
inline constexpr unsigned kObjectBinding = 1;
inline constexpr unsigned kLightBinding = 2;
inline constexpr unsigned kReflectionBinding = 3;
inline constexpr unsigned kJointBinding = 3;  ///< shader storage, whose numbers are separate from uniform blocks

/// The renderer's shaders, and the interface files that modules' shaders include.
std::span<const EmbeddedFile> shader_files();

}  // namespace rowland::render
