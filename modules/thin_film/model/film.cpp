#include "modules/thin_film/model/film.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/colour/light_spectra.h"

namespace rowland::thin_film {

namespace {

/// A reflectance of 1 would need an infinite index.
constexpr double kLargestReflectance = 0.9999;

struct IndexAt {
    double wavelength_nm;

    std::complex<double> operator()(const std::complex<double>& index) const { return index; }
    std::complex<double> operator()(colour::Metal metal) const { return colour::metal_index(metal, wavelength_nm); }
    std::complex<double> operator()(const NormalReflectance& reflectance) const {
        const double r0 = glm::dot(colour::rgb_basis(wavelength_nm), reflectance.rgb);
        const double root = std::sqrt(std::clamp(r0, 0.0, kLargestReflectance));
        return (1.0 + root) / (1.0 - root);
    }
};

}  // namespace

std::complex<double> base_index(const Base& base, double wavelength_nm) {
    return std::visit(IndexAt{wavelength_nm}, base);
}

Film with_thickness(Film film, double thickness_nm) {
    film.layers.front().thickness_nm = thickness_nm;
    return film;
}

}  // namespace rowland::thin_film
