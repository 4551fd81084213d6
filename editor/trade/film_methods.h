#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "modules/thin_film/model/film.h"

namespace rowland::trade {

/// A transparent film on a base, for comparisons of methods.
struct FilmSubject {
    const char* name;
    double film_ior;
    thin_film::Base base;

    thin_film::Film film(double thickness_nm) const {
        return {.layers = {{.index = film_ior, .thickness_nm = thickness_nm}}, .base = base};
    }
};
const std::array<FilmSubject, 6>& film_subjects();

/// Linear Rec.709 by Airy's sum at 650, 550 and 450 nm.
glm::dvec3 three_wavelengths(const thin_film::Film& film, double cosine);

/// A method's error on a rough film under a probe, and its cost by a count of the operations in its formulas.
struct FilmRow {
    std::string film{};
    double roughness = 0.0;
    std::string method{};
    double relative_rms = 0.0;  ///< of XYZ over views up to 70 degrees, against the sum over all microfacets
    std::size_t table_bytes = 0;
    int fetches = 0;        ///< per pixel, of the film alone
    int multiply_adds = 0;  ///< accurate to about ten
    int functions = 0;      ///< sines, cosines, exponentials and roots
};

/// Rows for every subject at 400 nm, two roughnesses and six methods. The methods "drawn" use the engine's prefiltered
/// environment; all others but spherical harmonics are given the light of the lobe without error.
std::vector<FilmRow> film_rows(const lighting::ProbeImage& probe);

}  // namespace rowland::trade
