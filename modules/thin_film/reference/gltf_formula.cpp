#include "modules/thin_film/reference/gltf_formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "engine/colour/primaries.h"
#include "modules/thin_film/model/film_colour.h"

namespace rowland::thin_film {

namespace {

using std::numbers::pi;

/// A Gaussian of frequency, 1/m: part of one of x̄, ȳ, z̄. Belcour & Barla 2017, supplemental.
struct Bump {
    int axis;
    double height;
    double centre;
    double variance;
};
constexpr std::array<Bump, 4> kObserver = {{{0, 5.4856e-13, 1.6810e6, 4.3278e9},
                                            {0, 9.7470e-14, 2.2399e6, 4.5282e9},
                                            {1, 4.4201e-13, 1.7953e6, 9.3046e9},
                                            {2, 5.2481e-13, 2.2084e6, 6.6121e9}}};
constexpr double kObserverArea = 1.0685e-7;

/// Colour of fringes cos(2π D/λ + shift), by the Fourier transform of the observer.
glm::dvec3 fringe_colour(double path_nm, const glm::dvec3& shift) {
    const double phase = 2.0 * pi * path_nm * 1e-9;
    glm::dvec3 xyz(0.0);
    for (const Bump& bump : kObserver)
        xyz[bump.axis] += bump.height * std::sqrt(2.0 * pi * bump.variance) *
                          std::cos(bump.centre * phase + shift[bump.axis]) * std::exp(-bump.variance * phase * phase);
    return colour::xyz_to_rec709() * (xyz / kObserverArea);
}

double normal_reflectance(double from, double to) {
    return std::pow((to - from) / (to + from), 2.0);
}

double schlick(double f0, double cosine) {
    return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0);
}

}  // namespace

glm::dvec3 normal_colour(const Base& base) {
    const FilmColour bare({.layers = {{.index = 1.0, .thickness_nm = 0.0}}, .base = base}, colour::LightSpectra{});
    return colour::xyz_to_rec709() * (bare(1.0) * glm::dvec3(1.0));
}

glm::dvec3 gltf_formula(double film_ior, double thickness_nm, const glm::dvec3& base_f0, double cosine) {
    // A film thinner than 0.03 nm fades into air.
    const double n = glm::mix(1.0, film_ior, glm::smoothstep(0.0, 0.03, thickness_nm));
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
    const double outer = schlick(normal_reflectance(1.0, n), cosine);
    const double passing = 1.0 - outer;
    glm::dvec3 inner(0.0);
    glm::dvec3 shift(0.0);
    for (int c = 0; c < 3; ++c) {
        const double root = std::sqrt(std::clamp(base_f0[c], 0.0, 0.9999));
        const double base = (1.0 + root) / (1.0 - root);
        inner[c] = schlick(normal_reflectance(n, base), inside);
        shift[c] = pi + (base < n ? pi : 0.0);
    }
    const glm::dvec3 product = glm::clamp(outer * inner, 1e-5, 0.9999);
    const glm::dvec3 incoherent = passing * passing * inner / (1.0 - product);
    glm::dvec3 sum = outer + incoherent;
    glm::dvec3 amplitude = incoherent - passing;
    for (int order = 1; order <= 2; ++order) {
        amplitude *= glm::sqrt(product);
        sum += 2.0 * amplitude * fringe_colour(order * 2.0 * n * thickness_nm * inside, double(order) * shift);
    }
    return glm::max(sum, 0.0);
}

}  // namespace rowland::thin_film
