// Arc tables on the GPU against the CPU's evaluation of the same table.

#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

class Arc : public GratingPicture {};

/// Also where a lobe sees the view along the grooves (kFoil).
TEST_F(Arc, PixelsEqualTheCpuEvaluation) {
    const std::pair<const char*, const char*> rows[] = {{kSlitCd, ""},
                                                        {kFoil, R"(, "rank": 16, "view_resolution": 12)"}};
    for (const auto& [grating, settings] : rows) {
        SCOPED_TRACE(grating);
        const CookedMaterial cooked =
            cook(grating, std::string(R"({"representation": "arc", "key_lights": 0)") + settings + "}");
        show(cooked, -0.4);
        expect_drawn(arc_xyz(cooked, light_.sh));
        EXPECT_GT(compared_, 500);
        EXPECT_GT(brightest_, 0.05);
    }
}

TEST_F(Arc, PixelsEqualTheCpuForOtherRanksBandsStoragesAndTurnedGrooves) {
    transform_.scale = glm::vec3(1.0F, 1.2F, -0.8F);  // stretched and mirrored
    mesh_.indices = {0, 2, 1};
    mesh_.normals = {-mesh_.normals[0], -mesh_.normals[1], -mesh_.normals[2]};
    const CookedMaterial cooked =
        cook(kBlazed, R"({"representation": "arc", "key_lights": 0, "bands": 8, "rank": 14, "storage": "fp32"})");
    show(cooked, 0.7);
    expect_drawn(arc_xyz(cooked, light_.sh));
}

TEST_F(Arc, KeyLightsComeOnTopOfTheRest) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kBlazed, R"({"representation": "arc"})");
    show(cooked, 0.3);
    const auto residual = arc_xyz(cooked, light_.residual);
    expect_drawn(sum(residual, key_lights(cooked)));
    // Without them the two differ: the comparison sees key lights.
    EXPECT_GT(largest_difference(draw(), residual), 0.1);
}

/// The others are part of the rest: in ten bands here.
TEST_F(Arc, OnlyTheFirstSoManyKeyLightsAreShadedOneByOne) {
    std::vector<lighting::KeyLight> all = three_keys();
    std::swap(all[0], all[1]);  // the first of three_keys() is seen best
    light_ = light_of(smooth_probe(), all);
    const std::vector<lighting::KeyLight> first = {light_.key_lights[0]};
    const CookedMaterial cooked = cook(kBlazed, R"({"representation": "arc", "key_lights": 1})");
    show(cooked, 0.3);
    const auto rest = arc_xyz(cooked, lighting::residual(light_.sh, first, light_.sh.bands));
    const auto shown = [&](const std::vector<lighting::KeyLight>& keys) {
        return [&, keys](const Point& point) { return rest(point) + key_light_xyz(cooked, keys, point); };
    };
    const std::vector<glm::vec4> pixels = draw();
    EXPECT_LT(largest_difference(pixels, shown(first)), kPictureTolerance);
    EXPECT_GT(largest_difference(pixels, shown(all)), 0.1) << "a second one is seen";
}

/// A key light that ten bands carry is the same light in the SH and on its own. 5 %: what ten bands of the two wide
/// lobes lose, and what parts of lobes clamped at the horizon lose (direct_test of the bake: 1 to 2 %).
TEST_F(Arc, WideKeyLightsLookTheSameInTheHarmonics) {
    light_ = light_of(smooth_probe(), {three_keys()[1]});
    light_.key_lights[0].concentration = 40.0;
    light_ = light_of(smooth_probe(), light_.key_lights);
    const std::string quality = R"({"representation": "arc", "bands": 10, "rank": 16, "key_lights": )";
    show(cook(kSlitCd, quality + "64}"));
    const std::vector<glm::vec4> apart = draw();
    use(cook(kSlitCd, quality + "0}"));
    const std::vector<glm::vec4> whole = draw();
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        difference += static_cast<double>(glm::dot(whole[i] - apart[i], whole[i] - apart[i]));
        size += static_cast<double>(glm::dot(glm::vec3(whole[i]), glm::vec3(whole[i])));
    }
    EXPECT_GT(size, 1.0);
    EXPECT_LT(std::sqrt(difference / size), 0.05);
}

TEST_F(Arc, GrazingViewsEqualTheCpu) {
    light_ = light_of(smooth_probe(), three_keys());
    mesh_ = flat_triangle();
    look_along_the_surface();
    const CookedMaterial cooked = cook(kSlitCd, R"({"representation": "arc", "rank": 16})");
    show(cooked, 0.2);
    expect_drawn(sum(arc_xyz(cooked, light_.residual), key_lights(cooked)), key_lights_error(cooked));
}

}  // namespace
}  // namespace rowland::diffraction
