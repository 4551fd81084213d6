

#include "modules/diffraction/reference/reference.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

const Grating kGrating{.pitch_nm = 1600.0, .profile = SlitProfile{800.0}};

const std::vector<ShadingPoint> kFrames = {
    {.view = {0.3, 0.1, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}},
    {.view = {0.1, -0.2, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}},
    {.view = {0.3, 0.1, -0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}}};

/// Uniform light with one texel of another brightness, at x = 0.16 above the frames' surface, where order 1 looks: a
/// lamp a texel wide that arcs hit or miss.
lighting::ProbeImage probe_with_lamp(float lamp) {
    image::Image image{.width = 1024, .height = 512, .texels = std::vector(std::size_t{1024} * 512, glm::vec3(1.0F))};
    image.at(998, 200) = glm::vec3(lamp);
    return {std::move(image), lighting::Mapping::Equirectangular, "lamp"};
}

TEST(CheckedReference, GivesTheReferenceItself) {
    const auto probe = probe_with_lamp(10.0F);
    const auto plain = reference_radiance(kGrating, probe, colour::LightSpectra(), kFrames);
    const auto checked = checked_reference(kGrating, probe, colour::LightSpectra(), kFrames);
    ASSERT_EQ(checked.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(checked[i].xyz, plain[i]);
}

/// Smooth light leaves the trapezoid rule's error in wavelength; black frames have none.
TEST(CheckedReference, ErrorIsSmallUnderSmoothLight) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const auto checked = checked_reference(kGrating, test::read_sh_light(light_path), colour::LightSpectra(), kFrames);
    EXPECT_LT(checked[0].error, 1e-4);
    EXPECT_LT(checked[1].error, 1e-4);
    EXPECT_EQ(checked[2].error, 0.0);
}

/// The lamp spans texels that two nodes each sample: the estimate must see that this is coarse.
TEST(CheckedReference, ErrorGrowsWithTheContrastOfTheLight) {
    const auto soft = checked_reference(kGrating, probe_with_lamp(1.0F), colour::LightSpectra(), kFrames);
    const auto hard = checked_reference(kGrating, probe_with_lamp(1e5F), colour::LightSpectra(), kFrames);
    EXPECT_GT(hard[0].error + hard[1].error, 3.0 * (soft[0].error + soft[1].error));
    EXPECT_GT(hard[0].error + hard[1].error, 1e-4);
}

}  // namespace
}  // namespace rowland::diffraction
