#pragma once

namespace rowland::diffraction {

// As in shaders/spikes.vert.glsl. Units and bindings below 4 are the engine's.
inline constexpr unsigned kTangentLightBinding = 4;
inline constexpr unsigned kTableRangeBinding = 5;
inline constexpr unsigned kSpikeTableUnit = 4;
inline constexpr unsigned kWavelengthTableUnit = 5;

}  // namespace rowland::diffraction
