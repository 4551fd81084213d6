#include "editor/trade/film_methods.h"

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "engine/colour/colour_space.h"
#include "engine/colour/illuminant.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/light_samples.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/evaluate/drawn_film.h"
#include "modules/thin_film/model/film.h"
#include "modules/thin_film/reference/film_reference.h"

namespace rowland::trade {

namespace {

using std::numbers::pi;

constexpr double kThickness_nm = 400.0;
constexpr int kViews = 24;
constexpr int kBands = 3;
constexpr int kCoefficients = kBands * kBands;
constexpr int kDirections = 40000;  ///< of band-limited light: 1 degree apart, finer than the lobes
constexpr int kGatheredFace = 256;  ///< cells of the probe: a quarter of the width of the narrowest lobe

/// Points on the sphere, evenly spread [Fibonacci].
glm::dvec3 spread(int i, int count) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double turn = i * pi * (3.0 - std::sqrt(5.0));
    return {std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z};
}

struct View {
    glm::dvec3 normal;
    glm::dvec3 view;
    double cosine;
};

/// Normals everywhere, seen at 0 to 70 degrees.
std::vector<View> views() {
    std::vector<View> result;
    for (int i = 0; i < kViews; ++i) {
        const glm::dvec3 n = spread(i, kViews);
        const glm::dvec3 aside = glm::normalize(glm::cross(n, spread((i + 7) % kViews, kViews)));
        const double angle = 70.0 * (i * 7 % kViews + 0.5) / kViews * pi / 180.0;
        result.push_back({n, std::cos(angle) * n + std::sin(angle) * aside, std::cos(angle)});
    }
    return result;
}

/// The light that `kBands` bands of spherical harmonics hold. Its flux may be negative.
lighting::LightSamples band_limited(const lighting::LightSamples& light) {
    std::array<glm::dvec3, kCoefficients> coefficients{};
    std::array<double, kCoefficients> basis{};
    for (std::size_t i = 0; i < light.size(); ++i) {
        math::evaluate_sh(light.direction(i), kBands, basis);
        for (std::size_t k = 0; k < basis.size(); ++k) coefficients.at(k) += basis.at(k) * light.flux(i);
    }
    lighting::LightSamples result;
    for (int i = 0; i < kDirections; ++i) {
        const glm::dvec3 direction = spread(i, kDirections);
        math::evaluate_sh(direction, kBands, basis);
        glm::dvec3 radiance(0.0);
        for (std::size_t k = 0; k < basis.size(); ++k) radiance += basis.at(k) * coefficients.at(k);
        result.push_back(direction, radiance * (4.0 * pi / kDirections));
    }
    return result;
}

/// XYZ that one method gives for each view.
struct MethodValues {
    FilmRow row;  ///< its name and cost
    std::vector<glm::dvec3> xyz{};
};

std::vector<MethodValues> methods(const thin_film::FilmTable& table) {
    // Spherical harmonics [Lindsay & Agu 2005]: nine matrices per view, one for each coefficient of the light, stored
    // as half floats for as many angles as the table has. A fetch reads four numbers.
    constexpr int kNumbers = 9 * kCoefficients;
    constexpr int kRotation = 3 * (9 + 25);  // of the light into the surface's axes, bands 1 and 2
    const std::size_t sh_bytes = static_cast<std::size_t>(table.columns) * kNumbers * 2;
    return {{{.method = "table", .table_bytes = table.bytes(), .fetches = 3, .multiply_adds = 9, .functions = 1}},
            {{.method = "drawn", .table_bytes = table.bytes(), .fetches = 3, .multiply_adds = 9, .functions = 1}},
            // Fetches: four times those of "drawn", four of the lobe's nodes, and three more of the environment.
            {{.method = "drawn, rough reflections",
              .table_bytes = table.bytes(),
              .fetches = 19,
              .multiply_adds = 80,
              .functions = 7}},
            {{.method = "spherical harmonics, 3 bands",
              .table_bytes = sh_bytes,
              .fetches = (kNumbers + 3) / 4,
              .multiply_adds = kNumbers + kRotation,
              .functions = 1}},
            {{.method = "glTF's formula", .multiply_adds = 110, .functions = 20}},
            {{.method = "three wavelengths", .multiply_adds = 220, .functions = 10}}};
}

struct Light {
    lighting::LightSamples whole;
    lighting::LightSamples limited;
    lighting::EnvironmentMap environment;
};

void add_rows(const FilmSubject& subject, double roughness, const Light& light, std::vector<FilmRow>& rows) {
    const thin_film::Film film = subject.film(kThickness_nm);
    const thin_film::TableRange range{kThickness_nm, kThickness_nm, roughness, roughness};
    const colour::LightSpectra spectra;
    const thin_film::FilmTable table =
        thin_film::bake_table(thin_film::FilmColour(film, spectra), range, thin_film::table_size(range));
    const thin_film::RoughReference reference(film, spectra);
    const glm::dvec3 base_f0 = thin_film::normal_colour(subject.base);
    std::vector<glm::dvec3> exact;
    std::vector<MethodValues> all = methods(table);
    for (const View& at : views()) {
        const auto reflected = reference.reflected(light.whole, at.normal, at.view, roughness);
        const glm::dvec3 lobe = reflected.without_fresnel;
        exact.push_back(reflected.xyz);
        all[0].xyz.push_back(table.at(at.cosine, kThickness_nm, roughness) * lobe);
        const auto drawn = [&](thin_film::Reflections reflections) {
            return thin_film::drawn_radiance(table, kThickness_nm, roughness, light.environment, at.normal, at.view,
                                             reflections);
        };
        all[1].xyz.push_back(drawn(thin_film::Reflections::OneLookUp));
        all[2].xyz.push_back(drawn(thin_film::Reflections::FourLookUps));
        all[3].xyz.push_back(reference.reflected(light.limited, at.normal, at.view, roughness).xyz);
        all[4].xyz.push_back(colour::rec709_to_xyz() *
                             (thin_film::gltf_formula(subject.film_ior, kThickness_nm, base_f0, at.cosine) * lobe));
        all[5].xyz.push_back(colour::rec709_to_xyz() * (three_wavelengths(film, at.cosine) * lobe));
    }
    for (MethodValues& values : all) {
        values.row.film = subject.name;
        values.row.roughness = roughness;
        values.row.relative_rms = diffraction::relative_rms(values.xyz, exact);
        rows.push_back(std::move(values.row));
    }
}

}  // namespace

const std::array<FilmSubject, 6>& film_subjects() {
    static const std::array<FilmSubject, 6> all = {
        {{"soap (1.33 on air)", 1.33, std::complex<double>(1.0)},
         {"coating (1.38 on glass 1.5)", 1.38, std::complex<double>(1.5)},
         {"oil (1.47 on water 1.33)", 1.47, std::complex<double>(1.33)},
         {"oxide (1.77 on Al)", 1.77, colour::Metal::Al},
         {"glass (1.5 on Cu)", 1.5, colour::Metal::Cu},
         {"oxide (2.4 on titanium, 2.5 + 3.3i)", 2.4, std::complex<double>(2.5, 3.3)}}};
    return all;
}

glm::dvec3 three_wavelengths(const thin_film::Film& film, double cosine) {
    return {thin_film::reflectance(film, 650.0, cosine), thin_film::reflectance(film, 550.0, cosine),
            thin_film::reflectance(film, 450.0, cosine)};
}

std::vector<FilmRow> film_rows(const lighting::ProbeImage& probe) {
    Light light{.whole = lighting::merge_samples(lighting::light_samples(probe), kGatheredFace),
                .limited = {},
                .environment = lighting::prefilter(probe)};
    light.limited = band_limited(light.whole);
    std::vector<FilmRow> rows;
    for (const FilmSubject& subject : film_subjects())
        for (const double roughness : {0.2, 0.5}) add_rows(subject, roughness, light, rows);
    return rows;
}

}  // namespace rowland::trade
