#include <array>
#include <cmath>
#include <numbers>

#include "engine/colour/colour_space.h"
#include "modules/thin_film/model/film.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"

namespace rowland::thin_film {

namespace {

using Complex = std::complex<double>;
constexpr double kGreen_nm = 550.0;

/// A face without layers.
double bare(Complex base, double cosine) {
    return reflectance({}, base, kGreen_nm, cosine);
}

double coated(double index, double thickness_nm, Complex base, double cosine, double wavelength_nm = kGreen_nm) {
    const std::array<Layer, 1> layer = {Layer{index, thickness_nm}};
    return reflectance(layer, base, wavelength_nm, cosine);
}

TEST(ThinFilmReflectance, OfABareFaceIsFresnels) {
    // Real Fresnel equations, Born & Wolf 1.5.
    for (const double cosine : {1.0, 0.7, 0.2}) {
        const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / 2.25);
        const double s = (cosine - 1.5 * inside) / (cosine + 1.5 * inside);
        const double p = (1.5 * cosine - inside) / (1.5 * cosine + inside);
        EXPECT_NEAR(bare(1.5, cosine), 0.5 * (s * s + p * p), 1e-14);
    }
    const Complex aluminium(0.96, 6.7);
    EXPECT_NEAR(bare(aluminium, 1.0), std::norm((1.0 - aluminium) / (1.0 + aluminium)), 1e-14);
}

/// glTF's metals may reflect all light, or more where a colour was scaled; the index stays finite.
TEST(ThinFilmReflectance, OfAPerfectMirrorIsNearlyOne) {
    for (const double r0 : {1.0, 1.5}) {
        const std::complex<double> index = base_index(NormalReflectance{glm::dvec3(r0)}, 550.0);
        ASSERT_TRUE(std::isfinite(index.real())) << r0;
        EXPECT_NEAR(std::norm((index - 1.0) / (index + 1.0)), 0.9999, 1e-12) << r0;
    }
}

TEST(ThinFilmReflectance, OfAFilmThatIsNotThereIsTheBases) {
    for (const Complex base : {Complex(1.0), Complex(1.5), Complex(0.2, 3.4), Complex(0.7)})
        for (const double cosine : {0.0, 1e-9, 0.05, 0.5, 1.0}) {
            EXPECT_NEAR(coated(1.4, 0.0, base, cosine), bare(base, cosine), 1e-12) << "no thickness";
            EXPECT_NEAR(coated(1.0, 400.0, base, cosine), bare(base, cosine), 1e-12) << "a film of air";
        }
    EXPECT_NEAR(coated(1.5, 400.0, 1.5, 0.6), bare(1.5, 0.6), 1e-12) << "a film of the base's index";
}

TEST(ThinFilmReflectance, OfAQuarterWaveIsTheKnownMinimum) {
    // Born & Wolf 1.6 (96): ((n - n2²)/(n + n2²))².
    const double n2 = 1.38;
    const double expected = std::pow((1.5 - n2 * n2) / (1.5 + n2 * n2), 2.0);
    EXPECT_NEAR(coated(n2, kGreen_nm / (4.0 * n2), 1.5, 1.0), expected, 1e-12);
    EXPECT_NEAR(coated(n2, kGreen_nm / (2.0 * n2), 1.5, 1.0), bare(1.5, 1.0), 1e-12) << "half a wave";
}

TEST(ThinFilmReflectance, IsTheSumOverThePathsInTheFilm) {
    // Slow and obvious: the amplitudes of 400 reflections inside the film, at normal incidence.
    const double n2 = 2.3;
    const Complex base(2.5, 3.3);
    const double first = (1.0 - n2) / (1.0 + n2);
    const Complex second = (n2 - base) / (n2 + base);
    const Complex turn = std::exp(Complex(0.0, 4.0 * std::numbers::pi * n2 * 137.0 / kGreen_nm));
    Complex sum = first;
    Complex path = (1.0 - first * first) * second * turn;
    for (int i = 0; i < 400; ++i) {
        sum += path;
        path *= -first * second * turn;
    }
    EXPECT_NEAR(coated(n2, 137.0, base, 1.0), std::norm(sum), 1e-12);
}

TEST(ThinFilmReflectance, ApproachesOneAtGrazingIncidence) {
    for (const double index : {1.0, 1.33, 2.4})
        for (const Complex base : {Complex(1.5), Complex(0.2, 3.4)}) {
            EXPECT_NEAR(coated(index, 300.0, base, 0.0), 1.0, 1e-8) << index;
            EXPECT_GT(coated(index, 300.0, base, 1e-4), 0.99) << index;
        }
}

TEST(ThinFilmReflectance, IsTotalUnderABaseOfLowIndex) {
    // Beyond sin θ = 0.7 nothing can run on into the base; a film does not change that.
    EXPECT_NEAR(bare(0.7, 0.6), 1.0, 1e-12);
    EXPECT_NEAR(coated(1.33, 400.0, 0.7, 0.6), 1.0, 1e-12);
    EXPECT_LT(coated(1.33, 400.0, 0.7, 0.8), 0.9);
}

TEST(ThinFilmReflectance, StaysWithinZeroAndOne) {
    for (const double index : {1.0, 1.2, 3.0})
        for (const double thickness_nm : {0.0, 1.0, 700.0, 1e5})
            for (const Complex base : {Complex(1.0), Complex(3.5), Complex(0.05, 4.0)})
                for (double cosine = 0.0; cosine <= 1.0; cosine += 0.05) {
                    const double found = coated(index, thickness_nm, base, cosine);
                    ASSERT_TRUE(found >= 0.0 && found <= 1.0) << index << " " << thickness_nm << " " << cosine;
                }
}

TEST(ThinFilmReflectance, OfTwoEqualLayersIsThatOfOne) {
    const std::array<Layer, 2> two = {Layer{1.6, 130.0}, Layer{1.6, 170.0}};
    for (const double cosine : {0.1, 0.6, 1.0})
        EXPECT_NEAR(reflectance(two, Complex(0.9, 6.0), kGreen_nm, cosine), coated(1.6, 300.0, {0.9, 6.0}, cosine),
                    1e-12);
}

}  // namespace

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
