// Sheets that transmit (PHYSICS §12): every representation against a reflecting grating of the same efficiencies under
// the light that is mirrored in the sheet's plane, and what is seen straight through.

#include "engine/colour/colour_space.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

constexpr glm::vec3 kMirrored(1.0F, 1.0F, -1.0F);  ///< in the triangle's plane

/// The probe mirrored at z = 0, texel by texel.
lighting::ProbeImage mirrored(const lighting::ProbeImage& probe) {
    image::Image picture = probe.image();
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column) {
            const int other = (3 * picture.width / 2 - 1 - column) % picture.width;
            picture.texels[static_cast<std::size_t>(row * picture.width + other)] =
                probe.image().texels[static_cast<std::size_t>(row * picture.width + column)];
        }
    return {std::move(picture), lighting::Mapping::Equirectangular};
}

class Transmitted : public GratingPicture {
 protected:
    Transmitted() {
        mesh_ = flat_triangle();
        mesh_.tangents[1].w = -1.0F;
        transform_.rotation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    }

    /// Under the probe, its key lights, a directional light and a lamp. `side` multiplies their directions and
    /// positions.
    std::vector<glm::vec4> drawn(const CookedMaterial& cooked, const glm::vec3& side, bool lit_by_lamps = true) {
        std::vector<lighting::KeyLight> keys = three_keys();
        for (lighting::KeyLight& key : keys) key.direction *= glm::dvec3(side);
        light_ = light_of(side.z < 0.0F ? mirrored(smooth_probe()) : smooth_probe(), std::move(keys), ++version_);
        world_ = ecs::World();
        show(cooked, 0.5);
        if (lit_by_lamps) {
            world_.add(world_.create(),
                       scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.3F, 0.2F, 0.9F)) * side,
                                               .irradiance = glm::vec3(0.5F, 0.3F, 0.2F)});
            const ecs::Entity lamp = world_.create();
            world_.add(lamp, scene::Transform{.translation = glm::vec3(-0.4F, 0.6F, 1.5F) * side});
            world_.add(lamp, scene::PunctualLight{.intensity = glm::vec3(2.0F)});
        }
        return draw();
    }

    void expect_mirrored(const std::string& grating, const std::string& quality) {
        SCOPED_TRACE(grating + quality);
        const auto reflected = drawn(cook_complete(grating, quality), kMirrored * kMirrored);
        const auto through = drawn(cook_complete(grating, quality, R"(, "transmission": {"ior": 1.5})"), kMirrored);
        EXPECT_GT(brightest(reflected), 0.01F);
        EXPECT_LT(largest_difference(reflected, through), 2e-3);
    }

    std::uint64_t version_ = 0;
};

constexpr const char* kFlatLobe = R"({"pitch_nm": 1650})";
constexpr const char* kLobe = R"({"pitch_nm": 1660, "groove_lobe": {"sigma": 0.3}})";

TEST_F(Transmitted, VertexTablesShowTheLightBehind) {
    expect_mirrored(kFlatLobe, R"({"representation": "spikes", "bands": 3, "view_resolution": 10, "key_lights": 64})");
    expect_mirrored(kLobe, R"({"representation": "spikes", "bands": 3, "view_resolution": 10, "key_lights": 64,
                               "lights_at": "vertices"})");
}

TEST_F(Transmitted, PixelTablesAndLightsShowTheLightBehind) {
    expect_mirrored(kFlatLobe, R"({"representation": "arc", "bands": 4, "rank": 8})");
    expect_mirrored(kLobe, R"({"representation": "arc", "bands": 3, "rank": 8, "view_resolution": 8})");
    expect_mirrored(kLobe, R"({"representation": "direct"})");
}

TEST_F(Transmitted, MapsShowTheLightBehind) {
    expect_mirrored(kFlatLobe, R"({"representation": "planar", "map_resolution": 32})");
    expect_mirrored(kFlatLobe, R"({"representation": "circle", "map_resolution": 16})");
    expect_mirrored(R"({"pitch_nm": 1660, "groove_lobe": {"sigma": 0.05}})",
                    R"({"representation": "streak", "map_resolution": 64})");
}

/// A sheet that also reflects adds what its other side shows.
TEST_F(Transmitted, WhatTheSheetReflectsIsDrawnOverIt) {
    const auto slits = [&](double reflectance, bool transmits) {
        nlohmann::json json = parse_json(
            R"({"grating": {"pitch_nm": 1670, "profile": {"type": "slit", "width_nm": 700}}, "base": {"color": [0, 0, 0]},
                "quality": {"representation": "arc", "bands": 4, "key_lights": 64}})",
            "test");
        if (transmits) json["transmission"] = {{"ior", 1.5}, {"reflectance", reflectance}};
        return drawn(cook_material(json, "test"), glm::vec3(1.0F), false);
    };
    const auto both = slits(0.25, true);
    const auto through = slits(0.0, true);
    auto sum = slits(0.0, false);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = 0.75F * through[i] + 0.25F * sum[i];
    EXPECT_GT(brightest(both), 0.01F);
    EXPECT_LT(largest_difference(both, sum), 2e-3);
}

/// What lies behind is seen in the colour of order 0, and what lies in front hides the sheet.
TEST_F(Transmitted, WhatLiesBehindIsTintedByOrderZero) {
    xyz_to_working_ = colour::xyz_to_acescg();
    light_ = black_light();
    const CookedMaterial cooked = cook_material(
        parse_json(R"({"grating": {"pitch_nm": 2000, "profile": {"type": "lamellar", "duty": 0.5, "depth_nm": 700}},
                       "transmission": {"ior": 1.5}, "quality": {"representation": "spikes", "bands": 3}})",
                   "test"),
        "test");
    show(cooked);
    const auto add_wall = [&](float z, const glm::vec3& emissive) {
        const ecs::Entity wall = world_.create();
        scene::Mesh mesh = flat_triangle();
        for (glm::vec3& position : mesh.positions) position = 3.0F * position + glm::vec3(0.0F, 0.0F, z);
        world_.add(wall, scene::Transform{});
        world_.add(wall, render::make_mesh_instance(std::move(mesh)));
        world_.add(wall, render::StandardMaterial{.base_colour = glm::vec3(0.0F), .emissive = emissive, .unlit = true});
    };
    const std::size_t middle = kSize * kSize / 2 + kSize / 2;
    add_wall(-0.5F, glm::vec3(2.0F));
    const glm::dvec3 tint = colour::xyz_to_acescg() * layer_weights(cooked.material.grating).mirror;
    const glm::vec4 seen = draw()[middle];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 2.0 * tint[c], 1e-4) << c;
    EXPECT_GT(tint.b, 5.0 * tint.r);  // half of 700 nm: η₀ is 0 at 700 nm
    EXPECT_EQ(seen.a, 1.0F);
    add_wall(0.5F, glm::vec3(0.25F));
    EXPECT_NEAR(draw()[middle].g, 0.25F, 1e-4F);
}

}  // namespace
}  // namespace rowland::diffraction
