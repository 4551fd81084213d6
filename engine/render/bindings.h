#pragma once

namespace rowland::render {

// As in shaders/. Texture units 8 to 14 and buffer bindings from 4 on belong to material types.
inline constexpr unsigned kEnvironmentUnit = 0;
inline constexpr unsigned kBrdfUnit = 1;
inline constexpr unsigned kShadowUnit = 2;
inline constexpr unsigned kBaseColourUnit = 3;
inline constexpr unsigned kMetallicRoughnessUnit = 4;
inline constexpr unsigned kNormalUnit = 5;
inline constexpr unsigned kOcclusionUnit = 6;
inline constexpr unsigned kEmissiveUnit = 7;
inline constexpr unsigned kKeyIrradianceUnit = 15;

inline constexpr unsigned kFrameBinding = 0;
inline constexpr unsigned kObjectBinding = 1;
inline constexpr unsigned kLightBinding = 2;
inline constexpr unsigned kJointBinding = 3;  ///< of shader storage, which counts apart; the others are uniform blocks

}  // namespace rowland::render
