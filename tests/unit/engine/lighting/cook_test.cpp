#include "engine/lighting/cook.h"

#include <gmock/gmock.h>

#include "engine/core/json_reader.h"
#include "engine/image/exr.h"
#include "tests/support/files.h"
#include "tests/support/light.h"

namespace rowland::lighting {
namespace {

class ProbeCook : public ::testing::Test {
 protected:
    ProbeCook() { register_cook_types(registry_); }

    const cook::AssetType& probe() const { return *registry_.find("probe"); }
    const cook::AssetType& probe_image() const { return *registry_.find("probe image"); }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        write_file_atomic(folder_.path() / name, std::string_view(text));
        return folder_.path() / name;
    }

    cook::Registry registry_;
    test::TemporaryFolder folder_;
};

TEST_F(ProbeCook, RecipesAndImagesAreRecognised) {
    const auto recipe = parse_json(R"({"probe": {}})", "a.json");
    const auto other = parse_json(R"({"grating": {}})", "a.json");
    EXPECT_TRUE(probe().recognises("a.json", &recipe));
    EXPECT_FALSE(probe().recognises("a.json", &other));
    EXPECT_FALSE(probe().recognises("a.hdr", nullptr));
    EXPECT_TRUE(probe_image().recognises("a.HDR", nullptr));
    EXPECT_TRUE(probe_image().recognises("a.exr", nullptr));
    EXPECT_FALSE(probe_image().recognises("a.png", nullptr));
    EXPECT_FALSE(static_cast<bool>(probe_image().cook));
}

TEST_F(ProbeCook, ImageRecipeCooksAndDependsOnItsImage) {
    image::write_exr(folder_.path() / "white.exr", image::Image{32, 16, std::vector<glm::vec3>(512, glm::vec3(2.0f))});
    cook::Context context(
        write("p.json", R"({"probe": {"type": "image", "file": "white.exr", "bands": 3, "face_size": 16}})"));
    const auto payload = probe().cook(context);
    const LightProbe light = deserialise(payload, "p.probe");
    EXPECT_EQ(light.sh.bands, 3);
    EXPECT_NEAR(test::evaluate_irradiance(light.ambient, {0, 1, 0}).x, 2, 0.02);  // texels of 11°
    EXPECT_THAT(context.dependencies(), ::testing::Contains(folder_.path() / "white.exr"));
    EXPECT_THAT(probe().describe(payload, "p.probe"), ::testing::HasSubstr("bands: 3"));
    EXPECT_EQ(probe().extension, ".probe");
    EXPECT_EQ(probe().version, kLightProbeVersion);
}

TEST_F(ProbeCook, ProbeDependsOnItsIlluminantsFile) {
    write("lamp.csv", "wavelength_nm,relative_power\n588,0\n589,1\n590,0\n");
    cook::Context context(write("p.json", R"({"probe": {"type": "clear_sky", "sun_azimuth_deg": 1, "width": 64,
        "sun_elevation_deg": 9, "face_size": 16, "illuminant": "lamp.csv"}})"));
    const auto payload = probe().cook(context);
    EXPECT_THAT(context.dependencies(), ::testing::Contains(folder_.path() / "lamp.csv"));
    const LightProbe light = deserialise(payload, "p.probe");
    EXPECT_EQ(light.illuminant.name, "lamp.csv");  // and not where it lay: cooked bytes hold no folder
    EXPECT_EQ(light.illuminant.power(589.0), 1.0);
    EXPECT_THAT(probe().describe(payload, "p.probe"), ::testing::HasSubstr("illuminant: lamp.csv"));

    write("lamp.csv", "wavelength_nm,relative_power\n300,1\n310,1\n");
    cook::Context dark(folder_.path() / "p.json");
    EXPECT_THROW(probe().check(dark), Error);
    cook::Context missing(write("m.json", R"({"probe": {"type": "image", "file": "a.exr", "illuminant": "no.csv"}})"));
    EXPECT_THROW(probe().check(missing), Error);
}

TEST_F(ProbeCook, BadSourcesAreRefused) {
    cook::Context missing(write("m.json", R"({"probe": {"type": "image", "file": "nowhere.hdr"}})"));
    EXPECT_THROW(probe().check(missing), Error);
    cook::Context misspelt(write("s.json", R"({"probe": {"type": "sky"}})"));
    EXPECT_THROW(probe().check(misspelt), Error);
    cook::Context broken(write("b.hdr", "#?RADIANCE\n\n-Y 9 +X 9\n"));
    EXPECT_THROW(probe_image().check(broken), Error);
    EXPECT_THROW(probe().describe({}, "x.probe"), Error);
}

TEST_F(ProbeCook, SoundSourcesPassTheCheck) {
    image::write_exr(folder_.path() / "ok.exr", image::Image{2, 1, {glm::vec3(1.0f), glm::vec3(2.0f)}});
    cook::Context picture(folder_.path() / "ok.exr");
    EXPECT_NO_THROW(probe_image().check(picture));
    cook::Context sky(write(
        "sky.json", R"({"probe": {"type": "clear_sky", "sun_azimuth_deg": 1, "sun_elevation_deg": 9, "width": 64}})"));
    EXPECT_NO_THROW(probe().check(sky));
}

}  // namespace
}  // namespace rowland::lighting
