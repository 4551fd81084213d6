// Gratings under a cover (PHYSICS §10): every representation against the CPU, and what the cover itself reflects.

#include "tests/gpu/modules/diffraction/grating_picture.h"
#include "tests/gpu/render_test.h"

namespace rowland::diffraction {
namespace {

constexpr double kIor = 1.58;
constexpr double kRotation = 0.5;

/// Gratings of pitches of their own: smoothed kernels are kept by the pitch.
constexpr const char* kPressed =
    R"({"pitch_nm": 1610, "profile": {"type": "lamellar", "duty": 0.35, "depth_nm": 130}})";
constexpr const char* kPressedLobe = R"({"pitch_nm": 1010, "profile": {"type": "sinusoidal", "depth_nm": 150},
                                         "groove_lobe": {"sigma": 0.3}})";
constexpr const char* kPressedNarrow = R"({"pitch_nm": 1620, "profile": {"type": "slit", "width_nm": 700},
                                           "groove_lobe": {"sigma": 0.05}})";

class Covered : public GratingPicture {
 protected:
    Covered() { rotation_ = kRotation; }

    static CookedMaterial cook_covered(const std::string& grating, const std::string& quality) {
        return cook_material(parse_json(R"({"cover": {"ior": 1.58}, "base": {"color": [0, 0, 0]}, "grating": )" +
                                            grating + R"(, "quality": )" + quality + "}",
                                        "test"),
                             "test");
    }
    void expect_equal(const CookedMaterial& cooked, const AtPoint& under_it, const AtPoint& error = nullptr) {
        SCOPED_TRACE(testing::Message() << info(cooked.tables).name << " " << cooked.material.grating.pitch_nm);
        const auto seen = [&](const AtPoint& inner) {
            return [&inner](const Point& point) { return transmittance(kIor, point.view.z) * inner(point); };
        };
        show(cooked, kRotation);
        expect_drawn(seen(under_it), error ? AtPoint(seen(error)) : AtPoint());
        EXPECT_GT(compared_, 500);
        // The picture is that of the cover: without T(v_n) it is another.
        EXPECT_GT(largest_difference(draw(), under_it), 0.01);
    }
};

TEST_F(Covered, TablesEqualTheCpu) {
    const CookedMaterial arc = cook_covered(kPressed, R"({"representation": "arc", "key_lights": 0})");
    EXPECT_EQ(std::get<ArcTable>(arc.tables).grid.rows, 1);
    expect_equal(arc, arc_xyz(arc, light_.sh));
    const CookedMaterial lobe =
        cook_covered(kPressedLobe, R"({"representation": "arc", "key_lights": 0, "view_resolution": 10})");
    expect_equal(lobe, arc_xyz(lobe, light_.sh));
    const CookedMaterial spikes =
        cook_covered(kPressed, R"({"representation": "spikes", "bands": 3, "view_resolution": 10})");
    expect_equal(spikes, table_xyz<SpikeTable>(spikes, light_.sh));
}

/// With tables of the lobes, without them beside order 0, and with a lobe along the grooves.
TEST_F(Covered, KeyLightsEqualTheCpu) {
    light_ = light_of(smooth_probe(), three_keys());
    const char* const with_zero =
        R"({"pitch_nm": 1630, "profile": {"type": "slit", "width_nm": 700}, "orders": [0, 1]})";
    for (const char* grating : {kPressed, kPressedLobe}) {
        const CookedMaterial cooked = cook_covered(grating, R"({"representation": "direct"})");
        expect_equal(cooked, key_lights(cooked), key_lights_error(cooked));
    }
    const CookedMaterial windows = cook_covered(with_zero, R"({"representation": "direct"})");
    expect_equal(windows, sum(key_lights(windows),
                              [&](const Point& point) { return order_zero_xyz(windows, light_.key_lights, point); }));
}

TEST_F(Covered, MapsEqualTheCpu) {
    light_ = light_of(smooth_probe(), three_keys());
    const auto expect_map = [&](const CookedMaterial& cooked, const auto& map) {
        expect_equal(cooked, sum(map_xyz(map), key_lights(cooked)),
                     sum(map_xyz(filter_error(map)), key_lights_error(cooked)));
    };
    mesh_ = flat_triangle();
    const CookedMaterial circle = cook_covered(kPressed, R"({"representation": "circle", "map_resolution": 24})");
    EXPECT_EQ(std::get<CircleTables>(circle.tables).size.angles, 8);
    expect_map(circle, fill_circle_map(*light_.texels, circle.kernel, circle.material.grating.pitch_nm,
                                       std::get<CircleTables>(circle.tables).size, circle.zero_order_xyz,
                                       circle.material.grating.cover));
    const CookedMaterial planar = cook_covered(kPressed, R"({"representation": "planar", "map_resolution": 64})");
    expect_map(planar, fill_planar_map(*light_.texels, planar.kernel, planar.material.grating.pitch_nm,
                                       glm::transpose(vertex_frame(0))[2], std::get<PlanarTables>(planar.tables).size,
                                       planar.zero_order_xyz, planar.material.grating.cover));
}

TEST_F(Covered, AStreakEqualsTheCpu) {
    const CookedMaterial cooked = cook_covered(kPressedNarrow, R"({"representation": "streak", "map_resolution": 64})");
    const auto& tables = std::get<StreakTables>(cooked.tables);
    const StreakMap map = fill_streak_map(*light_.probe_texels, tables.map);
    expect_equal(cooked, [&](const Point& point) {
        return evaluate(tables.streak, map, glm::transpose(point.to_tangent), point.view,
                        cooked.material.grating.cover);
    });
}

CookedMaterial complete_mirror(bool covered) {
    return cook_complete(R"({"pitch_nm": 1640})", R"({"representation": "arc"})",
                         covered ? R"(, "cover": {"ior": 1.58})" : "");
}

class CoverGloss : public GratingPicture {
 protected:
    /// The grating has no light but the scene's own.
    CoverGloss() { light_ = black_light(); }

    void show_in_white(const CookedMaterial& cooked) {
        show(cooked, 0.5);
        image::Image image{.width = 64, .height = 32, .texels = std::vector(std::size_t{64} * 32, glm::vec3(1.0F))};
        renderer_->set_probe(
            lighting::build_light_probe(lighting::ProbeImage(std::move(image), lighting::Mapping::Equirectangular),
                                        {.prefilter = {.face_size = 16}}));
    }
};

/// F of the environment, and order 0 through the cover twice. Half floats of the environment: 1e-3.
TEST_F(CoverGloss, ReflectsTheEnvironmentOverOrderZero) {
    const CookedMaterial covered = complete_mirror(true);
    show_in_white(covered);
    const glm::dvec3 white = colour::rec709_to_xyz() * glm::dvec3(1.0);
    const glm::dvec3 mirror = layer_weights(covered.material.grating).mirror;
    EXPECT_NEAR(mirror.y, 0.4, 1e-3);
    const auto with_gloss = [&](const Point& point) {
        const double passed = transmittance(kIor, point.view.z);
        return (1.0 - passed + passed * passed * mirror) * white;
    };
    expect_drawn(with_gloss);
    EXPECT_GT(compared_, 500);
    use(complete_mirror(false));
    expect_drawn([&](const Point&) { return mirror * white; });
}

/// A directional light, and one at a point: T(s_n) T(v_n) through the kernel, and a GGX highlight of the cover's own F,
/// whose width of .01 amplifies the rounding of cosines near 1: 1e-3.
TEST_F(CoverGloss, LightsShineThroughItAndHaveHighlightsInIt) {
    const CookedMaterial covered = complete_mirror(true);
    show(covered, 0.5);
    const glm::dvec3 toward = glm::normalize(glm::vec3(0.5F, 0.4F, 1.0F));
    const glm::dvec3 from(0.9, 0.5, 1.6);
    world_.add(world_.create(), scene::DirectionalLight{.direction = glm::vec3(toward), .irradiance = glm::vec3(2.0F)});
    const ecs::Entity point_light = world_.create();
    world_.add(point_light, scene::PunctualLight{.intensity = glm::vec3(3.0F)});
    world_.add(point_light, scene::Transform{.translation = glm::vec3(from)});
    const glm::dvec3 white = colour::rec709_to_xyz() * glm::dvec3(1.0);
    const auto of_light = [&](const Point& point, const glm::dvec3& l, double irradiance, double half_pixel) {
        const glm::dvec3 n = glm::transpose(point.to_tangent)[2];
        const glm::dvec3 v = glm::transpose(point.to_tangent) * point.view;
        const double reflectance = 1.0 - transmittance(kIor, glm::dot(v, glm::normalize(l + v)));
        // A black dielectric's is 0.04 at normal incidence: its highlight over its Schlick term.
        const double schlick = 0.04 + 0.96 * std::pow(1.0 - glm::dot(v, glm::normalize(l + v)), 5.0);
        const glm::dvec3 highlight =
            rowland::test::reflected(l, n, v, glm::dvec3(0.0), 0.0, 0.1) / schlick * reflectance;
        const DirectLight light{.direction = l, .flux = glm::dvec3(irradiance)};
        return irradiance * highlight * white +
               transmittance(kIor, point.view.z) * direct_radiance(smoothed(covered), direct_material(covered),
                                                                   light_spot(light, point.to_tangent),
                                                                   DirectView{point.view.x, point.view.y, half_pixel});
    };
    const auto expected = [&](const Point& point) {
        const glm::dvec3 to_light = from - point.position;
        return of_light(point, toward, 2.0, footprint(point, toward)) + of_light(point, glm::normalize(to_light),
                                                                                 3.0 / glm::dot(to_light, to_light),
                                                                                 footprint_of_lamp(point, from));
    };
    expect_drawn(expected, nullptr, 2.0 * kPictureTolerance);
    EXPECT_GT(brightest_, 0.1);
}

/// Key lights and directional lights at the vertices: T(s_n) there, T(v_n) at the pixels.
TEST_F(Covered, LightsAtTheVerticesEqualTheCpu) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked =
        cook_covered(kPressedLobe, R"({"representation": "direct", "lights_at": "vertices"})");
    std::vector<glm::dvec3> shaded;
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        Point point;
        point.to_tangent = vertex_frame(vertex);
        point.view = vertex_view(vertex);
        shaded.push_back(key_light_xyz(cooked, light_.key_lights, point));
    }
    expect_equal(cooked, [&](const Point& point) { return mix(point, shaded); });
}

}  // namespace
}  // namespace rowland::diffraction
