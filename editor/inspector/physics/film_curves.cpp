#include "editor/inspector/physics/film_curves.h"

#include <cmath>
#include <numbers>

#include "engine/colour/observer.h"
#include "engine/colour/working_space.h"
#include "engine/lighting/lobe_angles.h"
#include "modules/diffraction/evaluate/radiance_error.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/bake/rough_film.h"
#include "modules/thin_film/reference/gltf_formula.h"

namespace rowland::inspector {

namespace {

constexpr int kAngles = 86;        ///< 0 to 85 degrees
constexpr int kThicknesses = 161;  ///< every 5 nm

double cosine_of(double angle_deg) {
    return std::cos(angle_deg * std::numbers::pi / 180.0);
}

/// What the exact sum, the formula and the table say of one film.
class FilmModels {
 public:
    explicit FilmModels(const FilmInputs& inputs)
        : inputs_(inputs),
          colour_(inputs.film(), colour::LightSpectra{}),
          base_f0_(thin_film::normal_colour(inputs.film().base)) {
        if (inputs.roughness > 0.0) rough_.emplace(colour_, 0.0, kThickestFilm_nm);
    }

    /// At one angle, for several thicknesses.
    std::vector<glm::dvec3> exact(double cosine, const std::vector<double>& thicknesses_nm) const {
        std::vector<glm::dvec3> result;
        const glm::dvec3 white(1.0);
        if (rough_) {
            const std::vector<double> angles =
                lighting::lobe_angles(cosine, inputs_.roughness, thin_film::RoughFilm::kAngleSteps);
            for (const double nm : thicknesses_nm) result.push_back(rough_->average(angles, nm) * white);
        } else {
            const thin_film::FilmColour::AtAngle at = colour_.at(cosine);
            for (const double nm : thicknesses_nm) result.push_back(at(nm) * white);
        }
        return result;
    }
    glm::dvec3 formula(double cosine, double thickness_nm) const {
        return colour::rec709_to_xyz() * thin_film::gltf_formula(inputs_.ior, thickness_nm, base_f0_, cosine);
    }
    thin_film::FilmTable table() const {
        const thin_film::TableRange range{.thinnest_nm = 0.0,
                                          .thickest_nm = kThickestFilm_nm,
                                          .smoothest = inputs_.roughness,
                                          .roughest = inputs_.roughness};
        return thin_film::bake_table(colour_, range, thin_film::table_size(range));
    }

 private:
    FilmInputs inputs_;
    thin_film::FilmColour colour_;
    glm::dvec3 base_f0_;
    std::optional<thin_film::RoughFilm> rough_;
};

FilmCurves without_table(const FilmInputs& inputs, const FilmModels& models) {
    FilmCurves curves;
    const thin_film::Film film = inputs.film();
    const thin_film::Film bare{.layers = {}, .base = film.base};
    const double cosine = cosine_of(inputs.angle_deg);
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; ++nm) {
        curves.spectrum.emplace_back(nm, thin_film::reflectance(film, nm, cosine));
        curves.bare.emplace_back(nm, thin_film::reflectance(bare, nm, cosine));
    }
    for (int i = 0; i < kAngles; ++i) {
        const double at = cosine_of(i);
        curves.angles_deg.push_back(i);
        curves.over_angle.exact.push_back(models.exact(at, {inputs.thickness_nm}).front());
        curves.over_angle.formula.push_back(models.formula(at, inputs.thickness_nm));
    }
    for (int i = 0; i < kThicknesses; ++i) {
        curves.thicknesses_nm.push_back(kThickestFilm_nm * i / (kThicknesses - 1));
        curves.over_thickness.formula.push_back(models.formula(cosine, curves.thicknesses_nm.back()));
    }
    curves.over_thickness.exact = models.exact(cosine, curves.thicknesses_nm);
    curves.formula_error = diffraction::relative_rms(curves.over_thickness.formula, curves.over_thickness.exact);
    return curves;
}

}  // namespace

thin_film::Film FilmInputs::film() const {
    const thin_film::Base base = metal ? thin_film::Base(*metal) : thin_film::Base(std::complex(base_ior, base_k));
    return {.layers = {{.index = ior, .thickness_nm = thickness_nm}}, .base = base};
}

std::optional<FilmCurves> film_curves(const FilmInputs& inputs, const std::stop_token& stop,
                                      const std::function<void(FilmCurves)>& publish) {
    const FilmModels models(inputs);
    FilmCurves curves = without_table(inputs, models);
    publish(curves);
    if (stop.stop_requested()) return std::nullopt;
    const thin_film::FilmTable table = models.table();
    const glm::dvec3 white(1.0);
    for (const double angle_deg : curves.angles_deg)
        curves.over_angle.table.push_back(table.at(cosine_of(angle_deg), inputs.thickness_nm, inputs.roughness) *
                                          white);
    for (const double nm : curves.thicknesses_nm)
        curves.over_thickness.table.push_back(table.at(cosine_of(inputs.angle_deg), nm, inputs.roughness) * white);
    curves.table_error = diffraction::relative_rms(curves.over_thickness.table, curves.over_thickness.exact);
    curves.complete = true;
    return curves;
}

}  // namespace rowland::inspector
