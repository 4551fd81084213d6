#include "modules/thin_film/model/film_colour.h"

#include <glm/matrix.hpp>

#include "engine/colour/observer.h"

namespace rowland::thin_film {

FilmColour::FilmColour(const Film& film, const colour::LightSpectra& spectra) : film_(film) {
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; ++nm) {
        const bool at_an_end = nm == colour::kVisibleMin || nm == colour::kVisibleMax;
        const glm::dmat3 observed = glm::outerProduct(colour::cie_xyz(nm), spectra(nm));
        wavelengths_.push_back(
            {static_cast<double>(nm), base_index(film.base, nm), (at_an_end ? 0.5 : 1.0) * observed});
    }
}

FilmColour::AtAngle FilmColour::at(double cosine) const {
    AtAngle result;
    result.parts_.reserve(wavelengths_.size());
    for (const Wavelength& wavelength : wavelengths_)
        result.parts_.push_back(
            {LayersAtAngle(film_.layers, wavelength.base, wavelength.nm, cosine), &wavelength.observed});
    return result;
}

glm::dmat3 FilmColour::AtAngle::operator()(double thickness_nm) const {
    glm::dmat3 sum(0.0);
    for (const Part& part : parts_) sum += part.layers.reflectance(thickness_nm) * *part.observed;
    return sum;
}

}  // namespace rowland::thin_film
