// Rough films under captured light: the table's mean over a lobe times the light that the lobe reflects, as the shader
// has it, against the sum over every microfacet, each with its own light and the exact sum over wavelengths.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/reference/rough_reference.h"
#include "tests/support/facings.h"
#include "tests/support/test_data.h"

namespace rowland::thin_film {
namespace {

using rowland::test::Facing;
using rowland::test::random_facings;

FilmTable table_of(const Film& film, const TableRange& range) {
    return bake_table(FilmColour(film, colour::LightSpectra{}), range, table_size(range));
}

/// Relative RMS error over the facings.
double error_under(const lighting::LightSamples& light, const Film& film, double roughness, int facings) {
    const double thickness_nm = film.layers.front().thickness_nm;
    const TableRange range{thickness_nm, thickness_nm, roughness, roughness};
    const FilmTable table = table_of(film, range);
    const RoughReference reference(film, colour::LightSpectra{});
    double off = 0.0;
    double whole = 0.0;
    for (const Facing& facing : random_facings(facings)) {
        const RoughReference::Reflected reflected = reference.reflected(light, facing.n, facing.v, roughness);
        const glm::dvec3 found =
            table.at(glm::dot(facing.n, facing.v), thickness_nm, roughness) * reflected.without_fresnel;
        off += glm::dot(found - reflected.xyz, found - reflected.xyz);
        whole += glm::dot(reflected.xyz, reflected.xyz);
    }
    return std::sqrt(off / whole);
}

const Film kSoapOnGlass{.layers = {{1.33, 400.0}}, .base = std::complex<double>(1.5)};
const Film kAnodised{.layers = {{2.4, 110.0}}, .base = std::complex<double>(2.5, 3.3)};

lighting::LightSamples captured(const std::filesystem::path& path) {
    return lighting::gather_texels(lighting::light_samples(lighting::load_probe_image(path, lighting::Mapping::Auto)),
                                   64);
}

TEST(RoughFilm, UnderACapturedProbeIsNearTheSumOverMicrofacets) {
    ROWLAND_TEST_DATA(path, "probes/ennis_probulator.hdr");
    EXPECT_LE(error_under(captured(path), kAnodised, 0.3, 8), 0.03);
}

TEST(RoughFilm, UnderFourCapturedProbesIsNearTheSumOverMicrofacets) {
    for (const char* name :
         {"grace_probe.hdr", "ennis_probulator.hdr", "royal_esplanade_1k.hdr", "blender_sunset.exr"}) {
        ROWLAND_TEST_DATA(path, std::string("probes/") + name);
        const lighting::LightSamples light = captured(path);
        for (const double roughness : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}) {
            const double anodised = error_under(light, kAnodised, roughness, 24);
            const double bare = error_under(light, with_thickness(kSoapOnGlass, 0.0), roughness, 24);
            const double soap = error_under(light, kSoapOnGlass, roughness, 24);
            // Measured: 0.05 under Ennis at 0.6, at most 0.03 under the others.
            EXPECT_LE(anodised, 0.055) << name << " " << roughness;
            // On glass the split sum itself is off, film or not: lamps at grazing incidence.
            EXPECT_LE(soap, 2.0 * bare) << name << " " << roughness << " bare " << bare;
        }
    }
}

/// The sum over microfacets under light of one colour from all sides gives a column of the exact mean over the lobe.
glm::dmat3 exact_mean(const RoughReference& reference, double cosine, double roughness) {
    constexpr int kDirections = 100000;  // 0.6 degrees apart: a lobe of roughness 0.2 has a hundred
    const glm::dvec3 n(0.0, 0.0, 1.0);
    const glm::dvec3 v(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
    glm::dmat3 mean(0.0);
    for (int colour = 0; colour < 3; ++colour) {
        glm::dvec3 flux(0.0);
        flux[colour] = 1.0;
        lighting::LightSamples light;
        for (int i = 0; i < kDirections; ++i) {  // Fibonacci's
            const double z = (i + 0.5) / kDirections;
            const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
            const double side = std::sqrt(1.0 - z * z);
            light.push_back({side * std::cos(turn), side * std::sin(turn), z}, flux);
        }
        const RoughReference::Reflected reflected = reference.reflected(light, n, v, roughness);
        mean[colour] = reflected.xyz / reflected.without_fresnel[colour];
    }
    return mean;
}

/// What the film adds to the split sum's own error: as drawn, against the same split sum with the exact mean. Relative
/// RMS.
double own_error_under(const lighting::LightSamples& light, const Film& film, const FilmTable& table,
                       double roughness) {
    const RoughReference reference(film, colour::LightSpectra{});
    const double thickness_nm = film.layers.front().thickness_nm;
    double off = 0.0;
    double whole = 0.0;
    for (const Facing& facing : random_facings(8)) {
        const double cosine = glm::dot(facing.n, facing.v);
        const glm::dvec3 lobe = reference.reflected(light, facing.n, facing.v, roughness).without_fresnel;
        const glm::dvec3 exact = exact_mean(reference, cosine, roughness) * lobe;
        const glm::dvec3 difference = table.at(cosine, thickness_nm, roughness) * lobe - exact;
        off += glm::dot(difference, difference);
        whole += glm::dot(exact, exact);
    }
    return std::sqrt(off / whole);
}

TEST(RoughFilm, UnderFourCapturedProbesAddsLittleToTheErrorOfTheSplitSum) {
    for (const Film& film : {kAnodised, kSoapOnGlass}) {
        const FilmTable of_all = table_of(film, {100.0, 400.0, 0.0, 0.6});
        for (const char* name :
             {"grace_probe.hdr", "ennis_probulator.hdr", "royal_esplanade_1k.hdr", "blender_sunset.exr"}) {
            ROWLAND_TEST_DATA(path, std::string("probes/") + name);
            const lighting::LightSamples light = captured(path);
            for (const double roughness : {0.2, 0.4, 0.6}) {
                const double thickness_nm = film.layers.front().thickness_nm;
                const FilmTable of_one = table_of(film, {thickness_nm, thickness_nm, roughness, roughness});
                const double one = own_error_under(light, film, of_one, roughness);
                const double all = own_error_under(light, film, of_all, roughness);
                EXPECT_LE(one, 0.01) << name << " " << roughness;
                EXPECT_LE(all, 0.01) << name << " " << roughness;
            }
        }
    }
}

}  // namespace
}  // namespace rowland::thin_film
