#include "editor/inspector/physics/film_curves.h"

#include <gtest/gtest.h>

namespace rowland::inspector {
namespace {

FilmCurves curves_of(const FilmInputs& inputs) {
    return film_curves(inputs, std::stop_token(), [](const FilmCurves&) {}).value();
}

TEST(FilmCurves, OfTheTableAreWithinOnePercentWhereGltfsFormulaIsNot) {
    const FilmCurves soap = curves_of({});
    EXPECT_TRUE(soap.complete);
    EXPECT_LT(soap.table_error, 0.01);
    EXPECT_GT(soap.formula_error, 0.05);
    ASSERT_EQ(soap.over_thickness.table.size(), soap.thicknesses_nm.size());
    ASSERT_EQ(soap.over_angle.table.size(), soap.angles_deg.size());
}

TEST(FilmCurves, FollowEveryInput) {
    const FilmCurves before = curves_of({});
    for (const FilmInputs& changed :
         {FilmInputs{.ior = 1.5}, FilmInputs{.thickness_nm = 300.0}, FilmInputs{.metal = colour::Metal::Au},
          FilmInputs{.base_ior = 1.5}, FilmInputs{.base_k = 2.0}, FilmInputs{.roughness = 0.4}}) {
        const FilmCurves after = curves_of(changed);
        EXPECT_NE(after.over_angle.exact, before.over_angle.exact);
        EXPECT_NE(after.over_angle.table, before.over_angle.table);
    }
    EXPECT_NE(curves_of({.angle_deg = 60.0}).spectrum, before.spectrum);
}

TEST(FilmCurves, OfNoFilmAreThoseOfTheBase) {
    const FilmCurves bare = curves_of({.thickness_nm = 0.0, .base_ior = 1.5});
    for (std::size_t i = 0; i < bare.spectrum.size(); ++i) EXPECT_NEAR(bare.spectrum[i].y, bare.bare[i].y, 1e-12);
    EXPECT_NEAR(bare.over_angle.exact.front().y, 0.04, 1e-4);
}

TEST(FilmCurves, AreShownWithoutTheTableFirstAndStopWhenAsked) {
    std::stop_source stop;
    bool shown = false;
    const auto stopped = film_curves({}, stop.get_token(), [&](const FilmCurves& curves) {
        shown = !curves.complete && !curves.over_angle.exact.empty() && curves.over_angle.table.empty();
        stop.request_stop();
    });
    EXPECT_TRUE(shown);
    EXPECT_FALSE(stopped);
}

}  // namespace
}  // namespace rowland::inspector
