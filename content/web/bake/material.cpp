#include "content/web/bake/material.h"

#include <glm/matrix.hpp>
#include <string>

#include "content/web/bake/exports.h"
#include "engine/colour/colour_space.h"
#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/representations/direct/direct.h"

namespace rowland::web {

namespace {

/// Levels of the smoothed kernel an octave: blur().
constexpr int kLevels = 8;

}  // namespace

const glm::dmat3& xyz_to_working() {
    static const glm::dmat3 matrix = glm::inverse(colour::rec709_to_xyz());
    return matrix;
}

/// From a material's JSON, as JSON.stringify() gives it.
ROWLAND_EXPORT(read_material) Material* read_material(const char* json, std::size_t size) {
    auto* material = new Material;
    const std::string name = "material";
    material->source = diffraction::parse_gltf_extension(nlohmann::json::parse({json, size}), name, {});
    if (const auto refusal = diffraction::baked_refusal(material->grating()))
        refuse_input(name, refusal->key, refusal->found, refusal->expected, refusal->remedy);
    if (material->grating().transmission)
        refuse_input(name, "/transmission", "a sheet that transmits", "a reflecting grating", "leave it out");
    material->source.material.grating.theory = diffraction::Theory::Scalar;  // solving is not part of the package
    const diffraction::ColourKernel kernel(material->grating(),
                                           colour::LightSpectra(material->source.material.quality.illuminant));
    material->kernel = tabulate(kernel);
    material->zero_order_xyz = kernel.zero_order_xyz();
    return material;
}

ROWLAND_EXPORT(release_material) void release_material(const Material* material) {
    delete material;
}

/// The material's numbers, in the order of MaterialFacts in material.ts.
ROWLAND_EXPORT(material_facts) Numbers* material_facts(const Material* material) {
    using namespace diffraction;
    const Grating& grating = material->grating();
    const LayerWeights weights = layer_weights(grating, material->source.material.quality.illuminant);
    const glm::dmat3 space = material->has_pits() ? glm::dmat3(1.0) : xyz_to_working();
    auto* numbers = new Numbers;
    append(static_cast<float>(grating.pitch_nm), *numbers);
    append(static_cast<float>(grating.lobe.index()), *numbers);
    glm::vec2 gaussian(0.0F);
    glm::vec4 pits(0.0F);
    const auto peak = [](double sigma) { return lobe_density(GaussianLobe{sigma}, 0.0, 550.0); };
    if (const auto* lobe = std::get_if<GaussianLobe>(&grating.lobe)) gaussian = {lobe->sigma, peak(lobe->sigma)};
    if (const auto* lobe = std::get_if<PitsLobe>(&grating.lobe)) {
        gaussian = {kCoherentSigma, lobe->coherent * peak(kCoherentSigma)};
        pits = glm::vec4(glm::vec3(lobe->length_nm / kPitsWavelengths_nm), 1.0 - lobe->coherent);
    }
    append(gaussian, *numbers);
    append(pits, *numbers);
    append(static_cast<float>(grating.cover ? grating.cover->ior : 0.0), *numbers);
    append(glm::mat3(space * material->zero_order_xyz), *numbers);
    append(glm::mat3(xyz_to_working()), *numbers);
    append(glm::vec3(xyz_to_working() * weights.mirror), *numbers);
    append(glm::vec3(xyz_to_working() * weights.base), *numbers);
    append(material->source.material.base.colour, *numbers);
    append(material->source.material.base.roughness, *numbers);
    append(static_cast<float>(material->source.has_base ? 1 : 0), *numbers);
    append(static_cast<float>(material->source.groove_rotation), *numbers);
    append(static_cast<float>(is_even(material->kernel) ? 1 : 0), *numbers);
    return numbers;
}

/// Columns, levels, KernelUniforms, then the texels of three layers, RGB: shaders/kernel.glsl.
ROWLAND_EXPORT(kernel_texture) Numbers* kernel_texture(const Material* material, int most_columns) {
    using namespace diffraction;
    const double pitch_nm = material->grating().pitch_nm;
    const KernelTable kernel = in_space(material->kernel, material->has_pits() ? glm::dmat3(1.0) : xyz_to_working());
    const BlurredKernel blurred = blur_for_lights(kernel, pitch_nm, most_columns, kLevels);
    const KernelUniforms uniforms = kernel_uniforms(kernel, blurred, pitch_nm);
    auto* numbers = new Numbers;
    append(static_cast<float>(blurred.columns), *numbers);
    append(static_cast<float>(blurred.levels), *numbers);
    append(uniforms.scale_bias, *numbers);
    append(uniforms.rows, *numbers);
    append(uniforms.reach, *numbers);
    for (int column = 0; column < 3; ++column)
        for (const glm::mat3& value : blurred.values) append(value[column], *numbers);
    return numbers;
}

}  // namespace rowland::web
