// Key lights and the bands that they leave, under captured probes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <utility>

#include "engine/colour/light_spectra.h"
#include "engine/core/parallel.h"
#include "engine/image/load.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"
#include "tests/unit/modules/diffraction/representations/baked_views.h"

namespace rowland::diffraction {
namespace {

Grating lit_disc() {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = SlitProfile{800.0};
    return grating;
}

/// XYZ of a compact disc by five bands and key lights.
std::vector<glm::dvec3> lit(const lighting::ProbeImage& probe, int key_lights, std::span<const ShadingPoint> frames) {
    static const ArcTable table = bake(lit_disc(), ArcSettings{.rank = 16});
    static const KernelTable kernel = tabulate(ColourKernel(lit_disc(), colour::LightSpectra(colour::d65())));
    const EvaluationLight light(probe, key_lights, math::SphericalWindow::None);
    std::vector<glm::dvec3> xyz = test::evaluated(table, test::tangent_views(light.harmonics(5), frames));
    for (std::size_t i = 0; i < xyz.size(); ++i)
        xyz[i] += direct_radiance(kernel, {.pitch_nm = 1600.0}, light.key_lights(), frames[i]);
    return xyz;
}

struct CapturedProbe {
    std::string name;
    std::string file;
    lighting::Mapping mapping = lighting::Mapping::Equirectangular;
    double tolerance = 0.08;
};

class ArcWithKeyLights : public ::testing::TestWithParam<CapturedProbe> {};

/// Measured: .078 under Ennis (a doorway that the disc turns away from), .073 under Grace, .017 under Blender Sunset,
/// .024 under Royal Esplanade. The fit under Ennis is the most sensitive to rounding, by a tenth.
TEST_P(ArcWithKeyLights, MatchesTheOracleOfTheTiltedDisc) {
    const CapturedProbe& one = GetParam();
    ROWLAND_TEST_DATA(probe_path, "probes/" + one.file);
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    ROWLAND_TEST_DATA(oracle_path, "oracle/radiance_tilted_cd_" + one.name + ".csv");
    const auto frames = test::read_frames(rowland::test::read_csv(frames_path));
    const lighting::ProbeImage probe(image::load_image(probe_path), one.mapping);
    const double error =
        test::relative_rms(lit(probe, 32, frames), test::read_xyz(rowland::test::read_csv(oracle_path)));
    RecordProperty("error", fmt::format("{:.3g}", error));
    EXPECT_LT(error, one.tolerance);
}

INSTANTIATE_TEST_SUITE_P(Captured, ArcWithKeyLights,
                         ::testing::Values(CapturedProbe{"grace", "grace_probe.hdr", lighting::Mapping::Angular},
                                           CapturedProbe{
                                               .name = "ennis", .file = "ennis_probulator.hdr", .tolerance = 0.09},
                                           CapturedProbe{"blender_sunset", "blender_sunset.exr"},
                                           CapturedProbe{"royal_esplanade", "royal_esplanade_1k.hdr"}),
                         [](const auto& one) { return one.param.name; });

class ArcWithoutKeyLights : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

/// However few the lights.
TEST_P(ArcWithoutKeyLights, IsFartherFromTheReference) {
    ROWLAND_TEST_DATA(path, std::string("probes/") + GetParam().second);
    ROWLAND_TEST_DATA(frames_path, "oracle/frames_tilted_cd.csv");
    const std::vector<ShadingPoint> all = test::read_frames(rowland::test::read_csv(frames_path));
    std::vector<ShadingPoint> frames;  // of the whole disc: its parts show different light
    for (std::size_t i = 0; i < all.size(); i += 3) frames.push_back(all[i]);
    const lighting::ProbeImage probe(image::load_image(path), lighting::Mapping::Auto);
    const auto expected = reference_radiance(lit_disc(), probe, colour::LightSpectra(), frames);
    const double without = test::relative_rms(lit(probe, 0, frames), expected);
    RecordProperty("none", fmt::format("{:.3g}", without));
    for (const int count : {4, 8, 16, 32}) {
        const double error = test::relative_rms(lit(probe, count, frames), expected);
        RecordProperty(fmt::format("lights_{}", count), fmt::format("{:.3g}", error));
        EXPECT_LT(error, without) << count;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Captured, ArcWithoutKeyLights,
    ::testing::Values(std::pair("beach", "beach_probe.hdr"), std::pair("blender_city", "blender_city.exr"),
                      std::pair("blender_studio", "blender_studio.exr"),
                      std::pair("blender_sunset", "blender_sunset.exr"), std::pair("ennis", "ennis_probulator.hdr"),
                      std::pair("grace", "grace_probe.hdr"), std::pair("pmndrs_studio", "pmndrs_studio.exr"),
                      std::pair("pmndrs_sunset", "pmndrs_sunset.exr"),
                      std::pair("royal_esplanade", "royal_esplanade_1k.hdr"),
                      std::pair("venice", "venice_sunset_256.hdr")),
    [](const auto& one) { return std::string(one.param.first); });

}  // namespace
}  // namespace rowland::diffraction
