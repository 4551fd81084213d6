#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/colour/metal.h"
#include "modules/thin_film/model/film.h"

namespace rowland::inspector {

/// A film, and how it is seen.
struct FilmInputs {
    double ior = 1.33;
    double thickness_nm = 400.0;  ///< 0 to kThickestFilm_nm
    std::optional<colour::Metal> metal = {};
    double base_ior = 1.0;  ///< of a base that is no metal of the list
    double base_k = 0.0;
    double roughness = 0.0;  ///< perceptual
    double angle_deg = 0.0;  ///< of the view

    thin_film::Film film() const;

    friend bool operator==(const FilmInputs&, const FilmInputs&) = default;
};

/// XYZ of white light that is reflected: by the exact sum, averaged over the lobe of a rough surface; by the table that
/// is drawn; by the formula that glTF recommends.
struct FilmColours {
    std::vector<glm::dvec3> exact;
    std::vector<glm::dvec3> table;
    std::vector<glm::dvec3> formula;
};

struct FilmCurves {
    std::vector<glm::dvec2> spectrum;  ///< nm, fraction reflected by the smooth film at the angle
    std::vector<glm::dvec2> bare;      ///< likewise without the film
    std::vector<double> angles_deg;
    FilmColours over_angle;
    std::vector<double> thicknesses_nm;
    FilmColours over_thickness;  ///< at the angle
    bool complete = false;       ///< the table is baked; its colours are empty before
    double table_error = 0.0;    ///< over_thickness against the exact sum, relative RMS
    double formula_error = 0.0;
};

inline constexpr double kThickestFilm_nm = 800.0;

/// Takes a second or two: `publish` is given the curves without the table first. nullopt if it was stopped.
std::optional<FilmCurves> film_curves(const FilmInputs& inputs, const std::stop_token& stop,
                                      const std::function<void(FilmCurves)>& publish);

}  // namespace rowland::inspector
