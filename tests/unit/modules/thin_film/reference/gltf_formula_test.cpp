#include "modules/thin_film/reference/film_reference.h"

#include <gtest/gtest.h>

#include "engine/colour/colour_space.h"

namespace rowland::thin_film {
namespace {

TEST(GltfFormula, OfNoFilmIsTheBaseAtNormalIncidence) {
    const glm::dvec3 f0(0.04, 0.3, 0.9);
    const glm::dvec3 found = gltf_formula(1.33, 0.0, f0, 1.0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], f0[c], 1e-2) << c;
}

TEST(GltfFormula, IsNearTheExactSumForAThinFilmAtNormalIncidence) {
    const FilmColour exact({.layers = {{1.4, 90.0}}, .base = std::complex<double>(2.0)}, colour::LightSpectra{});
    const glm::dvec3 expected = colour::xyz_to_rec709() * (exact(1.0) * glm::dvec3(1.0));
    const glm::dvec3 found = gltf_formula(1.4, 90.0, glm::dvec3(1.0 / 9.0), 1.0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.01) << c;
}

}  // namespace
}  // namespace rowland::thin_film
