#pragma once

#include <cstdint>
#include <vector>

#include "engine/gpu/shader_library.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"

namespace rowland::render {

/// What an object's shaders must be able to do, a bit each; no program has more than its objects need.
using SurfaceFeatures = std::uint32_t;

namespace feature {
inline constexpr SurfaceFeatures kColours = 1U << 0U;
inline constexpr SurfaceFeatures kSkinned = 1U << 1U;
inline constexpr SurfaceFeatures kBaseColourMap = 1U << 2U;
inline constexpr SurfaceFeatures kMetallicRoughnessMap = 1U << 3U;
inline constexpr SurfaceFeatures kNormalMap = 1U << 4U;
inline constexpr SurfaceFeatures kOcclusionMap = 1U << 5U;
inline constexpr SurfaceFeatures kEmissiveMap = 1U << 6U;
inline constexpr unsigned kSecondUvShift = 8;  ///< a map's bit, so far to the left: it uses the second set of UVs
inline constexpr SurfaceFeatures kTextureTransform = 1U << 16U;
inline constexpr SurfaceFeatures kDoubleSided = 1U << 17U;
inline constexpr SurfaceFeatures kAlphaMask = 1U << 18U;
inline constexpr SurfaceFeatures kAlphaBlend = 1U << 19U;
inline constexpr SurfaceFeatures kUnlit = 1U << 20U;
inline constexpr SurfaceFeatures kDirectionalLights = 1U << 21U;
inline constexpr SurfaceFeatures kPunctualLights = 1U << 22U;
inline constexpr SurfaceFeatures kShadows = 1U << 23U;
inline constexpr SurfaceFeatures kSeveralDirectionalLights = 1U << 24U;
inline constexpr SurfaceFeatures kKeyLights = 1U << 25U;
inline constexpr SurfaceFeatures kLights =
    kDirectionalLights | kSeveralDirectionalLights | kPunctualLights | kShadows | kKeyLights;
}  // namespace feature

/// Of a surface on a mesh. `lights`: those of feature::kLights that the frame has.
SurfaceFeatures features_of(const StandardMaterial& material, const GpuMesh& mesh, bool skinned,
                            SurfaceFeatures lights);
/// What is left of them where nothing is lit: base colour, alpha and emission.
SurfaceFeatures without_light(SurfaceFeatures features);
/// What is left of them in a shadow map: which pixels there are.
SurfaceFeatures of_shadow(SurfaceFeatures features);

/// The same as defines for the shaders.
std::vector<gpu::Define> defines_of(SurfaceFeatures features);
/// Adds the defines to a program that has some of its own; those it has already stay as they are.
void add_defines(SurfaceFeatures features, gpu::ProgramDesc& desc);

}  // namespace rowland::render
