// A flat grating's map: against the CPU's, and when it is filled.

#include "modules/diffraction/runtime/gpu_representations.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

class Planar : public GratingPicture {
 protected:
    Planar() { mesh_ = flat_triangle(); }

    const ObjectMap& shown_map() { return world_.get<SurfaceState>(entity_).map; }
    PlanarMap map(const CookedMaterial& cooked, const PlanarMapSize& size) const {
        const glm::dvec3 normal = glm::transpose(vertex_frame(0))[2];
        return fill_planar_map(*light_.texels, cooked.kernel, cooked.material.grating.pitch_nm, normal, size,
                               cooked.zero_order_xyz);
    }
    PlanarMap map(const CookedMaterial& cooked) const {
        return map(cooked, std::get<PlanarTables>(cooked.tables).size);
    }
};

constexpr const char* kPlanar = R"({"representation": "planar", "map_resolution": 64})";

TEST_F(Planar, PixelsEqualTheCpusMap) {
    for (const char* grating : {kSlitCd, kBlazed}) {
        const CookedMaterial cooked = cook(grating, kPlanar);
        SCOPED_TRACE(grating);
        show(cooked, 0.7);
        expect_map(map(cooked));
        EXPECT_FALSE(shown_map().is_filling());
    }
}

/// With lights at the pixels and, in one value with the map, at the vertices.
TEST_F(Planar, AMapAtTheVerticesIsInterpolated) {
    light_ = light_of(smooth_probe(), three_keys());
    for (const char* lights_at : {"pixels", "vertices"}) {
        const std::string quality = R"({"representation": "planar", "map_resolution": 64, "map_at": "vertices",
            "lights_at": ")";
        const CookedMaterial cooked = cook(kSlitCd, quality + lights_at + "\"}");
        show(cooked, 0.7);
        expect_map_at_vertices(cooked, map(cooked));
    }
}

/// Without analytic lights the map holds the whole probe, and nothing is added to it.
TEST_F(Planar, KeyLightsMayStayInTheMap) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked =
        cook(kSlitCd, R"({"representation": "planar", "map_resolution": 64, "key_lights": 0})");
    show(cooked, -0.3);
    light_.texels = light_.probe_texels;
    expect_map(map(cooked));
}

TEST_F(Planar, GrazingViewsEqualTheCpu) {
    look_along_the_surface();
    const CookedMaterial cooked = cook(kSlitCd, kPlanar);
    show(cooked, 0.2);
    const AtPoint wanted = map_xyz(map(cooked));
    const AtPoint filtered = map_xyz(filter_error(map(cooked)));
    // Rasterisers put vertices on a grid of 2^-8 of a pixel, and a row is seen at much less of an angle than the next.
    const auto allowed = [&](const Point& point) {
        glm::dvec3 error = filtered(point);
        for (const glm::dvec2& change : {point.beside.view, point.below.view}) {
            Point beside = point;
            const glm::dvec2 view = glm::dvec2(point.view) + change / 256.0;
            beside.view = {view, std::sqrt(std::max(1.0 - glm::dot(view, view), 0.0))};
            error += glm::abs(wanted(beside) - wanted(point));
        }
        return error;
    };
    expect_drawn(wanted, allowed, kMapTolerance);
}

TEST_F(Planar, NeitherATurnAboutTheNormalNorAChangeOfSceneLightsFillsAMap) {
    transform_.rotation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    const CookedMaterial cooked = cook(kSlitCd, kPlanar);
    show(cooked);
    draw();
    const auto first = shown_map().shown();
    for (int step = 1; step < 5; ++step) {
        transform_.rotation = glm::angleAxis(0.3F * static_cast<float>(step), glm::vec3(0.0F, 0.0F, 1.0F));
        expect_map(map(cooked));
        EXPECT_EQ(shown_map().shown(), first);
    }
    ++light_.version;  // the same texels
    draw();
    EXPECT_EQ(shown_map().shown(), first);
}

/// The first frame does not wait for the full map.
TEST_F(Planar, ACoarseMapIsShownUntilTheFullOneIsThere) {
    const CookedMaterial cooked = cook(kSlitCd, R"({"representation": "planar", "map_resolution": 96})");
    show(cooked, 0.0, MapPace::Incremental);
    expect_map(map(cooked, kCoarsePlanarMap));
    const auto first = shown_map().shown();
    EXPECT_EQ(first->shown, MapDetail::Coarse);
    while (shown_map().is_filling()) draw();
    expect_map(map(cooked));
    EXPECT_EQ(shown_map().shown(), first);
}

/// No later frame waits for the compiler.
TEST_F(Planar, WhereTheFrameMayNotWaitAnArcTableStandsIn) {
    const CookedMaterial cooked = cook(kSlitCd, kPlanar);
    show(cooked, 0.0, MapPace::Incremental, std::chrono::milliseconds(0));
    const std::vector<glm::vec4> first = draw();
    const int programs = renderer_->report().programs;
    while (shown_map().is_filling()) draw();
    expect_map(map(cooked));
    EXPECT_EQ(renderer_->report().programs, programs);
    use(cook(kSlitCd, R"({"representation": "arc"})"));
    EXPECT_EQ(draw(), first);
}

TEST_F(Planar, AMeshThatIsNotFlatIsShadedAsArc) {
    mesh_ = crooked_triangle();
    show(cook(kSlitCd, kPlanar));
    const std::vector<glm::vec4> planar = draw();
    EXPECT_EQ(shown_map().shown(), nullptr);
    use(cook(kSlitCd, R"({"representation": "arc"})"));
    EXPECT_EQ(draw(), planar);
}

/// Lobes that are not flat: volume maps that another thread fills.
class PlanarLobes : public Planar {
 protected:
    static LobeMap map(const CookedMaterial& cooked, const glm::dvec3& normal, const LobeMapSize& size,
                       const lighting::LightSamples& texels) {
        return fill_lobe_map(texels, LobeSpectrum(std::get<PlanarTables>(cooked.tables).lobe->pattern, size.views),
                             normal, size.azimuths);
    }
    LobeMap full_map(const CookedMaterial& cooked) const {
        return map(cooked, glm::transpose(vertex_frame(0))[2], std::get<PlanarTables>(cooked.tables).lobe->size,
                   *light_.texels);
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
        SCOPED_TRACE(grating);
        show(cooked, 0.7);
        expect_map(full_map(cooked));
        EXPECT_FALSE(shown_map().is_filling());
        // A flat object needs no stand-in.
        EXPECT_FALSE(std::get<PlanarTables>(cooked.tables).stand_in.is_computed());
    }
}

TEST_F(PlanarLobes, AMapAtTheVerticesIsInterpolated) {
    const CookedMaterial cooked = cook_planar(kFoil, R"("map_resolution": 32, "map_at": "vertices")");
    show(cooked, 0.7);
    expect_map_at_vertices(cooked, full_map(cooked));
}

TEST_F(PlanarLobes, ACoarseMapIsShownUntilTheFullOneIsThere) {
    const CookedMaterial cooked = cook_planar(kFoil, R"("map_resolution": 96)");
    show(cooked, 0.3, MapPace::Incremental);
    const glm::dvec3 normal = glm::transpose(vertex_frame(0))[2];
    expect_map(map(cooked, normal, kCoarseLobeMap, *light_.texels));
    EXPECT_TRUE(maps_are_filling(world_));
    while (shown_map().is_filling()) draw();
    expect_map(full_map(cooked));
    EXPECT_FALSE(maps_are_filling(world_));
}

TEST_F(PlanarLobes, AMeshThatIsNotFlatIsShadedAsArc) {
    mesh_ = crooked_triangle();
    const CookedMaterial cooked = cook_planar(kFoil, kSmallLobeMap);
    show(cooked);
    const std::vector<glm::vec4> planar = draw();
    EXPECT_EQ(shown_map().shown(), nullptr);
    CookedMaterial arc = cooked;
    arc.tables = *std::get<PlanarTables>(cooked.tables).stand_in;
    use(arc);
    EXPECT_EQ(draw(), planar);
}

}  // namespace
}  // namespace rowland::diffraction
