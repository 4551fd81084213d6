#include "engine/lighting/probe_recipe.h"

#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "tests/support/expect.h"

namespace rowland::lighting {
namespace {

using ::testing::HasSubstr;

ProbeRecipe parse(const std::string& text) {
    return parse_probe_recipe(parse_json(text, "p.json"), "p.json");
}

std::string refusal(const std::string& text) {
    std::string message = test::message_of([&] { parse(text); });
    EXPECT_THAT(message, testing::StartsWith("p.json")) << text;
    return message;
}

const std::string kRoom = R"("ceiling": [1,1,1], "wall": [1,1,1], "floor": [1,1,1])";

TEST(ProbeRecipe, StudioIsParsedWhole) {
    const ProbeRecipe recipe =
        parse(R"({"probe": {"type": "studio", )" + kRoom + R"(, "width": 128, "bands": 7, "key_lights": 64,
        "face_size": 32, "intensity": 2, "boxes": [{"azimuth_deg": 10, "elevation_deg": 20, "roll_deg": 5,
        "half_size_deg": [3, 4], "soft_edge_deg": 1, "radiance": [7, 8, 9]}]}})");
    const auto& studio = std::get<StudioRecipe>(recipe.source);
    ASSERT_EQ(studio.boxes.size(), 1u);
    EXPECT_EQ(studio.boxes[0].half_height_deg, 4);
    EXPECT_EQ(studio.boxes[0].radiance, glm::dvec3(7, 8, 9));
    EXPECT_EQ(recipe.width, 128);
    EXPECT_EQ(recipe.settings.bands, 7);
    EXPECT_EQ(recipe.settings.key_lights, 64);
    EXPECT_EQ(recipe.settings.prefilter.face_size, 32);
    const ProbeImage probe = render_recipe(recipe, {}, "p.json");
    EXPECT_EQ(probe.image().width, 128);
    EXPECT_NEAR(probe.radiance({0, -1, 0}).x, 2, 1e-6);  // intensity
}

TEST(ProbeRecipe, ClearSkyAndImageAreParsed) {
    const ProbeRecipe sky =
        parse(R"({"probe": {"type": "clear_sky", "sun_azimuth_deg": 10, "sun_elevation_deg": 20, "turbidity": 4}})");
    EXPECT_EQ(std::get<ClearSkyRecipe>(sky.source).turbidity, 4);
    EXPECT_EQ(sky.settings.bands, 16);
    EXPECT_EQ(sky.settings.key_lights, 16);

    const ProbeRecipe capture = parse(R"({"probe": {"type": "image", "file": "x.hdr", "mapping": "angular"}})");
    const ProbeImage probe = render_recipe(
        capture,
        [](const std::string& name) {
            EXPECT_EQ(name, "x.hdr");
            return image::Image{2, 2, std::vector<glm::vec3>(4, glm::vec3(3.0f))};
        },
        "p.json");
    EXPECT_FALSE(capture.settings.dome);
    const ProbeRecipe room =
        parse(R"({"probe": {"type": "image", "file": "x.hdr", "dome": {"height_m": 1.6, "radius_m": 5}}})");
    ASSERT_TRUE(room.settings.dome);
    EXPECT_EQ(room.settings.dome->height_m, 1.6);
    EXPECT_EQ(room.settings.dome->radius_m, 5.0);
    EXPECT_EQ(probe.mapping(), Mapping::Angular);
    EXPECT_EQ(probe.radiance({0, 0, -1}).x, 3);
}

TEST(ProbeRecipe, NamesTheSpectrumOfItsWhite) {
    const std::string image = R"({"probe": {"type": "image", "file": "a.hdr")";
    EXPECT_EQ(parse(image + "}}").settings.illuminant.name, "D65");
    for (const std::string& name : colour::illuminant_names()) {
        const ProbeRecipe recipe = parse(std::string(image).append(R"(, "illuminant": ")").append(name).append("\"}}"));
        EXPECT_EQ(recipe.settings.illuminant.name, name);
        EXPECT_TRUE(recipe.illuminant_file.empty());
    }
    ProbeRecipe recipe = parse(image + R"(, "illuminant": "lamps/sodium.csv"}})");
    EXPECT_EQ(recipe.illuminant_file, "lamps/sodium.csv");
    load_illuminant(recipe, [](const std::string& name) {
        EXPECT_EQ(name, "lamps/sodium.csv");
        return std::string("wavelength_nm,relative_power\n588,0\n589,1\n590,0\n");
    });
    EXPECT_EQ(recipe.settings.illuminant.name, "lamps/sodium.csv");
    EXPECT_EQ(recipe.settings.illuminant.power(589.0), 1.0);
    EXPECT_THROW(load_illuminant(recipe, [](const std::string&) { return std::string("1,2\n"); }), Error);

    EXPECT_THAT(refusal(image + R"(, "illuminant": "D50"}})"), HasSubstr("/probe/illuminant"));
    EXPECT_THAT(refusal(image + R"(, "illuminant": "D50"}})"), HasSubstr("F11"));
    EXPECT_THAT(refusal(image + R"(, "illuminant": ""}})"), HasSubstr("/probe/illuminant"));
    EXPECT_THAT(refusal(image + R"(, "illuminant": 5}})"), HasSubstr("/probe/illuminant"));
}

TEST(ProbeRecipe, MistakesAreNamed) {
    EXPECT_THAT(refusal("[]"), HasSubstr("object"));
    EXPECT_THAT(refusal("{}"), HasSubstr("probe"));
    EXPECT_THAT(refusal(R"({"probe": {"type": "image", "file": "a.hdr"}, "x": 1})"), HasSubstr("/x"));
    const std::string image = R"("type": "image", "file": "a.hdr", )";
    const std::string sky = R"("type": "clear_sky", "sun_azimuth_deg": 0, )";
    const std::string studio = R"("type": "studio", )" + kRoom + ", ";
    const std::string box = studio + R"("boxes": [{"azimuth_deg": 1, "elevation_deg": 2, "radiance": [1, 1, 1], )";
    const std::pair<std::string, const char*> mistakes[] = {
        {R"("type": "studoi")", "\"studio\" meant"},
        {R"("type": "image", "file": "")", "/probe/file"},
        {image + R"("mappin": "angular")", "\"mapping\" meant"},
        {image + R"("width": 64)", "/probe/width"},
        {image + R"("dome": {"height_m": 2, "radius_m": 1})", "/probe/dome/radius_m"},
        {image + R"("face_size": 100)", "power of two"},
        {image + R"("bands": 33)", "/probe/bands"},
        {image + R"("key_lights": 65)", "/probe/key_lights"},
        {image + R"("key_lights": -1)", "/probe/key_lights"},
        {sky + R"("sun_elevation_deg": 0)", "/probe/sun_elevation_deg"},
        {sky + R"("sun_elevation_deg": 9, "ground_albedo": [0.1, 1.2, 0])", "ground_albedo/1"},
        {studio + R"("width": 66, "boxes": [])", "multiple of 4"},
        {box + R"("half_size_deg": [3, 4], "rol_deg": 5}])", "/probe/boxes/0/rol_deg"},
        {box + R"("half_size_deg": [3, 94]}])", "half_size_deg/1"}};
    for (const auto& [members, named] : mistakes)
        EXPECT_THAT(refusal(R"({"probe": {)" + members + "}}"), HasSubstr(named));
}

}  // namespace
}  // namespace rowland::lighting
