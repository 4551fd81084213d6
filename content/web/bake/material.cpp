#include "content/web/bake/material.h"

#include <fmt/format.h>

#include <glm/matrix.hpp>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "content/web/bake/exports.h"
#include "engine/colour/colour_space.h"
#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "modules/diffraction/rigorous/relief.h"

namespace rowland::web {

namespace {

/// Levels per octave of the smoothed kernel: blur(). Of a kernel of several views, blur_for_lights() makes one less
/// than kLevelsOfViews; a CD's texture then has 17 MB.
constexpr int kLevels = 8;
constexpr int kLevelsOfViews = 4;

/// Efficiencies as solve.cpp and material.ts give them: the first wavelength, the step between wavelengths, the number
/// of views and of orders, the orders, then EfficiencyGrid::values.
std::shared_ptr<const diffraction::EfficiencyGrid> efficiency_grid(std::span<const float> numbers, double pitch_nm) {
    using diffraction::EfficiencyGrid;
    constexpr std::size_t kHeader = 4;
    const auto refuse = [](const std::string& found, const std::string& expected) {
        refuse_input("efficiencies", "", found, expected, "take all of material.efficiencies of an exported document");
    };
    if (numbers[0] != EfficiencyGrid::wavelength_at(0) || numbers[1] != EfficiencyGrid::kStep_nm ||
        numbers[2] != EfficiencyGrid::kViews)
        refuse(fmt::format("{} views of wavelengths from {} nm in steps of {} nm", numbers[2], numbers[0], numbers[1]),
               fmt::format("{} views from {} nm in steps of {} nm", EfficiencyGrid::kViews,
                           EfficiencyGrid::wavelength_at(0), EfficiencyGrid::kStep_nm));
    const auto orders = numbers.subspan(kHeader, static_cast<std::size_t>(numbers[3]));
    const auto values = numbers.subspan(kHeader + orders.size());
    auto grid = std::make_shared<EfficiencyGrid>(
        diffraction::empty_grid(pitch_nm, std::vector<int>(orders.begin(), orders.end())));
    if (orders.empty() || values.size() != grid->values.size())
        refuse(fmt::format("{} values of {} orders", values.size(), orders.size()),
               fmt::format("{}, and an order", grid->values.size()));
    for (std::size_t i = 1; i < orders.size(); ++i)
        if (!(orders[i - 1] < orders[i]))
            refuse(fmt::format("order {} before {}", orders[i - 1], orders[i]), "ascending orders");
    for (const float value : values)
        if (!(value >= 0.0F && value <= 1.0F + diffraction::kRowSumTolerance))
            refuse(fmt::format("a value of {}", value), "0 to 1");
    grid->values.assign(values.begin(), values.end());
    return grid;
}

/// Appends the arguments of solve() in solve.cpp: the shape's index in ReliefShape plus 1 (0: there is nothing to
/// solve), pitch, depth, duty, the index over the grooves or of a sheet, the metal or -1, a sheet's reflectance.
void append_relief(const Material& material, Numbers& numbers) {
    const diffraction::Grating& grating = material.grating();
    glm::vec2 shape(0.0F);
    std::visit(
        [&](const auto& profile) {
            if constexpr (requires { profile.depth_nm; }) shape.x = static_cast<float>(profile.depth_nm);
            if constexpr (requires { profile.duty; }) shape.y = static_cast<float>(profile.duty);
        },
        grating.profile);
    const auto known = diffraction::relief_shape(grating.profile);
    append(static_cast<float>(material.unsolved && known ? known->index() + 1 : 0), numbers);
    append(static_cast<float>(grating.pitch_nm), numbers);
    append(shape, numbers);
    const auto& sheet = grating.transmission;
    append(static_cast<float>(sheet ? sheet->ior : diffraction::groove_medium(grating.cover)), numbers);
    append(static_cast<float>(grating.metal ? static_cast<int>(*grating.metal) : -1), numbers);
    append(static_cast<float>(sheet ? sheet->reflectance : 0.0), numbers);
}

}  // namespace

const glm::dmat3& xyz_to_working() {
    static const glm::dmat3 matrix = glm::inverse(colour::rec709_to_xyz());
    return matrix;
}

/// From a material's JSON, as JSON.stringify() gives it. `efficiencies`: `count` numbers of efficiency_grid(), or none.
ROWLAND_EXPORT(read_material)
Material* read_material(const char* json, std::size_t size, const float* efficiencies, std::size_t count) {
    auto* material = new Material;
    const std::string name = "material";
    const auto refuse_named = [](const std::string& file) -> diffraction::NamedText {
        refuse_input(file, "", "a file beside the material", "a material that names no file");
    };
    const nlohmann::json document = nlohmann::json::parse({json, size});
    material->source = diffraction::parse_gltf_extension(document, name, refuse_named, "");
    if (const auto refusal = diffraction::baked_refusal(material->grating()))
        refuse_input(name, refusal->key, refusal->found, refusal->expected, refusal->remedy);
    if (material->grating().transmission)
        refuse_input(name, "/transmission", "a sheet that transmits", "a reflecting grating", "leave it out");
    diffraction::Grating& grating = material->source.material.grating;
    if (std::holds_alternative<diffraction::PitSequenceLobe>(grating.lobe))
        refuse_input(name, "/grating/groove_lobe/pit_sequence", "a pit sequence", "\"flat\", a sigma, or pits",
                     "pages do not draw its orders: use pits");
    if (count > 0 && grating.theory == diffraction::Theory::Scalar)
        refuse_input(name, "/grating/theory", "efficiencies beside scalar theory", "\"theory\": \"rigorous\"",
                     "add it, or leave the efficiencies out");
    if (count > 0) grating.efficiencies = efficiency_grid({efficiencies, count}, grating.pitch_nm);
    if (!is_solved(grating) && !grating.films.empty())
        refuse_input(name, "/grating/films", "films on the grooves", "their efficiencies beside them",
                     "export the material and give its efficiencies");
    // A worker solves where the material asks for it.
    material->unsolved = !is_solved(grating) && document["grating"].contains("theory");
    if (!is_solved(grating)) grating.theory = diffraction::Theory::Scalar;
    const colour::LightSpectra spectra(material->source.material.quality.illuminant);
    const diffraction::ColourKernel kernel(grating, spectra);
    material->kernel = depends_on_direction(grating) ? kernel_table(grating, spectra) : tabulate(kernel);
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
    append_relief(*material, *numbers);
    return numbers;
}

/// Columns, levels, views, KernelUniforms, kernel_views, then the texels of three layers of so many views, RGB:
/// shaders/kernel.glsl.
ROWLAND_EXPORT(kernel_texture) Numbers* kernel_texture(const Material* material, int most_columns) {
    using namespace diffraction;
    const double pitch_nm = material->grating().pitch_nm;
    const KernelTable kernel = in_space(material->kernel, material->has_pits() ? glm::dmat3(1.0) : xyz_to_working());
    const BlurredKernel blurred =
        blur_for_lights(kernel, pitch_nm, most_columns, kernel.views > 1 ? kLevelsOfViews : kLevels);
    const KernelUniforms uniforms = kernel_uniforms(kernel, blurred);
    auto* numbers = new Numbers;
    append(static_cast<float>(blurred.columns), *numbers);
    append(static_cast<float>(blurred.levels), *numbers);
    append(static_cast<float>(blurred.views), *numbers);
    append(uniforms.scale_bias, *numbers);
    append(uniforms.rows, *numbers);
    append(uniforms.reach, *numbers);
    append(kernel_views(blurred, 3), *numbers);
    for (int column = 0; column < 3; ++column)
        for (const glm::mat3& value : blurred.values) append(value[column], *numbers);
    return numbers;
}

}  // namespace rowland::web
