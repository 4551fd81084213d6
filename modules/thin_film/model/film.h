#pragma once

#include <complex>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <variant>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"

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

/// Layers on a base under light of one wavelength and angle, for any thickness of the outermost layer.
class LayersAtAngle {
 public:
    /// `cosine` ∈ [0, 1]: of the angle of incidence in air. At least one layer.
    LayersAtAngle(std::span<const Layer> layers, std::complex<double> base, double wavelength_nm, double cosine);

    /// Fraction of unpolarised light that is reflected, in [0, 1]. PHYSICS (2.1), (2.2).
    double reflectance(double outermost_thickness_nm) const;

 private:
    struct Amplitudes {
        std::complex<double> first;  ///< reflected by the outermost face
        std::complex<double> below;  ///< reflected by all below the outermost layer
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

/// M: linear Rec.709 of light → XYZ of what a film reflects of it. PHYSICS (4.1). Exact for a smooth surface under
/// light that LightSpectra describes.
class FilmColour {
 public:
    /// The film must have at least one layer.
    FilmColour(const Film& film, const colour::LightSpectra& spectra);

    /// M at one angle, for any thickness of the outermost layer.
    class AtAngle {
     public:
        glm::dmat3 operator()(double thickness_nm) const;

     private:
        friend class FilmColour;
        struct Part {
            LayersAtAngle layers;
            const glm::dmat3* observed;  ///< cmf(λ) E(λ)ᵀ dλ
        };
        std::vector<Part> parts_;  ///< one for each wavelength
    };

    /// `cosine` ∈ [0, 1]: of the angle of incidence. The result refers to this object.
    AtAngle at(double cosine) const;
    /// M for the film's own thickness.
    glm::dmat3 operator()(double cosine) const { return at(cosine)(film_.layers.front().thickness_nm); }

    const Film& film() const { return film_; }

 private:
    struct Wavelength {
        double nm;
        std::complex<double> base;
        glm::dmat3 observed;
    };
    Film film_;
    std::vector<Wavelength> wavelengths_;
};

}  // namespace rowland::thin_film
