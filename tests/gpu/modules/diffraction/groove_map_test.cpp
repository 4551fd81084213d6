// Gratings whose direction and pitch vary by texture, pixel by pixel against the CPU.
#include "modules/diffraction/runtime/groove_map.h"

#include <gmock/gmock.h>

#include <random>

#include "tests/gpu/modules/diffraction/grating_picture.h"
#include "tests/support/expect.h"

namespace rowland::diffraction {
namespace {

using ::testing::HasSubstr;

struct Texel {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
};

/// Four patches of different directions and pitches.
constexpr Texel kPatches[] = {{0, 128}, {60, 180}, {130, 100}, {200, 220}};

class Grooves : public GratingPicture {
 protected:
    Grooves() {
        mesh_ = flat_triangle();
        for (std::size_t i = 0; i < 3; ++i)
            mesh_.uvs[i] = {0.5F + 0.45F * mesh_.positions[i].x, 0.5F - 0.45F * mesh_.positions[i].y};
    }

    /// A picture of so many texels across, filtered or not.
    std::shared_ptr<const GrooveMap> map_of(std::span<const Texel> texels, int width, const GrooveTexture& use = {},
                                            bool filtered = false) {
        auto picture = std::make_shared<image::ByteImage>();
        picture->width = width;
        picture->height = static_cast<int>(texels.size()) / width;
        for (const Texel& texel : texels)
            picture->rgba.insert(picture->rgba.end(), {texel.red, texel.green, std::uint8_t{0}, std::uint8_t{255}});
        scene_.images = {picture};
        scene_.textures = {{.nearest = !filtered, .mipmaps = filtered}};
        render::SurfaceTextures textures(scene_);
        return std::make_shared<const GrooveMap>(use, textures, "scene.gltf", "/grooveTexture");
    }
    static Material material(const std::string& grating, const std::string& quality) {
        return parse_material(parse_json("{\"grating\":" + grating + ",\"quality\":" + quality + "}", "test"), "test");
    }
    CookedMaterial cook_with(const std::string& grating, const std::string& quality, const GrooveMap& map) {
        return bake_material(suited_to_grooves(material(grating, quality), map.pitches()));
    }
    void show_with(const CookedMaterial& cooked, std::shared_ptr<const GrooveMap> map, double rotation) {
        show(cooked, rotation);
        world_.add(entity_, DiffractionSurface{material_, static_cast<float>(rotation), std::move(map)});
    }

    /// A pixel as the patches turn it, and its pitch's factor; nothing within a thousandth of a patch's rim.
    struct Turned {
        Point point;
        double pitch = 1.0;
    };
    std::optional<Turned> on_patches(const Point& point, std::span<const Texel, 4> patches = kPatches) const {
        glm::dvec2 uv(0.0);
        for (std::size_t i = 0; i < 3; ++i) uv += point.weights[static_cast<int>(i)] * glm::dvec2(mesh_.uvs[i]);
        const glm::dvec2 place = 2.0 * uv;
        for (int axis = 0; axis < 2; ++axis)
            if (std::abs(place[axis] - std::round(place[axis])) < 1e-3) return std::nullopt;
        const auto wrapped = [](double at) { return (static_cast<int>(std::floor(at)) % 2 + 2) % 2; };
        const Texel& texel = patches[static_cast<std::size_t>(2 * wrapped(place.y) + wrapped(place.x))];
        return turned_by(point, texel);
    }
    static Turned turned_by(const Point& point, const Texel& texel) {
        const double angle = std::numbers::pi * texel.red / 255.0;
        const glm::dvec2 turn(std::cos(angle), std::sin(angle));
        Turned turned{.point = point, .pitch = 2.0 * texel.green / 255.0};
        const glm::dmat3 axes = glm::transpose(point.to_tangent);
        turned.point.to_tangent = glm::transpose(
            glm::dmat3(turn.x * axes[0] + turn.y * axes[1], turn.x * axes[1] - turn.y * axes[0], axes[2]));
        turned.point.view = turned.point.to_tangent * (axes * point.view);
        for (Point::Change* change : {&turned.point.beside, &turned.point.below}) {
            change->g = turn.x * change->g + turn.y * change->h;
            change->view.x = glm::dot(turn, change->view);
        }
        return turned;
    }
    /// The mean over texels of what each would show, at some pixels; NaN elsewhere.
    AtPoint mean_over(const std::vector<Texel>& texels, const std::function<glm::dvec3(const Turned&)>& radiance) {
        return [&texels, radiance, pixel = 0](const Point& point) mutable {
            if (++pixel % 41 != 0) return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
            glm::dvec3 sum(0.0);
            for (const Texel& texel : texels) sum += radiance(turned_by(point, texel));
            return sum / static_cast<double>(texels.size());
        };
    }
    /// Key lights without tables, which know one pitch.
    glm::dvec3 key_lights(const CookedMaterial& cooked, const Turned& turned) const {
        DirectMaterial material = direct_material(cooked);
        material.pitch_nm *= turned.pitch;
        const Point& point = turned.point;
        glm::dvec3 xyz(0.0);
        for (const lighting::KeyLight& key : light_.key_lights)
            xyz += direct_radiance(smoothed(cooked), material, light_spot(key, point.to_tangent),
                                   DirectView{point.view.x, point.view.y, footprint(point, key.direction)});
        return xyz;
    }
    glm::dvec3 rest(const CookedMaterial& cooked, const Turned& turned) const {
        const auto& table = std::get<ArcTable>(cooked.tables);
        const lighting::ShLight light = lighting::limit_bands(light_.residual, table.bands);
        lighting::ShLight rotated = light;
        math::ShRotation(turned.point.to_tangent, table.bands)
            .apply(std::span<const glm::dvec3>(light.coefficients), rotated.coefficients);
        return evaluate(table, rotated, turned.point.view, turned.pitch);
    }
    /// NaN on the patches' rims, which passes over a pixel: it is never the largest difference.
    AtPoint at_patches(std::function<glm::dvec3(const Turned&)> radiance) const {
        return [this, radiance = std::move(radiance)](const Point& point) {
            const auto turned = on_patches(point);
            return turned ? radiance(*turned) : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
        };
    }

    scene::ImportedScene scene_;
};

constexpr const char* kFlatFoil = R"({"pitch_nm": 1300, "profile": {"type": "sinusoidal", "depth_nm": 150}})";

TEST_F(Grooves, PatchesOfAFlatCardEqualTheCpu) {
    light_ = light_of(smooth_probe(), three_keys());
    const auto map = map_of(kPatches, 2);
    EXPECT_NEAR(map->pitches().smallest, 200.0 / 255.0, 1e-12);
    EXPECT_NEAR(map->pitches().largest, 440.0 / 255.0, 1e-12);
    const CookedMaterial cooked = cook_with(kFlatFoil, R"({"max_error": 0.05})", *map);
    EXPECT_EQ(std::get<ArcTable>(cooked.tables).rank, 12);
    show_with(cooked, map, 0.4);
    const AtPoint ambient = at_patches([&](const Turned& turned) { return rest(cooked, turned); });
    const AtPoint lights = at_patches([&](const Turned& turned) { return key_lights(cooked, turned); });
    expect_drawn(sum(ambient, lights));
    EXPECT_GT(compared_, 500);
    EXPECT_GT(brightest_, 0.02);
    // Neither part is small.
    EXPECT_GT(largest_difference(draw(), ambient), 0.05);
}

TEST_F(Grooves, LightsOfTheirOwnFollowThePatches) {
    light_ = light_of(smooth_probe(), three_keys());
    const auto map = map_of(kPatches, 2);
    const CookedMaterial cooked = cook_with(kFlatFoil, R"({"representation": "direct"})", *map);
    show_with(cooked, map, -0.7);
    // The kernel's rounding is multiplied with the pitch's factor, up to 1.73; .0022 found.
    expect_drawn(at_patches([&](const Turned& turned) { return key_lights(cooked, turned); }), nullptr,
                 1.73 * kPictureTolerance);
    EXPECT_GT(brightest_, 0.02);
}

TEST_F(Grooves, StreaksFollowThePatches) {
    const auto map = map_of(kPatches, 2);
    const CookedMaterial cooked = cook_with(R"({"pitch_nm": 1100, "profile": {"type": "sinusoidal", "depth_nm": 150},
                                                "groove_lobe": {"sigma": 0.06}})",
                                            R"({"representation": "streak", "map_resolution": 64})", *map);
    show_with(cooked, map, 0.2);
    const StreakTables& tables = std::get<StreakTables>(cooked.tables);
    const StreakMap lobes = fill_streak_map(*light_.probe_texels, tables.map);
    expect_drawn(at_patches([&](const Turned& turned) {
        Streak streak = tables.streak;
        streak.pitch_nm *= turned.pitch;
        return evaluate(streak, lobes, glm::transpose(turned.point.to_tangent), turned.point.view);
    }));
    EXPECT_GT(brightest_, 0.02);
}

/// On a mesh that is not flat the vertices take the map's rotation, but a pixel turns a direction that is interpolated,
/// not one that is interpolated turned: 1 %. On a flat one they are the same to the tolerance of halves.
TEST_F(Grooves, AMapOfOneRotationIsAGrooveRotation) {
    for (const bool flat : {false, true}) {
        mesh_ = flat ? flat_triangle() : crooked_triangle();
        // Vertices of one direction: between others, what pixels look up is not what vertices interpolate.
        if (flat) mesh_.tangents.assign(3, mesh_.tangents[0]);
        const Texel turned[] = {{85, 128}};
        const auto map = map_of(turned, 1);
        const CookedMaterial cooked = cook_with(kBlazed, R"({"representation": "arc", "key_lights": 0})", *map);
        show_with(cooked, map, 0.25);
        const std::vector<glm::vec4> by_map = draw();
        const double angle = 0.25 + std::numbers::pi / 3.0;
        world_.add(entity_, DiffractionSurface{material_, static_cast<float>(angle)});
        EXPECT_LT(largest_difference(draw(), by_map), flat ? kPictureTolerance : 1e-2) << flat;
        world_.add(entity_, DiffractionSurface{material_, 0.25F});
        EXPECT_GT(largest_difference(draw(), by_map), 0.05) << flat;
        world_.destroy(entity_);
    }
}

TEST_F(Grooves, WhereThePitchIsNothingThereIsNoGrating) {
    const Texel texels[] = {{0, 0}, {0, 0}, {0, 128}, {0, 128}};
    light_ = light_of(smooth_probe(), three_keys());
    const auto map = map_of(texels, 2);
    show_with(cook_with(kFlatFoil, R"({"max_error": 0.05})", *map), map, 0.0);
    int dark = 0;
    const std::vector<glm::vec4> pixels = draw();
    for (int row = 0; row < kSize; ++row)
        for (int column = 0; column < kSize; ++column) {
            const Point point = point_at(column, row);
            if (std::min({point.weights.x, point.weights.y, point.weights.z}) < 0.05) continue;
            double v = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
                v += point.weights[static_cast<int>(i)] * static_cast<double>(mesh_.uvs[i].y);
            if (std::abs(v - 0.5) < 0.05) continue;
            const float luminance = pixels[static_cast<std::size_t>(row * kSize + column)].y;
            EXPECT_EQ(luminance == 0.0F, v < 0.5) << luminance;
            dark += v < 0.5 ? 1 : 0;
        }
    EXPECT_GT(dark, 100);
}

TEST_F(Grooves, TextureTransformsAndTheSecondCoordinatesAreThoseOfTheEngine) {
    mesh_.uvs1 = mesh_.uvs;
    const auto plain = map_of(kPatches, 2);
    const CookedMaterial cooked = cook_with(kFlatFoil, R"({"representation": "arc"})", *plain);
    show_with(cooked, plain, 0.0);
    const std::vector<glm::vec4> expected = draw();
    // The map undoes what is done to the second coordinates: uv = offset + R (scale · uv1), R a quarter turn.
    for (glm::vec2& uv : mesh_.uvs1) uv = {2.0F * (0.25F - uv.y), 4.0F * (uv.x - 0.5F)};
    for (glm::vec2& uv : mesh_.uvs) uv = {0.1F, 0.1F};
    world_.add(entity_, render::make_mesh_instance(scene::Mesh(mesh_)));
    const GrooveTexture use{
        .index = 0, .tex_coord = 1, .offset = {0.5, 0.25}, .rotation = std::numbers::pi / 2.0, .scale = {0.5, 0.25}};
    world_.add(entity_, DiffractionSurface{material_, 0.0F, map_of(kPatches, 2, use)});
    const std::vector<glm::vec4> found = draw();
    int differ = 0;  // pixels on the patches' rims
    for (std::size_t i = 0; i < found.size(); ++i) differ += glm::distance(found[i], expected[i]) > 1e-5F ? 1 : 0;
    EXPECT_LT(differ, 20);
    EXPECT_GT(largest_difference(expected, std::vector<glm::vec4>(expected.size(), expected[0])), 0.1);
}

/// Directions and pitches that vary normally about a mean.
std::vector<Texel> rough_texels(int side) {
    std::mt19937 random(7);
    std::normal_distribution<double> red(70.0, 9.0);
    std::normal_distribution<double> green(128.0, 6.0);
    const auto byte = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 1.0, 255.0)); };
    std::vector<Texel> texels;
    for (int i = 0; i < side * side; ++i) texels.push_back({byte(red(random)), byte(green(random))});
    return texels;
}

constexpr int kRoughSide = 32;

/// Every pixel covers the whole picture, several times.
TEST_F(Grooves, APixelShowsTheMeanOfTheGroovesThatItCovers) {
    light_ = light_of(smooth_probe(), three_keys());
    for (glm::vec2& uv : mesh_.uvs) uv *= 300.0F;
    const std::vector<Texel> texels = rough_texels(kRoughSide);
    for (const char* grating : {kFlatFoil, kBlazed}) {
        SCOPED_TRACE(grating);
        const auto map = map_of(texels, kRoughSide, {}, true);
        const CookedMaterial cooked = cook_with(grating, R"({"representation": "direct"})", *map);
        show_with(cooked, map, 0.4);
        const auto wanted = mean_over(texels, [&](const Turned& turned) { return key_lights(cooked, turned); });
        expect_drawn(wanted, nullptr, 0.04);  // u is no normal distribution; .033 found
        EXPECT_GT(brightest_, 0.02);
        world_.add(entity_, DiffractionSurface{material_, 0.4F, map_of(texels, kRoughSide, {.sparkle = true}, true)});
        EXPECT_GT(largest_difference(draw(), wanted), 0.3);
        world_.destroy(entity_);
    }
}

TEST_F(Grooves, AmbientLightIsThatOfTheMeanOfTheGroovesThatAPixelCovers) {
    for (glm::vec2& uv : mesh_.uvs) uv *= 300.0F;
    const std::vector<Texel> texels = rough_texels(kRoughSide);
    const auto map = map_of(texels, kRoughSide, {}, true);
    const CookedMaterial cooked = cook_with(kFlatFoil, R"({"representation": "arc", "key_lights": 0})", *map);
    show_with(cooked, map, 0.4);
    const auto wanted = mean_over(texels, [&](const Turned& turned) { return rest(cooked, turned); });
    expect_drawn(wanted, nullptr, 0.03);
}

TEST_F(Grooves, ALevelOfMomentsIsTheirMean) {
    const std::vector<Texel> texels = rough_texels(kRoughSide);
    const auto map = map_of(texels, kRoughSide, {}, true);
    for (const bool even : {true, false}) {
        glm::dvec4 mean(0.0);
        for (const Texel& texel : texels) {
            const double angle = (even ? 2.0 : 1.0) * std::numbers::pi * texel.red / 255.0;
            const double inverse = map->pitches().smallest / (2.0 * texel.green / 255.0);
            mean += glm::dvec4(0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle), inverse, inverse * inverse);
        }
        mean /= static_cast<double>(texels.size());
        const gpu::Texture& moments = map->moments(even);
        const glm::vec4 last = moments.read({.level = moments.levels() - 1}).at(0);
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(last[i], mean[i], 1e-4) << even;  // rounded at each of five levels
    }
}

/// A map over the azimuth serves all directions, of the flat lobe all pitches as well. The map in the vertices' place
/// knows no texture.
TEST_F(Grooves, PlanarMapsOfAnyLobeServeAllDirections) {
    constexpr Texel kTurned[] = {{0, 128}, {60, 128}, {130, 128}, {200, 128}};
    for (const char* grating : {kFlatFoil, kFoil})
        for (const char* map_at : {"pixels", "vertices"}) {
            const bool flat = std::string(grating) == kFlatFoil;
            const auto map = map_of(flat ? kPatches : kTurned, 2);
            const std::string settings =
                R"({"representation": "planar", "key_lights": 0, "map_resolution": 32, "map_at": ")";
            const CookedMaterial cooked = cook_with(grating, settings + map_at + "\"}", *map);
            ASSERT_FALSE(groove_refusal(cooked.material, map->pitches()));
            show_with(cooked, map, 0.4);
            const auto& tables = std::get<PlanarTables>(cooked.tables);
            const glm::dvec3 normal = glm::transpose(vertex_frame(0))[2];
            const auto difference_from = [&](const auto& light_map) {
                const auto error = filter_error(light_map);
                const auto at = [](const auto& looked_up, const Turned& turned) {
                    const glm::dmat3 axes = glm::transpose(turned.point.to_tangent);
                    const ShadingPoint frame{.view = axes * turned.point.view, .normal = axes[2], .grating = axes[0]};
                    if constexpr (requires { looked_up.pitch; })
                        return sample(looked_up, frame, turned.pitch);
                    else
                        return sample(looked_up, frame);
                };
                const auto on_patch = [&](const auto& looked_up) {
                    return [&](const Point& point) {
                        const auto turned = on_patches(point, flat ? kPatches : kTurned);
                        return turned ? at(looked_up, *turned) : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
                    };
                };
                return largest_difference(draw(), on_patch(light_map), on_patch(error));
            };
            // The texture's angles have 8 bits, and the shader's turn of g is that of a float.
            const double difference =
                tables.lobe
                    ? difference_from(fill_lobe_map(*light_.texels,
                                                    LobeSpectrum(tables.lobe->pattern, tables.lobe->size.views), normal,
                                                    tables.lobe->size.azimuths))
                    : difference_from(fill_planar_map(*light_.texels, cooked.kernel, cooked.material.grating.pitch_nm,
                                                      normal, tables.size, cooked.zero_order_xyz));
            EXPECT_LT(difference, kPictureTolerance) << grating << map_at;
            EXPECT_GT(brightest_, 0.01);
        }
}

TEST_F(Grooves, WhatKnowsOneDirectionOrOnePitchIsRefusedByPlace) {
    const auto map = map_of(kPatches, 2);
    const auto refusal = [&](const std::string& grating, const std::string& quality) {
        return groove_refusal(material(grating, quality), map->pitches()).value_or(Refusal{}).key;
    };
    for (const char* name : {"spikes", "circle"})
        EXPECT_EQ(refusal(kFlatFoil, R"({"representation": ")" + std::string(name) + "\"}"), "quality/representation");
    EXPECT_EQ(refusal(kFlatFoil, R"({"representation": "planar"})"), "");
    for (const char* name : {"arc", "planar"})
        EXPECT_EQ(refusal(kFoil, R"({"representation": ")" + std::string(name) + "\"}"), "grooveTexture");
    EXPECT_EQ(refusal(R"({"pitch_nm": 1500, "profile": {"type": "slit", "width_nm": 700},
                            "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}}})",
                      R"({"representation": "streak"})"),
              "quality/representation");
    EXPECT_THAT(rowland::test::message_of([&] { map_of(kPatches, 2, {.index = 1}); }),
                HasSubstr("scene.gltf: /grooveTexture/index"));
    EXPECT_THAT(rowland::test::message_of([&] { map_of(kPatches, 2, {.index = 0, .tex_coord = 2}); }),
                HasSubstr("/grooveTexture/texCoord"));
}

}  // namespace
}  // namespace rowland::diffraction
