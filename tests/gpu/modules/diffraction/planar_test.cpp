// A flat grating's map: against the CPU's, and when it is filled.
#include <gtest/gtest.h>

#include "modules/diffraction/representations/planar/gpu_planar.h"
#include "tests/gpu/modules/diffraction/filter_error.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

class Planar : public GratingPicture {
 protected:
    Planar() { mesh_ = flat_triangle(); }

    const PlanarData& data() { return static_cast<const PlanarData&>(*world_.get<SurfaceState>(entity_).data); }
    PlanarMap map(const CookedMaterial& cooked) const {
        const glm::dvec3 normal = glm::transpose(vertex_frame(0))[2];
        return fill_planar_map(*light_.texels, cooked.kernel, cooked.material.grating.pitch_nm, normal,
                               std::get<PlanarTables>(cooked.tables).size, cooked.zero_order_xyz);
    }
    static glm::dvec3 at(const PlanarMap& map, const Point& point) {
        const glm::dmat3 axes = glm::transpose(point.to_tangent);
        return sample(map, ShadingPoint{.view = axes * point.view, .normal = axes[2], .grating = axes[0]});
    }
    double difference_from(const PlanarMap& expected, const std::vector<glm::vec4>& pixels) {
        const PlanarMap error = filter_error(expected);
        return largest_difference(
            pixels, [&](const Point& point) { return at(expected, point); },
            [&](const Point& point) { return at(error, point); });
    }
};

constexpr const char* kPlanar = R"({"representation": "planar", "map_resolution": 64})";

TEST_F(Planar, PixelsEqualTheCpusMap) {
    for (const char* grating : {kSlitCd, kBlazed}) {
        const CookedMaterial cooked = cook(grating, kPlanar);
        if (!renderer_) show(cooked, 0.7);
        use(cooked);
        EXPECT_LT(difference_from(map(cooked), draw()), kMapTolerance);
        EXPECT_TRUE(data().on_gpu.has_value());
        EXPECT_GT(brightest_, 0.01);
    }
}

/// With lights at the pixels and, in one value with the map, at the vertices.
TEST_F(Planar, AMapAtTheVerticesIsInterpolated) {
    light_ = light_of(smooth_probe(), three_keys());
    for (const char* lights_at : {"pixels", "vertices"}) {
        const std::string quality = R"({"representation": "planar", "map_resolution": 64, "map_at": "vertices",
            "lights_at": ")";
        const CookedMaterial cooked = cook(kSlitCd, quality + lights_at + "\"}");
        if (!renderer_) show(cooked, 0.7);
        use(cooked);
        const PlanarMap expected = map(cooked);
        const PlanarMap error = filter_error(expected);
        expect_map_at_vertices(
            cooked, [&](const Point& point) { return at(expected, point); },
            [&](const Point& point) { return at(error, point); });
    }
}

TEST_F(Planar, KeyLightsComeOnTop) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kSlitCd, kPlanar);
    show(cooked, -0.3);
    const PlanarMap expected = map(cooked);
    const PlanarMap error = filter_error(expected);
    EXPECT_LT(
        largest_difference(
            draw(),
            [&](const Point& point) { return at(expected, point) + key_light_xyz(cooked, light_.key_lights, point); },
            [&](const Point& point) { return at(error, point) + key_light_error(cooked, light_.key_lights, point); }),
        kPictureTolerance);
}

/// Without analytic lights the map holds the whole probe, and nothing is added to it.
TEST_F(Planar, KeyLightsMayStayInTheMap) {
    light_ = light_of(smooth_probe(), three_keys());
    light_.probe_texels = light_.texels;
    light_.texels = std::make_shared<const lighting::LightSamples>();
    light_.probe_sh = light_.residual;
    const CookedMaterial cooked =
        cook(kSlitCd, R"({"representation": "planar", "map_resolution": 64, "key_lights": false})");
    show(cooked, -0.3);
    const std::vector<glm::vec4> drawn = draw();
    EXPECT_TRUE(data().on_gpu.has_value());
    light_.texels = light_.probe_texels;
    EXPECT_LT(difference_from(map(cooked), drawn), kMapTolerance);
    EXPECT_GT(brightest_, 0.01);
}

TEST_F(Planar, GrazingViewsEqualTheCpu) {
    transform_.rotation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    camera_.eye = {0.5F, -2.5F, 0.02F};
    const CookedMaterial cooked = cook(kSlitCd, kPlanar);
    show(cooked, 0.2);
    EXPECT_LT(difference_from(map(cooked), draw()), kMapTolerance);
    EXPECT_GT(compared_, 5);
}

TEST_F(Planar, ATurnAboutTheNormalFillsNothing) {
    transform_.rotation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    const CookedMaterial cooked = cook(kSlitCd, kPlanar);
    show(cooked);
    draw();
    EXPECT_EQ(data().fills_begun, 1);
    EXPECT_EQ(data().azimuths_filled, 64);
    for (int step = 1; step < 5; ++step) {
        transform_.rotation = glm::angleAxis(0.3F * static_cast<float>(step), glm::vec3(0.0F, 0.0F, 1.0F));
        const std::vector<glm::vec4> pixels = draw();
        EXPECT_EQ(data().fills_begun, 1);
        EXPECT_EQ(data().azimuths_filled, 64);
        EXPECT_LT(difference_from(map(cooked), pixels), kMapTolerance);
    }
}

TEST_F(Planar, AChangeOfSceneLightsFillsNothing) {
    show(cook(kSlitCd, kPlanar));
    draw();
    ++light_.version;  // the same texels
    draw();
    EXPECT_EQ(data().fills_begun, 1);
}

TEST_F(Planar, ATiltFillsByAndByWhileTheArcTableStandsIn) {
    const CookedMaterial cooked = cook(kSlitCd, kPlanar);
    show(cooked, 0.0, 24);
    const auto arc = [&](const std::string& key_lights) {
        const std::string quality = R"({"representation": "arc", "key_lights": )" + key_lights + "}";
        const auto planar = material_;
        use(cook(kSlitCd, quality));
        std::vector<glm::vec4> pixels = draw();
        material_ = planar;
        world_.add(entity_, DiffractionSurface{material_, 0.0F});
        return pixels;
    };
    const std::vector<glm::vec4> stand_in = arc("true");
    EXPECT_EQ(draw(), stand_in);  // 24 azimuths
    EXPECT_EQ(draw(), stand_in);  // 48
    EXPECT_NE(draw(), stand_in);  // 64: the map
    EXPECT_EQ(data().fills_begun, 1);
    EXPECT_EQ(data().azimuths_filled, 64);

    // While it moves nothing is filled.
    for (int step = 1; step < 4; ++step) {
        transform_.rotation = glm::angleAxis(0.1F * static_cast<float>(step), glm::vec3(1.0F, 0.0F, 0.0F));
        draw();
        EXPECT_FALSE(data().on_gpu.has_value());
        EXPECT_EQ(data().azimuths_filled, 64);
    }
    for (const int filled : {24, 48, 64}) {
        draw();
        EXPECT_EQ(data().azimuths_filled, 64 + filled);
    }
    EXPECT_EQ(data().fills_begun, 2);
    EXPECT_LT(difference_from(map(cooked), draw()), kMapTolerance);
    EXPECT_EQ(data().azimuths_filled, 128);

    // The probe turns.
    light_.texels = std::make_shared<const lighting::LightSamples>(*light_.texels);
    ++light_.version;
    for (int frame = 0; frame < 5; ++frame) draw();
    EXPECT_EQ(data().fills_begun, 3);
    EXPECT_EQ(data().azimuths_filled, 192);
}

TEST_F(Planar, AMeshThatIsNotFlatIsShadedAsArc) {
    mesh_ = crooked_triangle();
    show(cook(kSlitCd, kPlanar));
    const std::vector<glm::vec4> planar = draw();
    EXPECT_EQ(data().fills_begun, 0);
    use(cook(kSlitCd, R"({"representation": "arc"})"));
    EXPECT_EQ(draw(), planar);
}

/// Lobes that are not flat: volume maps that another thread fills.
class PlanarLobes : public Planar {
 protected:
    const LobeFilling& filling() { return data().lobe; }
    static LobeMap map(const CookedMaterial& cooked, const glm::dvec3& normal, const LobeMapSize& size,
                       const lighting::LightSamples& texels) {
        return fill_lobe_map(texels, LobeSpectrum(std::get<PlanarTables>(cooked.tables).lobe->pattern, size.views),
                             normal, size.azimuths);
    }
    LobeMap full_map(const CookedMaterial& cooked) const {
        return map(cooked, glm::transpose(vertex_frame(0))[2], std::get<PlanarTables>(cooked.tables).lobe->size,
                   *light_.texels);
    }
    double difference_from(const LobeMap& expected, const std::vector<glm::vec4>& pixels) {
        const LobeMap error = filter_error(expected);
        const auto at = [](const LobeMap& looked_up, const Point& point) {
            const glm::dmat3 axes = glm::transpose(point.to_tangent);
            return sample(looked_up, ShadingPoint{.view = axes * point.view, .normal = axes[2], .grating = axes[0]});
        };
        return largest_difference(
            pixels, [&](const Point& point) { return at(expected, point); },
            [&](const Point& point) { return at(error, point); });
    }
};

constexpr const char* kPitsDisc = R"({"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800},
                                    "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}}})";
constexpr const char* kBlazedLobe = R"({"pitch_nm": 1210, "profile": {"type": "blazed", "depth_nm": 250},
                                        "orders": [-1, 1, 2], "groove_lobe": {"sigma": 0.1}})";
constexpr const char* kSmallLobeMap = R"("map_resolution": 32, "views_h": 24)";

TEST_F(PlanarLobes, PixelsEqualTheCpusMap) {
    for (const char* grating : {kFoil, kPitsDisc, kBlazedLobe}) {
        const CookedMaterial cooked = cook_planar(grating, kSmallLobeMap);
        if (!renderer_) show(cooked, 0.7);
        use(cooked);
        EXPECT_LT(difference_from(full_map(cooked), draw()), kMapTolerance) << grating;
        EXPECT_TRUE(filling().is_complete());
        EXPECT_GT(brightest_, 0.01);
    }
}

TEST_F(PlanarLobes, AMapAtTheVerticesIsInterpolated) {
    const CookedMaterial cooked = cook_planar(kFoil, R"("map_resolution": 32, "map_at": "vertices")");
    show(cooked, 0.7);
    const LobeMap expected = full_map(cooked);
    const LobeMap error = filter_error(expected);
    const auto at = [](const LobeMap& looked_up, const Point& point) {
        const glm::dmat3 axes = glm::transpose(point.to_tangent);
        return sample(looked_up, ShadingPoint{.view = axes * point.view, .normal = axes[2], .grating = axes[0]});
    };
    expect_map_at_vertices(
        cooked, [&](const Point& point) { return at(expected, point); },
        [&](const Point& point) { return at(error, point); });
}

/// A frame uploads a part of the full map only: first the stand-in is shown, then the coarse map, then the full one.
TEST_F(PlanarLobes, ACoarseMapIsShownUntilTheFullOneIsThere) {
    // The programs of all lobes' maps are the same: with them compiled, frames are short beside the fill.
    show(cook_planar(kFoil, kSmallLobeMap), 0.3, 1);
    draw();
    while (!filling().is_complete()) draw();

    const CookedMaterial cooked = cook_planar(kFoil, R"("map_resolution": 96)");
    use(cooked);
    const std::vector<glm::vec4> stand_in = draw();
    EXPECT_FALSE(filling().has_map());
    EXPECT_TRUE(maps_are_filling(world_));
    std::vector<glm::vec4> pixels = stand_in;
    while (!filling().has_map()) pixels = draw();
    EXPECT_NE(pixels, stand_in);
    // On a busy machine the full map may be there as soon.
    if (!filling().is_complete()) {
        const glm::dvec3 normal = glm::transpose(vertex_frame(0))[2];
        EXPECT_LT(difference_from(map(cooked, normal, kCoarseLobeMap, *light_.texels), pixels), kMapTolerance);
        EXPECT_TRUE(maps_are_filling(world_));
    }
    while (!filling().is_complete()) pixels = draw();
    EXPECT_LT(difference_from(full_map(cooked), pixels), kMapTolerance);
    EXPECT_FALSE(maps_are_filling(world_));
    EXPECT_EQ(filling().fills_begun(), 1);

    // A rotation about the normal and another version of the same light need no other map.
    ++light_.version;
    draw();
    EXPECT_EQ(filling().fills_begun(), 1);
}

/// While an object turns, coarse maps follow it: the last one is shown, never the stand-in.
TEST_F(PlanarLobes, CoarseMapsFollowATurningObject) {
    const CookedMaterial cooked = cook_planar(kFoil, R"("map_resolution": 64)");
    show(cooked, 0.3, 1);
    draw();
    while (!filling().has_map()) draw();
    for (int step = 1; filling().fills_begun() < 4 && step < 100000; ++step) {
        transform_.rotation = glm::angleAxis(0.001F * static_cast<float>(step), glm::vec3(1.0F, 0.0F, 0.0F));
        draw();
        EXPECT_TRUE(filling().has_map());
    }
    EXPECT_GE(filling().maps_shown(), 3);
    while (!filling().is_complete()) draw();
    EXPECT_LT(difference_from(full_map(cooked), draw()), kMapTolerance);
}

TEST_F(PlanarLobes, AMeshThatIsNotFlatIsShadedAsArc) {
    mesh_ = crooked_triangle();
    const CookedMaterial cooked = cook_planar(kFoil, kSmallLobeMap);
    show(cooked);
    const std::vector<glm::vec4> planar = draw();
    EXPECT_EQ(filling().fills_begun(), 0);
    CookedMaterial arc = cooked;
    arc.tables = std::get<PlanarTables>(cooked.tables).stand_in;
    use(arc);
    EXPECT_EQ(draw(), planar);
}

}  // namespace
}  // namespace rowland::diffraction
