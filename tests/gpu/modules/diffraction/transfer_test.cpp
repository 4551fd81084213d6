// Representations that shade vertices, against the CPU's evaluation of the same tables.
#include <gtest/gtest.h>

#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

class VertexShading : public GratingPicture {};

TEST_F(VertexShading, TransferEqualsTheCpu) {
    const CookedMaterial cooked = cook(kBlazed, R"({"representation": "transfer"})");
    show(cooked, 0.5);
    EXPECT_LT(largest_difference(draw(), table_xyz<TransferTable>(cooked, light_.sh)), kPictureTolerance);
    EXPECT_GT(compared_, 500);
    EXPECT_GT(brightest_, 0.01);
}

TEST_F(VertexShading, TransferEqualsTheCpuForEveryMappingAndStorage) {
    const char* const settings[] = {
        R"("view_mapping": "parabolic", "view_resolution": 24, "storage": "unorm8", "bands": 4)",
        R"("view_mapping": "spherical", "view_resolution": 20, "storage": "unorm16", "bands": 3)",
        R"("view_mapping": "parabolic", "storage": "fp32", "bands": 7)"};
    for (const char* setting : settings) {
        const CookedMaterial cooked = cook(kFoil, std::string(R"({"representation": "transfer", )") + setting + "}");
        if (!renderer_) show(cooked, -0.8);
        use(cooked);
        EXPECT_LT(largest_difference(draw(), table_xyz<TransferTable>(cooked, light_.sh)), kPictureTolerance)
            << setting;
        EXPECT_GT(brightest_, 0.01);
    }
}

TEST_F(VertexShading, TransferTakesKeyLightsWhereItIsTold) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kSlitCd, R"({"representation": "transfer", "key_lights": 64})");
    show(cooked, 0.5);
    const auto rest = table_xyz<TransferTable>(cooked, light_.residual);
    EXPECT_LT(
        largest_difference(
            draw(), [&](const Point& point) { return rest(point) + key_light_xyz(cooked, light_.key_lights, point); }),
        kPictureTolerance);
    EXPECT_GT(largest_difference(draw(), rest), 0.1);
}

TEST_F(VertexShading, SpikesEqualTheCpuForTurnedGroovesAndOtherMappings) {
    const char* const qualities[] = {
        R"({"representation": "spikes"})", R"({"representation": "spikes", "view_mapping": "parabolic"})",
        R"({"representation": "spikes", "view_mapping": "one-dimensional", "storage": "fp32"})",
        R"({"representation": "spikes", "view_mapping": "one-dimensional", "storage": "unorm8"})"};
    for (const char* quality : qualities) {
        const CookedMaterial cooked = cook(kSlitCd, quality);
        if (!renderer_) show(cooked, -0.6);
        use(cooked);
        EXPECT_LT(largest_difference(draw(), table_xyz<SpikeTable>(cooked, light_.sh)), kPictureTolerance) << quality;
        EXPECT_GT(brightest_, 0.01);
    }
}

}  // namespace
}  // namespace rowland::diffraction
