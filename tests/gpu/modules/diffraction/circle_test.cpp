// The map over world-space grating vectors: against the CPU's, and when it is filled.

#include "modules/diffraction/runtime/gpu_representations.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

class Circle : public GratingPicture {
 protected:
    const ObjectMap& shown_map() { return world_.get<SurfaceState>(entity_).map; }
    CircleMap map(const CookedMaterial& cooked, MapDetail detail = MapDetail::Full) const {
        const CircleMapSize size = std::get<CircleTables>(cooked.tables).size;
        return fill_circle_map(*light_.texels, cooked.kernel, cooked.material.grating.pitch_nm,
                               detail == MapDetail::Full ? size : coarser(size), cooked.zero_order_xyz);
    }
};

constexpr const char* kCircle = R"({"representation": "circle", "map_resolution": 24})";

/// With one chart, and with two for a kernel that tells +x from −x; with g in both halves of the world.
TEST_F(Circle, PixelsEqualTheCpusMap) {
    for (const char* grating : {kSlitCd, kBlazed}) {
        const CookedMaterial cooked = cook(grating, kCircle);
        const CircleMap expected = map(cooked);
        EXPECT_EQ(expected.charts, grating == kBlazed ? 2 : 1);
        for (const double rotation : {0.3, 0.3 + 3.14159265358979}) {
            SCOPED_TRACE(testing::Message() << grating << " turned by " << rotation);
            show(cooked, rotation);
            expect_map(expected);
        }
    }
}

/// Without the remainder of the series, and with another number of angles than by default.
TEST_F(Circle, PixelsHaveAnyNumberOfAngles) {
    for (const char* angles : {"0", "9"}) {
        SCOPED_TRACE(angles);
        const std::string quality = R"({"representation": "circle", "map_resolution": 24, "angles": )";
        const CookedMaterial cooked = cook(kSlitCd, quality + angles + "}");
        show(cooked);
        expect_map(map(cooked));
    }
}

/// With lights at the pixels and, in one value with the map, at the vertices.
TEST_F(Circle, AMapAtTheVerticesIsInterpolated) {
    light_ = light_of(smooth_probe(), three_keys());
    for (const char* lights_at : {"pixels", "vertices"}) {
        const std::string quality = R"({"representation": "circle", "map_resolution": 24, "map_at": "vertices",
            "lights_at": ")";
        const CookedMaterial cooked = cook(kSlitCd, quality + lights_at + "\"}");
        show(cooked, -0.3);
        expect_map_at_vertices(cooked, map(cooked));
    }
}

TEST_F(Circle, MotionFillsNothingAndObjectsShareTheMap) {
    const CookedMaterial cooked = cook(kSlitCd, kCircle);
    show(cooked);
    const ecs::Entity other = world_.create();
    world_.add(other, scene::Transform{.translation = {0.0F, 0.0F, -1.0F}});
    world_.add(other, render::make_mesh_instance(flat_triangle()));
    world_.add(other, render::StandardMaterial(material_->base()));
    world_.add(other, DiffractionSurface{material_, 0.5F});
    draw();
    const auto first = shown_map().shown();
    EXPECT_EQ(world_.get<SurfaceState>(other).map.shown(), first);
    const CircleMap expected = map(cooked);
    world_.destroy(other);
    for (int step = 1; step < 4; ++step) {
        transform_.rotation =
            glm::angleAxis(0.4F * static_cast<float>(step), glm::normalize(glm::vec3(1.0F, 1.0F, 0.3F)));
        expect_map(expected);
    }
    ++light_.version;  // the same texels
    draw();
    EXPECT_EQ(shown_map().shown(), first);
    light_ = light_of(smooth_probe(), {}, light_.version + 1);
    draw();
    EXPECT_NE(shown_map().shown(), first);
}

/// What a flat mirror shows changes little over a pixel, and the average is expensive.
TEST_F(Circle, OnlyACurvedMirrorIsAveragedOverThePixel) {
    const auto is_averaged = [&] {
        draw();
        const gpu::ProgramDesc program = material_->program(world_.get<SurfaceState>(entity_));
        return std::ranges::any_of(program.defines,
                                   [](const gpu::Define& define) { return define.first == "MATERIAL_CURVED_MIRROR"; });
    };
    show(cook(kSlitCd, kCircle));
    EXPECT_TRUE(is_averaged());
    world_.add(entity_, render::make_mesh_instance(flat_triangle()));
    EXPECT_FALSE(is_averaged());
}

/// The first frame does not wait for the full map.
TEST_F(Circle, ACoarseMapIsShownUntilTheFullOneIsThere) {
    const CookedMaterial cooked = cook(kSlitCd, kCircle);
    show(cooked, 0.3, MapPace::Incremental);
    expect_map(map(cooked, MapDetail::Coarse));
    while (shown_map().is_filling()) draw();
    expect_map(map(cooked));
}

TEST_F(Circle, WhereTheFrameMayNotWaitKeyLightsAreShownAlone) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kSlitCd, kCircle);
    show(cooked, -0.3, MapPace::Incremental, std::chrono::milliseconds(0));
    expect_drawn(key_lights(cooked), key_lights_error(cooked));
    const int programs = renderer_->report().programs;
    while (shown_map().is_filling()) draw();
    draw();
    EXPECT_EQ(renderer_->report().programs, programs);
}

}  // namespace
}  // namespace rowland::diffraction
