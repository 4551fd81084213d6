#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "modules/thin_film/model/film_colour.h"

namespace rowland::thin_film {

/// M of a film averaged over microfacets, from M at steps of angle and thickness: cubic in thickness.
class RoughFilm {
 public:
    static constexpr int kAngleSteps = 128;  ///< of √cos

    RoughFilm(const FilmColour& colour, double thinnest_nm, double thickest_nm);

    /// `angles`: lobe_angles() of kAngleSteps. A thickness beyond the ends counts as the end's.
    glm::dmat3 average(std::span<const double> angles, double thickness_nm) const;

 private:
    double thinnest_nm_;
    double step_nm_;
    std::size_t nodes_;
    std::vector<glm::dmat3> values_;  ///< thickness fastest
};

}  // namespace rowland::thin_film
