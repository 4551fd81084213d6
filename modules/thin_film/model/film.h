#pragma once

#include <complex>
#include <glm/vec3.hpp>
#include <variant>
#include <vector>

#include "engine/colour/metal.h"

namespace rowland::thin_film {

/// A layer between parallel faces. Its index does not depend on the wavelength; an imaginary part ≥ 0 absorbs.
struct Layer {
    std::complex<double> index{1.33, 0.0};
    double thickness_nm = 400.0;

    friend bool operator==(const Layer&, const Layer&) = default;
};

/// A base that is known by its reflectance in air at normal incidence only: linear Rec.709, each in [0, 1].
struct NormalReflectance {
    glm::dvec3 rgb{0.04};

    friend bool operator==(const NormalReflectance&, const NormalReflectance&) = default;
};

/// What lies under the film: a constant index n + ik, a metal, or a reflectance, taken as that of a dielectric.
using Base = std::variant<std::complex<double>, colour::Metal, NormalReflectance>;

/// Layers on a base, in air. The first layer is the outermost.
struct Film {
    std::vector<Layer> layers{Layer{}};
    Base base = std::complex<double>(1.5, 0.0);

    friend bool operator==(const Film&, const Film&) = default;
};

/// Index of the base at a wavelength. PHYSICS §3.
std::complex<double> base_index(const Base& base, double wavelength_nm);

/// The same film with an outermost layer of another thickness. It has a layer.
Film with_thickness(Film film, double thickness_nm);

}  // namespace rowland::thin_film
