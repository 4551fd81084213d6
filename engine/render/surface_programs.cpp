#include "engine/render/surface_programs.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace rowland::render {

namespace {

constexpr std::array<std::pair<SurfaceFeatures, const char*>, 23> kSwitches = {
    {{feature::kColours, "HAS_COLOURS"},
     {feature::kSkinned, "SKINNED"},
     {feature::kTextureTransformExtension, "TEXTURE_TRANSFORM"},
     {feature::kDoubleSided, "DOUBLE_SIDED"},
     {feature::kAlphaMask, "ALPHA_MASK"},
     {feature::kAlphaBlend, "ALPHA_BLEND"},
     {feature::kUnlit, "UNLIT"},
     {feature::kClearCoat, "CLEAR_COAT"},
     {feature::kDirectionalLights, "DIRECTIONAL_LIGHTS"},
     {feature::kSeveralDirectionalLights, "SEVERAL_DIRECTIONAL_LIGHTS"},
     {feature::kPunctualLights, "PUNCTUAL_LIGHTS"},
     {feature::kShadows, "SHADOWS"},
     {feature::kKeyLights, "KEY_LIGHTS"},
     {feature::kAmbientOcclusion, "AMBIENT_OCCLUSION"},
     {feature::kSoftShadows, "SOFT_SHADOWS"},
     {feature::kLocalReflections, "LOCAL_REFLECTIONS"},
     {feature::kObjectReflections, "OBJECT_REFLECTIONS"},
     {feature::kRoughReflections, "ROUGH_REFLECTIONS"},
     {feature::kLocalProbe, "LOCAL_PROBE"},
     {feature::kLightPart, "LIGHT_PART"},
     {feature::kFromEye, "FROM_EYE"},
     {feature::kScratches, "WEAR_SCRATCHES"},
     {feature::kInstanced, "INSTANCED"}}};

bool is_identity(const scene::TextureTransform& transform) {
    return transform.offset == glm::vec2(0.0F) && transform.rotation == 0.0F && transform.scale == glm::vec2(1.0F);
}

SurfaceFeatures second_uv(SurfaceFeatures map) {
    return map << feature::kSecondUvShift;
}

SurfaceFeatures map_features(const StandardMaterial& material) {
    SurfaceFeatures features = 0;
    for (const SurfaceMap& map : kSurfaceMaps) {
        const SurfaceTexture& texture = material.*map.texture;
        if (!texture) continue;
        features |= map.bit;
        if (texture.uv_set == 1) features |= second_uv(map.bit);
        if (!is_identity(texture.transform)) features |= feature::kTextureTransformExtension;
    }
    return features;
}

/// Removes all maps but `kept`, and the transform if no map remains.
SurfaceFeatures keep_maps(SurfaceFeatures features, SurfaceFeatures kept) {
    for (const SurfaceMap& map : kSurfaceMaps)
        if ((map.bit & kept) == 0) features &= ~(map.bit | second_uv(map.bit));
    if ((features & kept) == 0) features &= ~feature::kTextureTransformExtension;
    return features;
}

}  // namespace

SurfaceFeatures features_of(const StandardMaterial& material, const GpuMesh& mesh, bool skinned,
                            SurfaceFeatures lights) {
    SurfaceFeatures features = map_features(material) | (lights & feature::kLights);
    if (mesh.has_colours()) features |= feature::kColours;
    if (skinned) features |= feature::kSkinned;
    if (material.double_sided) features |= feature::kDoubleSided;
    if (material.wear_texture && material.scratched) features |= feature::kScratches;
    if (material.clear_coat > 0.0F) features |= feature::kClearCoat;
    if (material.roughness == 0.0F) features &= ~feature::kRoughReflections;
    if (material.alpha_mode == scene::AlphaMode::Mask) features |= feature::kAlphaMask;
    if (material.passes_light) features |= feature::kPassesLight;
    // A surface that blends is not in the depth that occlusion is computed from.
    if (material.alpha_mode == scene::AlphaMode::Blend || material.passes_light)
        features = (features | feature::kAlphaBlend) & ~feature::kAmbientOcclusion;
    return material.unlit ? without_light(features) : features;
}

SurfaceFeatures without_light(SurfaceFeatures features) {
    features &=
        ~(feature::kLights | feature::kDoubleSided | feature::kClearCoat | feature::kPassesLight | feature::kScratches);
    return keep_maps(features, feature::kBaseColourMap | feature::kEmissiveMap) | feature::kUnlit;
}

SurfaceFeatures of_shadow(SurfaceFeatures features) {
    if ((features & feature::kAlphaMask) == 0) return features & (feature::kSkinned | feature::kInstanced);
    return keep_maps(features, feature::kBaseColourMap) &
           ~(feature::kLights | feature::kDoubleSided | feature::kUnlit | feature::kAlphaBlend | feature::kClearCoat |
             feature::kScratches);
}

std::vector<gpu::Define> defines_of(SurfaceFeatures features) {
    std::vector<gpu::Define> defines;
    bool uses_uv = false;
    bool uses_uv1 = false;
    for (const SurfaceMap& map : kSurfaceMaps) {
        if ((features & map.bit) == 0) continue;
        const bool second = (features & second_uv(map.bit)) != 0;
        (second ? uses_uv1 : uses_uv) = true;
        defines.emplace_back(map.define, second ? "uv1" : "uv");
    }
    if (uses_uv) defines.emplace_back("HAS_UV", "");
    if (uses_uv1) defines.emplace_back("HAS_UV1", "");
    for (const auto& [bit, define] : kSwitches)
        if ((features & bit) != 0) defines.emplace_back(define, "");
    return defines;
}

namespace {

void remove(const char* define, gpu::ProgramDesc& desc) {
    std::erase_if(desc.defines, [&](const gpu::Define& other) { return other.first == define; });
}

}  // namespace

int fragment_samplers(const gpu::ProgramDesc& desc) {
    static constexpr std::array<std::pair<const char*, int>, 7> kOfEffects = {{{"SHADOWS", 1},
                                                                               {"KEY_LIGHTS", 1},
                                                                               {"AMBIENT_OCCLUSION", 1},
                                                                               {"LOCAL_REFLECTIONS", 1},
                                                                               {"OBJECT_REFLECTIONS", 2},
                                                                               {"ROUGH_REFLECTIONS", 1},
                                                                               {"MATERIAL_CURVED_MIRROR", 1}}};
    int samplers = 2;  // the environment and the lobe's albedo
    for (const auto& [name, value] : desc.defines) {
        if (name == kMaterialSamplers) samplers += std::stoi(value);
        for (const auto& [effect, count] : kOfEffects)
            if (name == effect) samplers += count;
        for (const SurfaceMap& map : kSurfaceMaps)
            if (name == map.define) ++samplers;
    }
    return samplers;
}

void add_defines(SurfaceFeatures features, gpu::ProgramDesc& desc) {
    for (gpu::Define& define : defines_of(features)) {
        const bool present = std::any_of(desc.defines.begin(), desc.defines.end(),
                                         [&](const gpu::Define& other) { return other.first == define.first; });
        if (!present) desc.defines.push_back(std::move(define));
    }
    // Where the normal is not the vertices', ambient light is computed per pixel.
    if ((features & (feature::kNormalMap | feature::kDoubleSided | feature::kUnlit)) != 0)
        remove("AMBIENT_AT_VERTICES", desc);
    // Under a normal map, seen_roughness() blurs the mirror by the variation of the normals.
    if ((features & feature::kNormalMap) != 0) remove("MATERIAL_CURVED_MIRROR", desc);
    for (const char* effect : {"OBJECT_REFLECTIONS", "MATERIAL_CURVED_MIRROR", "WEAR_MAP"})
        if (fragment_samplers(desc) > kGuaranteedSamplers) remove(effect, desc);
}

namespace {

std::string key_of(const gpu::ProgramDesc& desc) {
    std::string key = desc.vertex + '\n' + desc.fragment;
    for (const auto& [name, value] : desc.defines) key.append("\n").append(name).append("=").append(value);
    return key;
}

}  // namespace

const gpu::Program& ProgramCache::get(const gpu::ProgramDesc& desc) {
    std::string key = key_of(desc);
    const auto found = programs_.find(key);
    if (found != programs_.end()) return found->second.program;
    return programs_.emplace(std::move(key), Compiled{desc, gpu::Program(library_, desc)}).first->second.program;
}

void ProgramCache::reload(const std::filesystem::path& source_tree) {
    gpu::ShaderLibrary library = library_;
    library.set_source_folder(source_tree);
    std::map<std::string, Compiled> programs;
    for (const auto& [key, compiled] : programs_)
        programs.emplace(key, Compiled{compiled.desc, gpu::Program(library, compiled.desc)});
    library_ = std::move(library);
    programs_ = std::move(programs);
}

}  // namespace rowland::render
