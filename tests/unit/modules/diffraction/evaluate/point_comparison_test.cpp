// One point at a time, held to what rowland-trade evaluate prints for it.
#include "modules/diffraction/evaluate/point_shader.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <sstream>

#include "engine/asset/container.h"
#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/unit/editor/trade/trade_run.h"

namespace rowland::diffraction {
namespace {

constexpr ShadingPoint kTilted{.view = {0.25, 0.3, 0.92}, .normal = {0.0, 0.1, 0.99}, .grating = {1.0, 0.2, 0.0}};
constexpr ShadingPoint kOther{.view = {-0.4, 0.2, 0.8}, .normal = {0.0, 0.1, 0.99}, .grating = {0.3, 1.0, 0.0}};

constexpr GrooveLayout kUniform = GrooveLayout::FlatUniform;

std::string row(const ShadingPoint& frame) {
    const auto three = [](const glm::dvec3& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z); };
    return three(frame.view) + ',' + three(frame.normal) + ',' + three(frame.grating) + '\n';
}

class PointComparisonTest : public ::testing::Test {
 protected:
    PointComparisonTest() { test::write_sweep_inputs(folder_.path()); }

    std::shared_ptr<const CookedMaterial> cook(const std::string& name, const std::string& pitch,
                                               const std::string& quality, const std::string& members = "") {
        const std::string text = R"({"grating": {"pitch_nm": )" + pitch +
                                 R"(, "profile": {"type": "slit", "width_nm": 300})" + members + R"(}, "quality": )" +
                                 quality + "}";
        write_file_atomic(folder_.path() / (name + ".json"), text);
        const nlohmann::json json = nlohmann::json::parse(text);
        auto cooked = std::make_shared<const CookedMaterial>(cook_material(json, name));
        asset::CookedAsset file;
        file.header.type = kMaterialAssetType;
        file.header.type_version = kMaterialAssetVersion;
        file.payload = write_cooked_material(json, *cooked);
        write_file_atomic(folder_.path() / (name + ".material"), asset::pack(file));
        return cooked;
    }
    lighting::ProbeImage probe(const std::string& name) const {
        return {image::load_image(folder_.path() / name), lighting::Mapping::Equirectangular, name};
    }
    /// The one row that the program prints.
    glm::dvec3 printed(const ShadingPoint& frame, const std::string& arguments) const {
        write_file_atomic(folder_.path() / "frames.csv", "vx,vy,vz,nx,ny,nz,gx,gy,gz\n" + row(frame));
        const test::Ended run = test::run_trade(folder_.path(), "evaluate --frames frames.csv " + arguments);
        EXPECT_EQ(run.code, 0) << run.err;
        std::istringstream lines(run.out);
        std::string header;
        glm::dvec3 xyz(0.0);
        char comma = 0;
        std::getline(lines, header);
        lines >> xyz.x >> comma >> xyz.y >> comma >> xyz.z;
        EXPECT_TRUE(lines) << run.out;
        return xyz;
    }
    static void expect_printed(const glm::dvec3& computed, const glm::dvec3& printed) {
        // Nine significant digits are printed.
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(computed[i], printed[i], 1e-8 * std::abs(printed[i]));
    }

    test::TemporaryFolder folder_;
};

TEST_F(PointComparisonTest, IsWhatTheProgramPrintsForEachMaterialProbeAndPoint) {
    // A second probe: the first one, turned over.
    image::Image turned = image::load_image(folder_.path() / "sky.hdr");
    std::reverse(turned.texels.begin(), turned.texels.end());
    const auto wide = cook("wide", "1600", R"({"representation": "arc", "bands": 4})");
    const auto narrow = cook("narrow", "740", R"({"representation": "arc", "bands": 4})");
    PointComparer sky(probe("sky.hdr"), 16);
    glm::dvec3 last(0.0);
    for (const ShadingPoint& frame : {kTilted, kOther})
        for (const auto& [name, cooked] : {std::pair("wide", wide), std::pair("narrow", narrow)}) {
            const PointComparison point = sky.compare(cooked, math::SphericalWindow::None, frame, kUniform);
            const std::string common = std::string("--probe sky.hdr ");
            expect_printed(point.shown, printed(frame, common + "--cooked " + name + ".material"));
            const glm::dvec3 reference = printed(frame, common + "--method reference --material " + name + ".json");
            expect_printed(point.reference, reference);
            EXPECT_NEAR(point.error, glm::length(point.shown - reference) / glm::length(reference), 1e-7);
            EXPECT_GT(point.error, 1e-4);  // there is something to see
            EXPECT_NE(point.reference, last);
            last = point.reference;
        }
    PointComparer upside_down({turned, lighting::Mapping::Equirectangular, "turned"}, 16);
    EXPECT_GT(glm::length(upside_down.compare(wide, math::SphericalWindow::None, kTilted, kUniform).reference -
                          sky.compare(wide, math::SphericalWindow::None, kTilted, kUniform).reference),
              0.0);
}

TEST_F(PointComparisonTest, KeyLightsAreTakenApartOnlyForMaterialsThatShadeThem) {
    const auto with = cook("with", "1600", R"({"representation": "arc", "bands": 5, "key_lights": 64})");
    const auto without = cook("without", "1600", R"({"representation": "arc", "bands": 5, "key_lights": 0})");
    PointComparer comparer(probe("sky.hdr"), 4);
    const auto window = math::SphericalWindow::Hann;
    const std::string common = "--probe sky.hdr --window hann --key-lights 4 --cooked ";
    expect_printed(comparer.compare(with, window, kTilted, kUniform).shown, printed(kTilted, common + "with.material"));
    expect_printed(comparer.compare(without, window, kTilted, kUniform).shown,
                   printed(kTilted, "--probe sky.hdr --window hann --cooked without.material"));
    expect_printed(comparer.compare(with, window, kTilted, kUniform).shown, printed(kTilted, common + "with.material"));
}

TEST_F(PointComparisonTest, AMapIsTheSameWhetherItWasFilledForThisPointOrAnother) {
    const auto planar = cook("planar", "1600", R"({"representation": "planar", "map_resolution": 32})");
    PointComparer comparer(probe("sky.hdr"), 4);
    const auto window = math::SphericalWindow::None;
    const glm::dvec3 first = comparer.compare(planar, window, kTilted, kUniform).shown;
    comparer.compare(planar, window, kOther, kUniform);
    EXPECT_EQ(comparer.compare(planar, window, kTilted, kUniform).shown, first);
    expect_printed(first, printed(kTilted,
                                  "--probe sky.hdr --material planar.json --method planar --resolution 32 "
                                  "--key-lights 4"));
}

/// As the GPU draws it (LatticePicture.MapsOfOneAzimuthEqualTheCpus): where g is the same everywhere, the map of that
/// azimuth, of more views.
TEST_F(PointComparisonTest, AFlatObjectShowsTheMapThatItIsDrawnWith) {
    const auto cooked = cook(
        "foil", "1600", R"({"representation": "planar", "map_resolution": 16, "bands": 2, "rank": 4, "key_lights": 0})",
        R"(, "groove_lobe": {"sigma": 0.1})");
    const lighting::ProbeImage sky = probe("sky.hdr");
    const EvaluationLight light(sky, 0, math::SphericalWindow::None);
    const PlanarLobe& lobe = *std::get<PlanarTables>(cooked->tables).lobe;
    const LobeSpectrum of_one(lobe.pattern, one_azimuth(lobe.size).views);
    const LobeSpectrum of_all(lobe.pattern, lobe.size.views);
    const auto slice = [&](const ShadingPoint& frame) {
        return sample(fill_lobe_slice(light.texels(), of_one, frame.normal, frame.grating), frame);
    };
    const LobeMap volume = fill_lobe_map(light.texels(), of_all, glm::normalize(kTilted.normal), lobe.size.azimuths);
    const glm::dvec3 same = slice(kTilted);
    EXPECT_GT(glm::distance(same, sample(volume, kTilted)), 1e-3 * glm::length(same)) << "the two maps differ";

    ShadingPoint far = kTilted;  // another object of one g, whose points lie between
    far.normal = {0.3, 0.1, 0.9};
    const std::vector<ShadingPoint> one_g = {kTilted, far, kTilted};
    const std::vector<glm::dvec3> shown = evaluate_baked(*cooked, light, one_g);
    for (std::size_t i = 0; i < one_g.size(); ++i) EXPECT_EQ(shown[i], slice(one_g[i])) << i;
    const std::vector<glm::dvec3> disc = evaluate_baked(*cooked, light, std::array{kTilted, kOther});
    EXPECT_EQ(disc[0], sample(volume, kTilted));
    EXPECT_EQ(disc[1], sample(volume, kOther));

    const std::string settings = "--probe sky.hdr --key-lights 0 --cooked foil.material";
    expect_printed(same, printed(kTilted, settings));
    PointComparer comparer(sky, 0);
    const auto none = math::SphericalWindow::None;
    EXPECT_EQ(comparer.compare(cooked, none, kTilted, kUniform).shown, same);
    EXPECT_EQ(comparer.compare(cooked, none, kTilted, GrooveLayout::Flat).shown, disc[0]);
    const ArcTable& stand_in = *std::get<PlanarTables>(cooked->tables).stand_in;
    EXPECT_EQ(comparer.compare(cooked, none, kTilted, GrooveLayout::Curved).shown,
              point_shader(stand_in, MaterialKernel{}, light)(kTilted));
}

TEST_F(PointComparisonTest, AShaderOfOnePointHasTheKeyLightsAndTheCover) {
    for (const char* cover : {"", R"(, "cover": {"ior": 1.5})"}) {
        const auto json = nlohmann::json::parse(
            std::string(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 300}})") + cover +
            R"(, "quality": {"representation": "direct"}})");
        const CookedMaterial cooked = cook_material(json, "m.json");
        const EvaluationLight light(probe("sky.hdr"), 4, math::SphericalWindow::None);
        ASSERT_FALSE(light.key_lights().empty());
        const glm::dvec3 shown = baked_shader(cooked, light)(kTilted);
        EXPECT_GT(shown.y, 0.0) << cover;
        EXPECT_EQ(shown, evaluate_baked(cooked, light, std::array{kTilted})[0]) << cover;
    }
}

}  // namespace
}  // namespace rowland::diffraction
