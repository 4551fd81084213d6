#pragma once

namespace rowland::diffraction {

// As in shaders/. Units below 8 and bindings below 4 are the engine's.
inline constexpr unsigned kVertexLightBinding = 4;    ///< storage
inline constexpr unsigned kTableRangeBinding = 5;     ///< storage
inline constexpr unsigned kKeyLobeBinding = 6;        ///< uniform
inline constexpr unsigned kLightColourBinding = 7;    ///< uniform
inline constexpr unsigned kStreakSegmentBinding = 6;  ///< storage: numbered separately from uniform
inline constexpr unsigned kTableUnit = 8;
inline constexpr unsigned kWavelengthTableUnit = 9;
inline constexpr unsigned kKernelUnit = 10;
inline constexpr int kFirstColourLayer = 3;  ///< of the kernel's texture
inline constexpr unsigned kMapUnit = 11;
inline constexpr unsigned kSecondMapUnit = 9;     ///< of `circle`
inline constexpr unsigned kVertexLightUnit = 12;  ///< of representations without storage
inline constexpr unsigned kGrooveMapUnit = 13;
inline constexpr unsigned kLobeUnit = 14;

}  // namespace rowland::diffraction
