#include "modules/thin_film/model/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "engine/core/check.h"

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

namespace {

using Complex = std::complex<double>;

/// Nearer to grazing incidence the quotients of PHYSICS (2.1) are 0/0 to rounding.
constexpr double kLeastCosine = 1e-9;

/// A medium, and the wave vector's component across the faces over the wavenumber in vacuum: q = n cos θ.
struct Medium {
    Complex index;
    Complex q;
};

/// q² = n² − sin²θ, without cancellation. The root is in the first quadrant, so that waves into the base decay.
Medium medium(Complex index, double cosine) {
    return {index, std::sqrt((index - 1.0) * (index + 1.0) + cosine * cosine)};
}

enum class Polarisation { S, P };

/// Amplitude that the face between two media reflects. PHYSICS (2.1).
Complex face(const Medium& above, const Medium& below, Polarisation polarisation) {
    const bool s = polarisation == Polarisation::S;
    const Complex a = s ? above.q : below.index * below.index * above.q;
    const Complex b = s ? below.q : above.index * above.index * below.q;
    return (a - b) / (a + b);
}

/// PHYSICS (2.2). `delayed`: what the layer's lower face reflects, with the phase of the way there and back.
Complex airy(Complex first, Complex delayed) {
    return (first + delayed) / (1.0 + first * delayed);
}

Complex phase_per_nm(const Medium& layer, double wavelength_nm) {
    return Complex(0.0, 4.0 * std::numbers::pi / wavelength_nm) * layer.q;
}

/// Amplitude that all layers and the base reflect of light that arrives in `above`.
Complex stack(Medium above, std::span<const Layer> layers, Complex base, double wavelength_nm, double cosine,
              Polarisation polarisation) {
    if (layers.empty()) return face(above, medium(base, cosine), polarisation);
    const Medium layer = medium(layers.front().index, cosine);
    const Complex below = stack(layer, layers.subspan(1), base, wavelength_nm, cosine, polarisation);
    const Complex phase = std::exp(phase_per_nm(layer, wavelength_nm) * layers.front().thickness_nm);
    return airy(face(above, layer, polarisation), below * phase);
}

double mean_intensity(Complex s, Complex p) {
    return std::min(0.5 * (std::norm(s) + std::norm(p)), 1.0);
}

}  // namespace

LayersAtAngle::LayersAtAngle(std::span<const Layer> layers, std::complex<double> base, double wavelength_nm,
                             double cosine) {
    ROWLAND_CHECK(!layers.empty(), "a film has a layer");
    const double c = std::max(cosine, kLeastCosine);
    const Medium outermost = medium(layers.front().index, c);
    const auto amplitudes = [&](Polarisation polarisation) {
        return Amplitudes{face({1.0, c}, outermost, polarisation),
                          stack(outermost, layers.subspan(1), base, wavelength_nm, c, polarisation)};
    };
    s_ = amplitudes(Polarisation::S);
    p_ = amplitudes(Polarisation::P);
    phase_per_nm_ = phase_per_nm(outermost, wavelength_nm);
}

double LayersAtAngle::reflectance(double outermost_thickness_nm) const {
    const Complex phase = std::exp(phase_per_nm_ * outermost_thickness_nm);
    return mean_intensity(airy(s_.first, s_.below * phase), airy(p_.first, p_.below * phase));
}

double reflectance(std::span<const Layer> layers, std::complex<double> base, double wavelength_nm, double cosine) {
    const double c = std::max(cosine, kLeastCosine);
    const auto amplitude = [&](Polarisation polarisation) {
        return stack({1.0, c}, layers, base, wavelength_nm, c, polarisation);
    };
    return mean_intensity(amplitude(Polarisation::S), amplitude(Polarisation::P));
}

double reflectance(const Film& film, double wavelength_nm, double cosine) {
    return reflectance(film.layers, base_index(film.base, wavelength_nm), wavelength_nm, cosine);
}

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
