// Analytic lights on the GPU against the CPU.

#include "tests/gpu/modules/diffraction/grating_picture.h"
#include "tests/gpu/render_test.h"

namespace rowland::diffraction {
namespace {

class Direct : public GratingPicture {
 protected:
    /// What the engine's own surface sends of a light with this irradiance (Rec.709) on what faces it.
    static glm::dvec3 base_xyz(const CookedMaterial& cooked, const Point& point, const glm::dvec3& l,
                               const glm::dvec3& irradiance, const glm::vec3& eye, double angular_radius = 0.0) {
        const glm::dvec3 n = glm::transpose(point.to_tangent)[2];
        const glm::dvec3 v = glm::normalize(glm::dvec3(eye) - point.position);
        const double roughness = static_cast<double>(cooked.material.base.roughness);
        return layer_weights(cooked.material.grating).base *
               rowland::test::reflected(l, n, v, glm::dvec3(0.0), 0.0, roughness, angular_radius) *
               (colour::rec709_to_xyz() * irradiance);
    }
    /// By the smoothed kernel; `half_pixel`: footprint().
    static glm::dvec3 small_light_xyz(const CookedMaterial& cooked, const Point& point, const glm::dvec3& l,
                                      const glm::dvec3& irradiance, double half_pixel, double angular_radius = 0.0) {
        const double mean_cosine = std::pow(std::cos(0.5 * angular_radius), 2.0);
        const DirectLight light{.direction = l, .flux = irradiance / mean_cosine, .angular_radius = angular_radius};
        return direct_radiance(smoothed(cooked), direct_material(cooked), light_spot(light, point.to_tangent),
                               DirectView{point.view.x, point.view.y, half_pixel});
    }
};

constexpr const char* kDirect = R"({"representation": "direct"})";

TEST_F(Direct, KeyLightsEqualTheCpuWithTheSmoothedKernel) {
    std::vector<lighting::KeyLight> keys = three_keys();
    keys[2].concentration = lighting::kNarrowestConcentration;
    light_ = light_of(smooth_probe(), keys);
    for (const char* grating : {kSlitCd, kBlazed, kFoil}) {
        SCOPED_TRACE(grating);
        const CookedMaterial cooked = cook(grating, kDirect);
        show(cooked, 0.5);
        expect_drawn(key_lights(cooked), key_lights_error(cooked));
    }
}

/// Seen from afar a pixel is narrower than the sun, whose light is then as narrow on the picture as in 𝒦.
TEST_F(Direct, ASunSeenFromAfarIsTheSumOverItsSlices) {
    mesh_ = flat_triangle();
    mesh_.tangents.assign(3, {1.0F, 0.0F, 0.0F, 1.0F});
    transform_ = {};
    camera_ = {.eye = {0.0F, 0.0F, 40.0F}, .vertical_field_of_view = 0.05F};
    std::uint64_t version = 1;
    for (const char* grating : {kSlitCd, kFoil}) {
        const CookedMaterial cooked = cook(grating, kDirect);
        const double s_g = 550.0 / cooked.material.grating.pitch_nm;  // of green light
        const lighting::KeyLight sun{{s_g, 0.2, std::sqrt(0.96 - s_g * s_g)}, {1.0, 0.9, 0.8}, 1.6e5};
        light_ = light_of(smooth_probe(), {sun}, ++version);
        SCOPED_TRACE(grating);
        show(cooked);
        // Measured: .0011 and .0010; .0048 under the first if the kernel's table begins at 4 nm.
        expect_drawn([&](const Point& point) {
            return direct_radiance(cooked.kernel, direct_material(cooked), light_spot(sun, point.to_tangent),
                                   {point.view.x, point.view.y, footprint(point, sun.direction)});
        });
    }
}

/// Shading at the vertices is interpolated between them, also that of directional lights without shadows.
TEST_F(Direct, LightsAtTheVerticesAreInterpolated) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kFoil, R"({"representation": "direct", "lights_at": "vertices"})");
    show(cooked, 0.5);
    const glm::dvec3 toward = glm::normalize(glm::dvec3(0.3, 0.2, 0.9));
    const glm::dvec3 irradiance(0.05);
    world_.add(world_.create(), scene::DirectionalLight{.direction = toward, .irradiance = irradiance});
    std::vector<glm::dvec3> shaded;
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        Point point;
        point.to_tangent = vertex_frame(vertex);
        point.view = vertex_view(vertex);
        shaded.push_back(key_light_xyz(cooked, light_.key_lights, point) +
                         small_light_xyz(cooked, point, toward, irradiance, 0.0));
    }
    expect_drawn([&](const Point& point) {
        return mix(point, shaded) + base_xyz(cooked, point, toward, irradiance, camera_.eye);
    });
    EXPECT_GT(largest_difference(draw(), key_lights(cooked)), 0.1);  // three vertices are far too few
}

TEST_F(Direct, PitsEqualTheCpu) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kPits, kDirect);
    show(cooked, 0.1);
    expect_drawn(key_lights(cooked));
}

/// The shader leaves out what an order has beyond four deviations.
TEST_F(Direct, APitSequenceEqualsTheCpu) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kPitSequence, kDirect);
    show(cooked, 0.1);
    expect_drawn(key_lights(cooked));
}

/// Order 0 is a delta function of u.
TEST_F(Direct, OrderZeroShowsTheLobesThemselves) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked =
        cook(R"({"pitch_nm": 1601, "profile": {"type": "slit", "width_nm": 700}, "orders": [-1, 0, 1]})", kDirect);
    show(cooked, 0.5);
    const AtPoint expected =
        sum(key_lights(cooked), [&](const Point& point) { return order_zero_xyz(cooked, light_.key_lights, point); });
    expect_drawn(expected);
    CookedMaterial without = cooked;
    without.zero_order_xyz = glm::dmat3(0.0);
    use(without);
    EXPECT_GT(largest_difference(draw(), expected), 0.1);
}

/// A kernel for each view: of key lights by tables, and with order 0 by windows, and of a directional light.
TEST_F(Direct, RigorousEfficienciesEqualTheCpu) {
    const glm::dvec3 l = glm::normalize(glm::vec3(0.5F, 0.4F, 1.0F));
    const ecs::Entity lamp = world_.create();
    light_ = light_of(smooth_probe(), three_keys());
    for (const char* orders : {"[-1, 1]", "[-1, 0, 1]"}) {
        SCOPED_TRACE(orders);
        const std::string grating = R"({"pitch_nm": )" + std::to_string(900 + std::strlen(orders)) +
                                    R"(, "profile": {"type": "lamellar", "duty": 0.4, "depth_nm": 140},
                "theory": "rigorous", "orders": )" +
                                    std::string(orders) + "}";
        CookedMaterial cooked = cook(grating, kDirect, R"(,"metal": "Ag")");
        cooked.zero_order_xyz *= 0.01;  // the windows are drawn, and order 0 does not outshine the others
        show(cooked, 0.5);
        const bool windows = cooked.zero_order_xyz != glm::dmat3(0.0);
        if (windows)
            world_.destroy(lamp);  // whose own order 0 small_light_xyz() has not
        else
            world_.add(lamp, scene::DirectionalLight{.direction = glm::vec3(l), .irradiance = glm::vec3(1.0F)});
        const auto expected = [&](const CookedMaterial& material) {
            return [&](const Point& point) {
                glm::dvec3 xyz = key_light_xyz(material, light_.key_lights, point) +
                                 order_zero_xyz(material, light_.key_lights, point);
                if (!windows)
                    xyz += small_light_xyz(material, point, l, glm::dvec3(1.0), footprint(point, l)) +
                           base_xyz(material, point, l, glm::dvec3(1.0), camera_.eye);
                return xyz;
            };
        };
        // Measured: .0044, as the kernel of many views has fewer columns and levels; by the windows .0019.
        expect_drawn(expected(cooked), key_lights_error(cooked), 3.0 * kPictureTolerance);
        CookedMaterial at_normal_incidence = cooked;
        at_normal_incidence.kernel = tabulate(ColourKernel(cooked.material.grating, colour::LightSpectra()));
        EXPECT_GT(largest_difference(draw(), expected(at_normal_incidence)), 0.05);
        EXPECT_GT(brightest_, 0.02);
    }
}

TEST_F(Direct, DiscsEqualTheCpu) {
    const glm::dvec3 l = glm::normalize(glm::vec3(0.5F, 0.4F, 1.0F));
    // The CPU's three nodes along the grooves resolve the coherent part of pits for small discs alone.
    const std::pair<const char*, double> cases[] = {{kSlitCd, 0.06}, {kFoil, 0.06}, {kPits, 0.02}};
    const ecs::Entity lamp = world_.create();
    for (const auto& [grating, radius] : cases) {
        SCOPED_TRACE(grating);
        const CookedMaterial cooked = cook(grating, kDirect);
        show(cooked, 0.5);
        world_.add(lamp, scene::DirectionalLight{.direction = glm::vec3(l),
                                                 .irradiance = glm::vec3(1.0F),
                                                 .angular_radius = static_cast<float>(radius)});
        const auto expected = [&](double drawn_radius) {
            return [&, drawn_radius](const Point& point) {
                return small_light_xyz(cooked, point, l, glm::dvec3(1.0), footprint(point, l), drawn_radius) +
                       base_xyz(cooked, point, l, glm::dvec3(1.0), camera_.eye, drawn_radius);
            };
        };
        expect_drawn(expected(radius));
        EXPECT_GT(brightest_, 0.02);
        EXPECT_GT(largest_difference(draw(), expected(0.0)), 0.05);
    }
}

/// The kernel has a layer for each colour, and is rebuilt when the colours change.
TEST_F(Direct, LightsOfOtherColoursEqualTheCpu) {
    const CookedMaterial cooked = cook(kSlitCd, kDirect);
    show(cooked, 0.5);
    const glm::dvec3 directions[] = {glm::normalize(glm::vec3(0.5F, 0.4F, 1.0F)),
                                     glm::normalize(glm::vec3(-0.6F, 0.2F, 0.8F))};
    for (const glm::dvec3& colour : {glm::dvec3(1.0, 0.2, 0.1), glm::dvec3(0.1, 0.3, 2.0)}) {
        const glm::dvec3 irradiances[] = {glm::dvec3(1.0), colour};
        std::vector<ecs::Entity> lights;
        for (int i = 0; i < 2; ++i) {
            lights.push_back(world_.create());
            world_.add(lights.back(), scene::DirectionalLight{.direction = glm::vec3(directions[i]),
                                                              .irradiance = glm::vec3(irradiances[i])});
        }
        const auto expected = [&](const Point& point) {
            glm::dvec3 xyz(0.0);
            for (int i = 0; i < 2; ++i)
                xyz += small_light_xyz(cooked, point, directions[i], irradiances[i], footprint(point, directions[i])) +
                       base_xyz(cooked, point, directions[i], irradiances[i], camera_.eye);
            return xyz;
        };
        expect_drawn(expected);
        EXPECT_GT(brightest_, 0.05);
        for (const ecs::Entity light : lights) world_.destroy(light);
    }
}

/// Points and spots are no part of a probe: every representation shades them one by one.
TEST_F(Direct, PointLightsShineOnEveryRepresentation) {
    constexpr float kRadius_m = 0.08F;
    const glm::vec3 position(0.9F, 0.5F, 1.6F);
    const glm::dvec3 intensity(3.0, 2.0, 1.5);
    const char* const qualities[] = {kDirect, R"({"representation": "spikes"})",
                                     R"({"representation": "arc", "key_lights": 0})",
                                     R"({"representation": "circle", "map_resolution": 16})"};
    light_ = black_light();
    const ecs::Entity lamp = world_.create();
    world_.add(lamp, scene::PunctualLight{.intensity = glm::vec3(intensity), .radius_m = kRadius_m});
    world_.add(lamp, scene::Transform{.translation = position});
    for (const char* quality : qualities) {
        SCOPED_TRACE(quality);
        const CookedMaterial cooked = cook(kSlitCd, quality);
        show(cooked, 0.5);
        expect_drawn([&](const Point& point) {
            const glm::dvec3 to_light = glm::dvec3(position) - point.position;
            const glm::dvec3 l = glm::normalize(to_light);
            const glm::dvec3 irradiance = intensity / glm::dot(to_light, to_light);
            const double radius = std::asin(static_cast<double>(kRadius_m) / glm::length(to_light));
            return small_light_xyz(cooked, point, l, irradiance, footprint_of_lamp(point, position), radius) +
                   base_xyz(cooked, point, l, irradiance, camera_.eye, radius);
        });
        EXPECT_GT(brightest_, 0.05);
    }
}

}  // namespace
}  // namespace rowland::diffraction
