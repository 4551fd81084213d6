// Every representation of a sheet that transmits (PHYSICS §12) against what a reflecting grating of the same
// efficiencies shows under the light that is mirrored in the sheet's plane.

#include <glm/geometric.hpp>
#include <numbers>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/reference/json_oracle.h"

namespace rowland::diffraction {
namespace {

/// A probe of a few lamps before a gradient; `below`: mirrored in the plane y = 0, texel by texel.
lighting::ProbeImage lamps(bool below) {
    constexpr int kWidth = 64;
    constexpr int kHeight = 32;
    image::Image image{.width = kWidth, .height = kHeight, .texels = {}};
    for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth; ++column) {
            const int at = below ? kHeight - 1 - row : row;
            glm::vec3 texel(0.2F + 0.02F * static_cast<float>(at), 0.3F, 0.5F - 0.01F * static_cast<float>(at));
            if (at == 20 && column % 23 == 5) texel = glm::vec3(40.0F, 30.0F, 20.0F);
            image.texels.push_back(texel);
        }
    return {std::move(image), lighting::Mapping::Equirectangular, "lamps"};
}

/// Views of surfaces that face up.
std::vector<ShadingPoint> frames() {
    std::vector<ShadingPoint> points;
    for (const glm::dvec3& view : {glm::dvec3(0.1, 1.0, 0.2), glm::dvec3(0.7, 0.6, -0.3), glm::dvec3(-0.5, 0.2, 0.8)})
        for (const glm::dvec3& g : {glm::dvec3(1.0, 0.0, 0.2), glm::dvec3(-0.3, 0.0, 1.0)})
            points.push_back({.view = view, .normal = {0.0, 1.0, 0.0}, .grating = g});
    return points;
}

nlohmann::json slits(bool transmits, bool narrow) {
    nlohmann::json json = nlohmann::json::parse(
        R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 700}, "orders": [-2, -1, 1]}})");
    if (narrow) json["grating"]["groove_lobe"]["sigma"] = 0.1;
    if (transmits) json["transmission"]["ior"] = 1.5;
    return json;
}

/// Openings in a screen, whose efficiencies are the same in both. Sides at an angle: u_h matters.
nlohmann::json openings() {
    return nlohmann::json::parse(R"({"grating": {"lattice": {"a_nm": [1500, 0], "b_nm": [700, 1800]}, "profile":
        {"type": "aperture", "width_nm": 700, "height_nm": 900}, "orders": 2}})");
}

/// How far transmitted light is from reflected mirrored light. Slits have the same efficiencies in both.
double difference(const std::string& name, const nlohmann::json& material) {
    const Method method = parse_method(name);
    const auto shaded = [&](const CookedMaterial& cooked, bool below) {
        return evaluate_baked(cooked, EvaluationLight(lamps(below), method.key_lights, method.window), frames());
    };
    CookedMaterial cooked = cook(material, "sheet.json", method);
    const std::vector<glm::dvec3> reflected = shaded(cooked, true);
    if (!cooked.material.grating.lattice) {
        cooked.material.grating.transmission.emplace();
        return relative_rms(shaded(cooked, false), reflected);
    }
    nlohmann::json sheet = material;
    sheet["transmission"]["ior"] = 1.5;
    return relative_rms(shaded(cook(sheet, "sheet.json", method), false), reflected);
}

/// Texels are mirrored exactly; what remains is where maps round. Key lights that are fitted to a mirrored probe are
/// others by a per cent or two, and a circle map has other nodes where the normal is the opposite one.
TEST(TransmittedLight, EqualsReflectedMirroredLightInEveryRepresentation) {
    for (const std::string name : {"spikes/bands=4/spikes=3", "arc/bands=5/rank=6", "direct/key_lights=4",
                                   "planar/map_resolution=32/key_lights=2", "circle/map_resolution=32/key_lights=4"})
        EXPECT_LT(difference(name, slits(false, false)), name.find("key_lights") != std::string::npos ? 0.03 : 2e-3)
            << name;
    for (const std::string name : {"streak/map_resolution=64", "planar/map_resolution=32", "arc/bands=4/rank=6"})
        EXPECT_LT(difference(name, slits(false, true)), 2e-3) << name;
    for (const std::string name : {"spikes/bands=3/spikes=2", "arc/bands=4/rank=6"})
        EXPECT_LT(difference(name, openings()), 2e-3) << name << " of a lattice";
}

/// The same key lights on both sides: to rounding.
TEST(TransmittedLight, OfKeyLightsEqualsThatOfMirroredKeyLights) {
    const CookedMaterial cooked = bake_kernel(parse_material(slits(true, true), "sheet.json"));
    const DirectMaterial material{.pitch_nm = cooked.material.grating.pitch_nm,
                                  .zero_order_xyz = cooked.zero_order_xyz,
                                  .lobe = cooked.material.grating.lobe,
                                  .cover = {}};
    const std::vector<lighting::KeyLight> below = {
        {.direction = glm::normalize(glm::dvec3(0.2, -0.7, 0.1)), .flux = {1.0, 0.8, 0.5}, .concentration = 300.0},
        {.direction = glm::normalize(glm::dvec3(-0.6, -0.1, 0.3)), .flux = {0.2, 0.5, 1.0}, .concentration = 40.0}};
    std::vector<lighting::KeyLight> above = below;
    for (lighting::KeyLight& key : above) key.direction.y = -key.direction.y;
    std::vector<glm::dvec3> through;
    std::vector<glm::dvec3> reflected;
    for (const ShadingPoint& frame : frames()) {
        through.push_back(direct_radiance(cooked.kernel, material, below, lit_from_behind(frame)));
        reflected.push_back(direct_radiance(cooked.kernel, material, above, frame));
    }
    EXPECT_GT(reflected[0].y + reflected[1].y + reflected[2].y, 0.0);
    EXPECT_LT(relative_rms(through, reflected), 1e-12);
}

TEST(TransmittedLight, OfTheReferenceEqualsReflectedMirroredLight) {
    const auto radiance = [](bool transmits) {
        return reference_radiance(parse_material(slits(transmits, true), "sheet.json").grating, lamps(!transmits),
                                  colour::LightSpectra(), frames());
    };
    EXPECT_LT(relative_rms(radiance(true), radiance(false)), 1e-6);
}

/// A sheet that also reflects shows the light of both sides, and its cooked file holds both.
TEST(TransmittedLight, IsAddedToWhatTheSheetReflects) {
    nlohmann::json json = slits(true, false);
    json["transmission"]["reflectance"] = 0.25;
    json["quality"] = {{"representation", "arc"}, {"key_lights", 64}};
    const CookedMaterial cooked = cook_material(json, "sheet.json");
    const lighting::ProbeImage probe = lamps(false);
    const EvaluationLight light(probe, 4, math::SphericalWindow::None);
    const auto mixed = [&](const auto& shaded) {
        std::vector<glm::dvec3> sum = shaded(slits(true, false));
        const std::vector<glm::dvec3> reflected = shaded(slits(false, false));
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = 0.75 * sum[i] + 0.25 * reflected[i];
        return sum;
    };
    const auto baked = [&](nlohmann::json side) {
        side["quality"] = json["quality"];
        return evaluate_baked(cook_material(side, "side.json"), light, frames());
    };
    EXPECT_LT(relative_rms(evaluate_baked(cooked, light, frames()), mixed(baked)), 1e-5);
    const auto truth = [&](const nlohmann::json& side) {
        return reference_radiance(parse_material(side, "side.json").grating, probe, colour::LightSpectra(), frames());
    };
    EXPECT_LT(relative_rms(truth(json), mixed(truth)), 1e-12);
    const CookedMaterial read = read_cooked_material(write_cooked_material(json, cooked), "sheet.material");
    EXPECT_EQ(evaluate_baked(read, light, frames()), evaluate_baked(cooked, light, frames()));
}

/// Pitches from below a wavelength to a centimetre, indices 1 and 3, a millimetre of depth, grazing views: finite, not
/// negative, and under uniform light of luminance 1 never brighter.
TEST(TransmittedLight, AtTheExtremesIsFiniteAndNoMoreThanArrives) {
    const lighting::ShLight white{.bands = 1, .coefficients = {glm::dvec3(2.0 * std::sqrt(std::numbers::pi))}};
    const EvaluationLight light(white, math::SphericalWindow::None);
    std::vector<ShadingPoint> points;
    for (const double height : {1e-9, 0.02, 1.0})
        for (const double along : {0.0, 0.7})
            points.push_back({.view = {1.0, height, along}, .normal = {0.0, 1.0, 0.0}, .grating = {1.0, 0.0, 0.0}});
    Material material;
    material.quality.pinned = ArcSettings{.bands = 1, .rank = 16, .storage = Storage::Float};
    Grating& sheet = material.grating;
    sheet.orders = {-2, -1, 0, 1, 2};
    for (const double pitch_nm : {300.0, 2000.0, 1e7})
        for (const double depth_nm : {1.0, 1e6})
            for (const Transmission& transmission : {Transmission{1.0, 0.0}, Transmission{3.0, 0.5}})
                for (const Profile& profile :
                     {Profile(LamellarProfile{0.5, depth_nm}), Profile(SinusoidalProfile{depth_nm}),
                      Profile(BlazedProfile{depth_nm})}) {
                    sheet.pitch_nm = pitch_nm;
                    sheet.profile = profile;
                    sheet.transmission = transmission;
                    for (const auto& xyz : {reference_radiance(sheet, white, colour::LightSpectra(), points),
                                            evaluate_baked(bake_material(material), light, points)})
                        for (const glm::dvec3& one : xyz) {
                            EXPECT_TRUE(std::isfinite(one.x + one.y + one.z)) << pitch_nm << " " << depth_nm;
                            EXPECT_GE(one.y, 0.0);
                            EXPECT_LE(one.y, 1.001);
                        }
                }
}

/// In any orientation.
TEST(TransmittedLight, OfArcMeetsTheOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_transmission.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const EvaluationLight light(test::read_sh_light(light_path), math::SphericalWindow::None);
    const test::JsonCase one = test::read_json_cases(path).front();
    ASSERT_EQ(one.light, "bandlimited_light_n5");
    Material material;
    material.grating = one.grating;
    material.quality = std::get<Quality>(suited_quality(parse_method("arc/bands=5/rank=16").quality, one.grating));
    EXPECT_LT(relative_rms(evaluate_baked(bake_material(material), light, one.frames), one.xyz), 1e-3);
}

}  // namespace
}  // namespace rowland::diffraction
