#include "modules/diffraction/portable/portable.h"

#include <array>
#include <bit>
#include <glm/matrix.hpp>

#include "engine/colour/colour_space.h"
#include "engine/core/check.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "modules/diffraction/representations/planar/planar_map.h"

namespace rowland::diffraction {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

namespace {

/// Appends an array to the bytes and returns its JSON. `shape`: lengths, outermost first; their product is the number
/// of values.
nlohmann::json append_array(std::span<const float> values, std::span<const std::size_t> shape,
                            std::vector<std::byte>& bytes) {
    std::size_t count = 1;
    for (const std::size_t length : shape) count *= length;
    ROWLAND_CHECK_OP(count, ==, values.size());
    const std::size_t offset = bytes.size();
    const auto begin = std::as_bytes(values);
    bytes.insert(bytes.end(), begin.begin(), begin.end());
    return {{"offset", offset}, {"shape", std::vector<std::size_t>(shape.begin(), shape.end())}, {"type", "float32"}};
}

/// Row by row.
nlohmann::json to_json(const glm::dmat3& matrix) {
    nlohmann::json rows = nlohmann::json::array();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) rows.push_back(matrix[column][row]);
    return rows;
}

nlohmann::json to_json(const glm::dvec3& vector) {
    return {vector.x, vector.y, vector.z};
}

/// The nine numbers of each matrix, row by row: for arrays whose last two lengths are 3, 3.
std::vector<float> rows_of(std::span<const glm::mat3> matrices) {
    std::vector<float> numbers;
    numbers.reserve(9 * matrices.size());
    for (const glm::mat3& matrix : matrices)
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) numbers.push_back(matrix[column][row]);
    return numbers;
}

nlohmann::json describe(const GrooveLobe& lobe) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe))
        return {{"type", "gaussian"}, {"sigma", gaussian->sigma}};
    if (const auto* pits = std::get_if<PitsLobe>(&lobe))
        return {{"type", "pits"},
                {"length_nm", pits->length_nm},
                {"coherent", pits->coherent},
                {"coherent_sigma", kCoherentSigma},
                {"wavelengths_nm", to_json(kPitsWavelengths_nm)}};
    ROWLAND_CHECK(is_flat(lobe), "documents do not hold a pit sequence");
    return {{"type", "flat"}};
}

/// The dimensions of the texture of the smoothed kernel; its values follow from the kernel.
nlohmann::json smoothing(const KernelTable& kernel, double pitch_nm) {
    const BlurLayout layout = layout_for_lights(kernel, pitch_nm);
    nlohmann::json json = {{"begin_nm", layout.begin_nm},         {"end_nm", layout.end_nm},
                           {"narrowest_nm", layout.narrowest_nm}, {"levels_per_octave", layout.levels_per_octave},
                           {"columns", layout.columns},           {"levels", layout.levels}};
    if (layout.views > 1)
        for (int view = 0; view < layout.views; ++view) json["views"].push_back(2.0 * view / (layout.views - 1) - 1.0);
    return json;
}

nlohmann::json grid_views() {
    nlohmann::json views = nlohmann::json::array();
    for (int view = 0; view < EfficiencyGrid::kViews; ++view) views.push_back(EfficiencyGrid::view_at(view));
    return views;
}

nlohmann::json describe(const KernelTable& kernel, std::vector<std::byte>& bytes) {
    nlohmann::json json = {{"begin_nm", kernel.begin_nm}, {"end_nm", kernel.end_nm}, {"even", is_even(kernel)}};
    std::vector<std::size_t> shape{kernel.entries(), 3, 3};
    if (kernel.views > 1) {
        json["views"] = grid_views();
        shape.insert(shape.begin(), static_cast<std::size_t>(kernel.views));
    }
    json["antiderivative"] = append_array(rows_of(kernel.antiderivative), shape, bytes);
    return json;
}

nlohmann::json describe(const EfficiencyGrid& grid, std::vector<std::byte>& bytes) {
    const std::array<std::size_t, 3> shape{grid.orders.size(), EfficiencyGrid::kWavelengths, EfficiencyGrid::kViews};
    return {{"orders", grid.orders},
            {"begin_nm", EfficiencyGrid::wavelength_at(0)},
            {"step_nm", EfficiencyGrid::kStep_nm},
            {"views", grid_views()},
            {"values", append_array(grid.values, shape, bytes)}};
}

}  // namespace

PortableDocument make_portable(const std::string& uri) {
    return {.json = {{"format", kPortableFormat},
                     {"version", kPortableVersion},
                     {"bytes", {{"uri", uri}}},
                     {"xyz_to_linear_srgb", to_json(glm::inverse(colour::rec709_to_xyz()))}},
            .bytes = {}};
}

void add_material(const CookedMaterial& cooked, PortableDocument& document) {
    const Material& material = cooked.material;
    const Grating& grating = material.grating;
    const LayerWeights weights = layer_weights(grating, material.quality.illuminant);
    document.json["material"] = {
        {"pitch_nm", grating.pitch_nm},
        {"orders", grating.orders},
        {"illuminant", material.quality.illuminant.name},
        {"groove_lobe", describe(grating.lobe)},
        {"cover", grating.cover ? nlohmann::json{{"ior", grating.cover->ior}} : nlohmann::json()},
        {"base", {{"color", to_json(glm::dvec3(material.base.colour))}, {"roughness", material.base.roughness}}},
        {"weights", {{"mirror_xyz", to_json(weights.mirror)}, {"base_xyz", to_json(weights.base)}}},
        {"zero_order_xyz", to_json(cooked.zero_order_xyz)},
        {"kernel", describe(cooked.kernel, document.bytes)},
        {"smoothing", smoothing(cooked.kernel, grating.pitch_nm)},
    };
    if (!depends_on_direction(grating)) return;
    document.json["version"] = kViewDependentVersion;
    document.json["material"]["efficiencies"] = describe(*grating.efficiencies, document.bytes);
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

namespace {

std::vector<float> floats_of(std::span<const glm::dvec3> vectors) {
    std::vector<float> numbers;
    for (const glm::dvec3& vector : vectors)
        for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(vector[i]));
    return numbers;
}

std::vector<float> floats_of(std::span<const glm::vec3> vectors) {
    std::vector<float> numbers;
    for (const glm::vec3& vector : vectors) numbers.insert(numbers.end(), {vector.x, vector.y, vector.z});
    return numbers;
}

}  // namespace

void add_probe(const EvaluationLight& light, int bands, PortableDocument& document) {
    const lighting::ShLight rest = light.harmonics(bands);
    const std::array<std::size_t, 2> shape{rest.coefficients.size(), 3};
    nlohmann::json keys = nlohmann::json::array();
    for (const lighting::KeyLight& key : light.key_lights())
        keys.push_back(
            {{"direction", to_json(key.direction)}, {"flux", to_json(key.flux)}, {"concentration", key.concentration}});
    document.json["probe"] = {{"key_lights", std::move(keys)},
                              {"bands", bands},
                              {"rest_sh", append_array(floats_of(rest.coefficients), shape, document.bytes)}};
}

void add_planar_map(const CookedMaterial& cooked, const EvaluationLight& light, const glm::dvec3& normal,
                    const PlanarMapSize& size, PortableDocument& document) {
    const Grating& grating = cooked.material.grating;
    const PlanarMap map = fill_planar_map(light.texels(), cooked.kernel, grating.pitch_nm, normal, size,
                                          cooked.zero_order_xyz, grating.cover);
    const std::array<std::size_t, 3> shape{static_cast<std::size_t>(map.views), static_cast<std::size_t>(map.azimuths),
                                           3};
    document.json["planar"] = {{"e1", to_json(map.e1)},
                               {"e2", to_json(map.e2)},
                               {"normal", to_json(map.n)},
                               {"xyz", append_array(floats_of(map.xyz), shape, document.bytes)}};
}

}  // namespace rowland::diffraction
