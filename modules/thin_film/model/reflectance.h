#pragma once

#include <complex>
#include <span>

#include "modules/thin_film/model/film.h"

namespace rowland::thin_film {

/// Layers on a base under light of one wavelength and angle, for any thickness of the outermost layer.
class LayersAtAngle {
 public:
    /// `cosine` ∈ [0, 1]: of the angle of incidence in air. There is a layer.
    LayersAtAngle(std::span<const Layer> layers, std::complex<double> base, double wavelength_nm, double cosine);

    /// Fraction of unpolarised light that is reflected, in [0, 1]. PHYSICS (1), (2).
    double reflectance(double outermost_thickness_nm) const;

 private:
    struct Amplitudes {
        std::complex<double> first;  ///< of the outermost face
        std::complex<double> below;  ///< of all below the outermost layer
    };
    Amplitudes s_;
    Amplitudes p_;
    std::complex<double> phase_per_nm_;  ///< iβ of the outermost layer over its thickness
};

/// Fraction of unpolarised light of one wavelength that a film reflects, in [0, 1]: Airy's sum for both polarisations.
/// Without layers: the base's. `cosine` ∈ [0, 1]: of the angle of incidence in air.
double reflectance(std::span<const Layer> layers, std::complex<double> base, double wavelength_nm, double cosine);

/// The same of a film, whose base depends on the wavelength.
double reflectance(const Film& film, double wavelength_nm, double cosine);

}  // namespace rowland::thin_film
