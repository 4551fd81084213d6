#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/thin_film/model/film.h"
#include "modules/thin_film/model/reflectance.h"

namespace rowland::thin_film {

/// M: linear RGB of light → XYZ of what a film reflects of it. PHYSICS (3). Exact for a smooth surface under light that
/// LightSpectra describes.
class FilmColour {
 public:
    /// The film has a layer.
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
