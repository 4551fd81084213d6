#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/render/shader_interface.h"

namespace rowland::render {

/// What an object's shaders must do, a bit each. A program does only what its objects need.
using SurfaceFeatures = std::uint64_t;

namespace feature {
inline constexpr SurfaceFeatures kColours = 1U << 0U;
inline constexpr SurfaceFeatures kSkinned = 1U << 1U;
inline constexpr SurfaceFeatures kBaseColourMap = 1U << 2U;
inline constexpr SurfaceFeatures kMetallicRoughnessMap = 1U << 3U;
inline constexpr SurfaceFeatures kNormalMap = 1U << 4U;
inline constexpr SurfaceFeatures kOcclusionMap = 1U << 5U;
inline constexpr SurfaceFeatures kEmissiveMap = 1U << 6U;
inline constexpr SurfaceFeatures kWearMap = 1U << 7U;
inline constexpr SurfaceFeatures kRoughReflections = 1U << 8U;
inline constexpr SurfaceFeatures kPassesLight = 1U << 9U;
inline constexpr unsigned kSecondUvShift = 8;  ///< a map's bit shifted left by this: the map uses the second UV set
inline constexpr SurfaceFeatures kTextureTransformExtension = 1U << 16U;
inline constexpr SurfaceFeatures kDoubleSided = 1U << 17U;
inline constexpr SurfaceFeatures kAlphaMask = 1U << 18U;
inline constexpr SurfaceFeatures kAlphaBlend = 1U << 19U;
inline constexpr SurfaceFeatures kUnlit = 1U << 20U;
inline constexpr SurfaceFeatures kDirectionalLights = 1U << 21U;
inline constexpr SurfaceFeatures kPunctualLights = 1U << 22U;
inline constexpr SurfaceFeatures kShadows = 1U << 23U;
inline constexpr SurfaceFeatures kSeveralDirectionalLights = 1U << 24U;
inline constexpr SurfaceFeatures kKeyLights = 1U << 25U;
inline constexpr SurfaceFeatures kClearCoat = 1U << 26U;
inline constexpr SurfaceFeatures kAmbientOcclusion = 1U << 27U;
inline constexpr SurfaceFeatures kSoftShadows = 1U << 28U;
inline constexpr SurfaceFeatures kLocalReflections = 1U << 29U;
inline constexpr SurfaceFeatures kFromEye = 1U << 30U;  ///< of an outline: seen by the camera, not by the light
inline constexpr SurfaceFeatures kObjectReflections = 1U << 31U;
inline constexpr SurfaceFeatures kScratches = 1ULL << 32U;   ///< in the map of wear
inline constexpr SurfaceFeatures kLocalProbe = 1ULL << 33U;  ///< lit by a box's probe, or by two probes
inline constexpr SurfaceFeatures kLightPart = 1ULL << 34U;   ///< a draw may give only a part of the light
inline constexpr SurfaceFeatures kInstanced = 1ULL << 35U;   ///< its matrices are attributes of the instance
inline constexpr SurfaceFeatures kEffects =
    kAmbientOcclusion | kSoftShadows | kLocalReflections | kObjectReflections | kRoughReflections;
inline constexpr SurfaceFeatures kLights = kDirectionalLights | kSeveralDirectionalLights | kPunctualLights | kShadows |
                                           kKeyLights | kLocalProbe | kLightPart | kEffects;
}  // namespace feature

/// A texture of a surface. Its index in kSurfaceMaps is that of its transform in ObjectBlock.
struct SurfaceMap {
    SurfaceFeatures bit;
    const char* define;
    SurfaceTexture StandardMaterial::*texture;
    unsigned unit;
};
inline constexpr std::array<SurfaceMap, 6> kSurfaceMaps = {
    {{feature::kBaseColourMap, "BASE_COLOUR_MAP", &StandardMaterial::base_colour_texture, kFirstMapUnit},
     {feature::kMetallicRoughnessMap, "METALLIC_ROUGHNESS_MAP", &StandardMaterial::metallic_roughness_texture,
      kFirstMapUnit + 1},
     {feature::kNormalMap, "NORMAL_MAP", &StandardMaterial::normal_texture, kFirstMapUnit + 2},
     {feature::kOcclusionMap, "OCCLUSION_MAP", &StandardMaterial::occlusion_texture, kFirstMapUnit + 3},
     {feature::kEmissiveMap, "EMISSIVE_MAP", &StandardMaterial::emissive_texture, kFirstMapUnit + 4},
     {feature::kWearMap, "WEAR_MAP", &StandardMaterial::wear_texture, kWearUnit}}};

/// The features of a surface on a mesh. `lights`: the bits of feature::kLights that the frame has.
SurfaceFeatures features_of(const StandardMaterial& material, const GpuMesh& mesh, bool skinned,
                            SurfaceFeatures lights);
/// The features that an unlit surface needs: for base colour, alpha and emission.
SurfaceFeatures without_light(SurfaceFeatures features);
/// The features that a shadow map needs: for the surface's outline.
SurfaceFeatures of_shadow(SurfaceFeatures features);

/// The features as defines for the shaders.
std::vector<gpu::Define> defines_of(SurfaceFeatures features);
/// Samplers of a fragment stage that every OpenGL 4.5 has.
inline constexpr int kGuaranteedSamplers = 16;
/// The define by which a material's program tells how many samplers its own fragment code has.
inline constexpr const char* kMaterialSamplers = "MATERIAL_SAMPLERS";
/// An upper bound of the samplers of a program's fragment stage.
int fragment_samplers(const gpu::ProgramDesc& desc);
/// Adds the features' defines to a program's own, which win, and removes what the features exclude. If the program then
/// has more than kGuaranteedSamplers, as all six maps with all effects can, these are removed in turn until it has not:
/// reflections of objects, the mirror's average over pixels, wear.
void add_defines(SurfaceFeatures features, gpu::ProgramDesc& desc);

/// Programs by description, each compiled on first use.
class ProgramCache {
 public:
    gpu::ShaderLibrary& library() { return library_; }
    const gpu::ShaderLibrary& library() const { return library_; }

    /// Valid until reload(). Throws Error (system) if it does not compile.
    const gpu::Program& get(const gpu::ProgramDesc& desc);
    /// Recompiles all, from `source_tree` where it has their files. If one does not compile, all stay as they were and
    /// its Error (system) is thrown.
    void reload(const std::filesystem::path& source_tree);
    std::size_t size() const { return programs_.size(); }

 private:
    struct Compiled {
        gpu::ProgramDesc desc;
        gpu::Program program;
    };

    gpu::ShaderLibrary library_;
    std::map<std::string, Compiled> programs_;
};

}  // namespace rowland::render
