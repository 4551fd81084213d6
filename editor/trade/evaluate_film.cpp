#include "editor/trade/evaluate_film.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

#include "engine/core/error.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/prefilter.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/evaluate/drawn_film.h"
#include "modules/thin_film/reference/rough_reference.h"

namespace rowland::trade {

namespace {

/// Smoother lobes lie between the samples of the light: the film is then a mirror.
constexpr double kSmoothest = 0.08;

constexpr std::string_view kReference = "reference";
constexpr std::string_view kTable = "table";  ///< given the light of the lobe without error
constexpr std::string_view kDrawn = "drawn";
constexpr std::string_view kDrawnRough = "drawn/rough-reflections";

}  // namespace

bool is_film(const nlohmann::json& material) {
    return material.is_object() && material.contains("film");
}

std::vector<glm::dvec3> film_radiance(const nlohmann::json& material, const std::string& file,
                                      const std::string& method, const lighting::ProbeImage& probe,
                                      const std::vector<diffraction::ShadingPoint>& points) {
    const bool drawn = method == kDrawn || method == kDrawnRough;
    if (method != kReference && method != kTable && !drawn)
        refuse_input("--method", {}, method.empty() ? "none" : method,
                     fmt::format("{}, {}, {} or {}: the material is a film", kReference, kTable, kDrawn, kDrawnRough),
                     "see rowland-trade evaluate --help");
    const thin_film::FilmMaterial film = thin_film::parse_film_material(material, file);
    const double roughness = film.range.roughest;
    const bool smooth = roughness < kSmoothest;
    const thin_film::RoughReference reference(film.film, colour::LightSpectra(film.illuminant));
    std::optional<thin_film::FilmTable> table;
    if (method != kReference) table = thin_film::bake_film(film);
    lighting::EnvironmentMap environment;
    if (drawn) environment = lighting::prefilter(probe);
    const lighting::LightSamples light = smooth || drawn ? lighting::LightSamples{} : lighting::light_samples(probe);
    std::vector<glm::dvec3> result;
    for (const diffraction::ShadingPoint& point : points) {
        const glm::dvec3 n = glm::normalize(point.normal);
        const glm::dvec3 v = glm::normalize(point.view);
        const double n_v = glm::dot(n, v);
        if (n_v <= 0.0) {
            result.emplace_back(0.0);
            continue;
        }
        if (drawn) {
            const auto reflections =
                method == kDrawn ? thin_film::Reflections::OneLookUp : thin_film::Reflections::FourLookUps;
            result.push_back(
                thin_film::drawn_radiance(*table, film.range.thickest_nm, roughness, environment, n, v, reflections));
            continue;
        }
        const glm::dvec3 mirrored = smooth ? probe.radiance(2.0 * n_v * n - v) : glm::dvec3(0.0);
        thin_film::RoughReference::Reflected reflected{.xyz = reference.at(n_v) * mirrored,
                                                       .without_fresnel = mirrored};
        if (!smooth) reflected = reference.reflected(light, n, v, roughness);
        result.push_back(table ? table->at(n_v, film.range.thickest_nm, roughness) * reflected.without_fresnel
                               : reflected.xyz);
    }
    return result;
}

}  // namespace rowland::trade
