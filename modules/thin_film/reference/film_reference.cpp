#include "modules/thin_film/reference/film_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/colour/colour_space.h"
#include "engine/core/parallel.h"
#include "modules/thin_film/model/film.h"

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

namespace {

constexpr std::size_t kSteps = 1000;

/// D G n·l / (4 n·l n·v).
double lobe(double n_v, double n_l, double n_h, double a2) {
    const double peak = n_h * n_h * (a2 - 1.0) + 1.0;
    const double d = a2 / (std::numbers::pi * peak * peak);
    const double smith = n_v * std::sqrt(n_l * n_l * (1.0 - a2) + a2) + n_l * std::sqrt(n_v * n_v * (1.0 - a2) + a2);
    return d * n_l / (2.0 * smith);
}

}  // namespace

RoughReference::RoughReference(const Film& film, const colour::LightSpectra& spectra) : values_(kSteps + 1) {
    const FilmColour colour(film, spectra);
    parallel_for(values_.size(), [&](std::size_t i) { values_[i] = colour(static_cast<double>(i) / kSteps); });
}

glm::dmat3 RoughReference::at(double cosine) const {
    const double position = std::clamp(cosine, 0.0, 1.0) * kSteps;
    const std::size_t i = std::min(static_cast<std::size_t>(position), kSteps - 1);
    const double t = position - static_cast<double>(i);
    return (1.0 - t) * values_[i] + t * values_[i + 1];
}

RoughReference::Reflected RoughReference::reflected(const lighting::LightSamples& light, const glm::dvec3& n,
                                                    const glm::dvec3& v, double roughness) const {
    const double a2 = std::pow(roughness, 4.0);
    const double n_v = glm::dot(n, v);
    Reflected sum;
    if (n_v <= 0.0) return sum;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 l = light.direction(i);
        const double n_l = glm::dot(n, l);
        if (n_l <= 0.0) continue;
        const glm::dvec3 h = glm::normalize(l + v);
        const glm::dvec3 part = lobe(n_v, n_l, glm::dot(n, h), a2) * light.flux(i);
        sum.without_fresnel += part;
        sum.xyz += at(glm::dot(v, h)) * part;
    }
    return sum;
}

}  // namespace rowland::thin_film
