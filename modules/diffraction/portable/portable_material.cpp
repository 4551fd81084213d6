#include "modules/diffraction/portable/portable_material.h"

#include <array>

#include "modules/diffraction/asset/layer_weights.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/bake/blurred_kernel.h"
#include "modules/diffraction/representations/direct/direct.h"

namespace rowland::diffraction {

namespace {

nlohmann::json describe(const GrooveLobe& lobe) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe))
        return {{"type", "gaussian"}, {"sigma", gaussian->sigma}};
    if (const auto* pits = std::get_if<PitsLobe>(&lobe))
        return {{"type", "pits"},
                {"length_nm", pits->length_nm},
                {"coherent", pits->coherent},
                {"coherent_sigma", kCoherentSigma},
                {"wavelengths_nm", to_json(kPitsWavelengths_nm)}};
    return {{"type", "flat"}};
}

/// The texture that blur_for_lights() makes; its values follow from the kernel.
nlohmann::json smoothing(const KernelTable& kernel, double pitch_nm) {
    const BlurredKernel blurred = blur_for_lights(kernel, pitch_nm);
    return {{"begin_nm", blurred.begin_nm},         {"end_nm", blurred.end_nm},
            {"narrowest_nm", blurred.narrowest_nm}, {"levels_per_octave", kLevelsPerOctave},
            {"columns", blurred.columns},           {"levels", blurred.levels}};
}

}  // namespace

void add_material(const CookedMaterial& cooked, PortableDocument& document) {
    const Material& material = cooked.material;
    const Grating& grating = material.grating;
    const LayerWeights weights = layer_weights(grating, material.quality.illuminant);
    const std::array<std::size_t, 3> shape{cooked.kernel.antiderivative.size(), 3, 3};
    document.json["material"] = {
        {"pitch_nm", grating.pitch_nm},
        {"orders", grating.orders},
        {"illuminant", material.quality.illuminant.name},
        {"groove_lobe", describe(grating.lobe)},
        {"cover", grating.cover ? nlohmann::json{{"ior", grating.cover->ior}} : nlohmann::json()},
        {"base", {{"color", to_json(glm::dvec3(material.base.colour))}, {"roughness", material.base.roughness}}},
        {"weights", {{"mirror_xyz", to_json(weights.mirror)}, {"base_xyz", to_json(weights.base)}}},
        {"zero_order_xyz", to_json(cooked.zero_order_xyz)},
        {"kernel",
         {{"begin_nm", cooked.kernel.begin_nm},
          {"end_nm", cooked.kernel.end_nm},
          {"even", is_even(cooked.kernel)},
          {"antiderivative", append_array(rows_of(cooked.kernel.antiderivative), shape, document.bytes)}}},
        {"smoothing", smoothing(cooked.kernel, grating.pitch_nm)},
    };
}

void add_arc(const ArcTable& table, PortableDocument& document) {
    const auto rank = static_cast<std::size_t>(table.rank);
    const auto terms = static_cast<std::size_t>(light_term_count(table.terms, table.bands));
    const std::size_t texels = table.grid.texels();
    std::vector<float> weights;
    for (std::size_t texel = 0; texel < texels; ++texel)
        for (std::size_t r = 0; r < rank; ++r) {
            const std::size_t layer = r / kTexelComponents;
            weights.push_back(static_cast<float>(table.value(layer, layer * texels + texel, r % kTexelComponents)));
        }
    const std::array<std::size_t, 3> views{static_cast<std::size_t>(table.grid.rows),
                                           static_cast<std::size_t>(table.grid.columns), rank};
    const std::array<std::size_t, 4> factors{rank, terms, 3, 3};
    nlohmann::json arc = {{"bands", table.bands},
                          {"rank", table.rank},
                          {"views", view_mapping_name(table.grid.mapping)},
                          {"weights", append_array(weights, views, document.bytes)},
                          {"factors", append_array(rows_of(table.factors), factors, document.bytes)}};
    if (table.terms == LightTerms::ArcMoments) {
        const ArcMoments moments(table.bands);
        const std::vector<double>& matrix = moments.matrix();
        const std::array<std::size_t, 2> shape{terms, matrix.size() / terms};
        arc["moments"] = append_array(std::vector<float>(matrix.begin(), matrix.end()), shape, document.bytes);
    }
    document.json["arc"] = std::move(arc);
}

}  // namespace rowland::diffraction
