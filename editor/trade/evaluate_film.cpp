#include "editor/trade/evaluate_film.h"

#include <fmt/format.h>

#include <functional>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>
#include <utility>

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

/// XYZ toward v of a surface of normal n; both unit, n·v > 0.
using Radiance = std::function<glm::dvec3(const glm::dvec3& n, const glm::dvec3& v)>;

Radiance as_drawn(const thin_film::FilmMaterial& film, const lighting::ProbeImage& probe,
                  thin_film::Reflections reflections) {
    return [film, reflections, table = thin_film::bake_film(film), environment = lighting::prefilter(probe)](
               const glm::dvec3& n, const glm::dvec3& v) {
        return thin_film::drawn_radiance(table, film.range.thickest_nm, film.range.roughest, environment, n, v,
                                         reflections);
    };
}

/// The sum over microfacets, each with its own light; or, with a table, its M̄ times the light of the lobe.
Radiance as_summed(const thin_film::FilmMaterial& film, const lighting::ProbeImage& probe,
                   std::optional<thin_film::FilmTable> table) {
    const bool smooth = film.range.roughest < kSmoothest;
    return [film, smooth, &probe, table = std::move(table),
            reference = thin_film::RoughReference(film.film, colour::LightSpectra(film.illuminant)),
            light = smooth ? lighting::LightSamples{} : lighting::light_samples(probe)](const glm::dvec3& n,
                                                                                        const glm::dvec3& v) {
        const double n_v = glm::dot(n, v);
        thin_film::RoughReference::Reflected reflected;
        if (smooth) {
            reflected.without_fresnel = probe.radiance(2.0 * n_v * n - v);
            reflected.xyz = reference.at(n_v) * reflected.without_fresnel;
        } else {
            reflected = reference.reflected(light, n, v, film.range.roughest);
        }
        return table ? table->at(n_v, film.range.thickest_nm, film.range.roughest) * reflected.without_fresnel
                     : reflected.xyz;
    };
}

Radiance radiance_by(std::string_view method, const thin_film::FilmMaterial& film, const lighting::ProbeImage& probe) {
    if (method == kReference) return as_summed(film, probe, {});
    if (method == kTable) return as_summed(film, probe, thin_film::bake_film(film));
    return as_drawn(film, probe,
                    method == kDrawn ? thin_film::Reflections::OneLookUp : thin_film::Reflections::FourLookUps);
}

}  // namespace

bool is_film(const nlohmann::json& material) {
    return material.is_object() && material.contains("film");
}

std::vector<glm::dvec3> film_radiance(const nlohmann::json& material, const std::string& file,
                                      const std::string& method, const lighting::ProbeImage& probe,
                                      const std::vector<diffraction::ShadingPoint>& points) {
    if (method != kReference && method != kTable && method != kDrawn && method != kDrawnRough)
        refuse_input("--method", {}, method.empty() ? "none" : method,
                     fmt::format("{}, {}, {} or {}: the material is a film", kReference, kTable, kDrawn, kDrawnRough),
                     "see rowland-trade evaluate --help");
    const thin_film::FilmMaterial film = thin_film::parse_film_material(material, file);
    const Radiance radiance = radiance_by(method, film, probe);
    std::vector<glm::dvec3> result;
    for (const diffraction::ShadingPoint& point : points) {
        const glm::dvec3 n = glm::normalize(point.normal);
        const glm::dvec3 v = glm::normalize(point.view);
        result.push_back(glm::dot(n, v) > 0.0 ? radiance(n, v) : glm::dvec3(0.0));
    }
    return result;
}

}  // namespace rowland::trade
