#include "modules/thin_film/model/film_colour.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/colour/working_space.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::thin_film {
namespace {

Base base_of(const std::string& name) {
    if (name == "air") return std::complex<double>(1.0);
    if (name == "glass_1.5") return std::complex<double>(1.5);
    return colour::parse_metal(name).value();
}

TEST(FilmColour, OfWhiteLightMatchesTheOracle) {
    ROWLAND_TEST_DATA(path, "oracle/thin_film_reflectance.csv");
    const test::Csv oracle = test::read_csv(path);
    ASSERT_GT(oracle.rows.size(), 600U);
    for (std::size_t row = 0; row < oracle.rows.size(); ++row) {
        const Film film{
            .layers = {{.index = oracle.number(row, "film_ior"), .thickness_nm = oracle.number(row, "thickness_nm")}},
            .base = base_of(oracle.text(row, "base"))};
        const FilmColour colour(film, colour::LightSpectra{});
        const glm::dvec3 xyz = colour(oracle.number(row, "cosine")) * glm::dvec3(1.0);
        const char* const axes[] = {"X", "Y", "Z"};
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(xyz[c], oracle.number(row, axes[c]), 1e-6) << row;
    }
}

TEST(FilmColour, OfAMirrorIsTheLight) {
    const Film film{.layers = {{.index = 1.0, .thickness_nm = 300.0}}, .base = std::complex<double>(0.0, 1e6)};
    const glm::dvec3 white = FilmColour(film, colour::LightSpectra{})(0.7) * glm::dvec3(1.0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], colour::white_d65()[c], 1e-5);
}

TEST(FilmColour, NeverGivesMoreLuminanceThanItGets) {
    for (const Base& base : {Base(std::complex<double>(1.0)), Base(std::complex<double>(1.5)), Base(colour::Metal::Ag),
                             Base(NormalReflectance{{1.0, 0.6, 0.2}})})
        for (const double thickness_nm : {0.0, 90.0, 450.0, 1e5})
            for (const double cosine : {0.0, 0.01, 0.5, 1.0}) {
                const Film film{.layers = {{.index = 2.4, .thickness_nm = thickness_nm}}, .base = base};
                const glm::dmat3 reflected = FilmColour(film, colour::LightSpectra{})(cosine);
                for (int c = 0; c < 3; ++c) {
                    const glm::dvec3 light = colour::rgb_to_xyz(colour::LightSpectra{}, glm::dmat3(1.0)[c]);
                    EXPECT_GE(reflected[c].y, 0.0);
                    EXPECT_LE(reflected[c].y, light.y * (1.0 + 1e-12)) << thickness_nm << " " << cosine;
                }
            }
}

}  // namespace
}  // namespace rowland::thin_film
