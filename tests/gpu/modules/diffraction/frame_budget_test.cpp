// Objects within a frame budget: which rungs draw them, how these follow each other, and what is measured.
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/mesh_recipe.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

constexpr const char* kCd = kSlitCd;

BudgetRecord record(double error, double price) {
    BudgetRecord record{.price = price, .probes = {}};
    record.probes.push_back({.probe = "a probe", .key_lights = 0, .error = error});
    return record;
}

/// The rungs of ladder_material().
enum RungOfLadder : std::size_t { kMeanRung, kDirectRung, kArcRung, kMapRung };

/// Drawn by key lights alone, by an arc table, or by the map of the whole probe.
CookedMaterial ladder_material() {
    CookedMaterial top = cook(kCd, R"({"representation": "planar", "map_resolution": 32, "key_lights": 4})");
    top.measured = record(0.01, 60.0);
    const auto add = [&](const char* settings, double error, double price) {
        auto baked = std::make_shared<const CookedMaterial>(cook(kCd, settings));
        top.cheaper.push_back({.settings = nlohmann::json::parse(settings),
                               .quality = baked->material.quality,
                               .baked = baked,
                               .measured = record(error, price)});
    };
    add(R"({"representation": "direct", "key_lights": 0})", 1.0, 0.0);
    add(R"({"representation": "arc", "bands": 5, "rank": 8, "key_lights": 0})", 0.2, 4.0);
    return top;
}

/// Two discs side by side that face the camera.
class FrameBudgets : public test::GlTest {
 protected:
    FrameBudgets() {
        register_module(renderer_, {.map_pace = MapPace::Incremental, .map_wait = std::chrono::hours(1)});
        renderer_.set_probe(lighting::LightProbe(probe_));
        renderer_.use_key_lights(true);
        const auto material = make_gpu_material(ladder_material(), glm::dmat3(1.0));
        scene::Mesh disc =
            scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.2, .outer_radius = 0.9, .rings = 1, .segments = 48});
        for (const float x : {-1.0F, 1.0F}) {
            const ecs::Entity entity = world_.create();
            const glm::quat upright = glm::angleAxis(1.5707964F, glm::vec3(1.0F, 0.0F, 0.0F));
            world_.add(entity, scene::Transform{.translation = {x, 0.0F, 0.0F}, .rotation = upright});
            world_.add(entity, render::make_mesh_instance(scene::Mesh(disc)));
            world_.add(entity, render::StandardMaterial(material->base()));
            world_.add(entity, DiffractionSurface{material});
            discs_.push_back(entity);
        }
    }

    std::vector<glm::vec4> draw() {
        scene::update_world_matrices(world_);
        renderer_.render(world_, camera_, target_);
        glFinish();  // what was measured is known in the next frame
        return target_.read_rgba_float();
    }
    void set_budget(double ms) {
        if (!world_.alive(budget_)) budget_ = world_.create();
        world_.add(budget_, FrameBudget{ms});
    }
    const FrameBudgetReport& report() { return world_.get<FrameBudgetReport>(budget_); }
    std::size_t rung(std::size_t disc) { return world_.get<DrawnRung>(discs_[disc]).shown; }
    /// Until the maps are there, the rungs chosen, and shown.
    std::vector<glm::vec4> settle() {
        std::vector<glm::vec4> picture;
        int still = 0;
        for (int frame = 0; frame < 300 && still < 4; ++frame) {
            picture = draw();
            still = maps_are_filling(world_) || report_changes() ? 0 : still + 1;
        }
        EXPECT_EQ(still, 4);
        return picture;
    }
    bool report_changes() {
        const auto* report = world_.find<FrameBudgetReport>(budget_);
        return world_.alive(budget_) && (report == nullptr || report->fading > 0 || report->objects == 0);
    }
    static float difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
        float largest = 0.0F;
        for (std::size_t i = 0; i < a.size(); ++i)
            for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[i][c] - b[i][c]));
        return largest;
    }

    lighting::LightProbe probe_ = lighting::build_light_probe(
        smooth_probe(), {.bands = 8, .key_lights = 4, .light_face = 32, .prefilter = {.face_size = 32}});
    render::Renderer renderer_{glm::dmat3(1.0)};
    ecs::World world_;
    std::vector<ecs::Entity> discs_;
    ecs::Entity budget_;
    scene::Camera camera_{.eye = {0.0F, 0.0F, 5.0F}};
    gpu::Framebuffer target_{
        gpu::FramebufferDesc{.width = 128, .height = 96, .colours = {gpu::Format::RGBA32F}, .depth = true}};
};

TEST_F(FrameBudgets, OneThatIsNeverReachedChangesNothing) {
    const std::vector<glm::vec4> without = settle();
    set_budget(1e9);
    EXPECT_LT(difference(settle(), without), 1e-6F);
    EXPECT_EQ(rung(0), kMapRung);
    EXPECT_EQ(report().objects, 2);
    EXPECT_EQ(report().at_best, 2);
    EXPECT_NEAR(report().error, 0.01 / 0.05, 1e-12);
    EXPECT_GT(report().spent_ms, 0.0);
    EXPECT_GT(report().predicted_ms, 0.0);
}

TEST_F(FrameBudgets, OneThatCannotBeMetDrawsTheCheapestRungs) {
    set_budget(1e-9);
    const std::vector<glm::vec4> cheapest = settle();
    EXPECT_EQ(rung(0), kMeanRung);
    EXPECT_EQ(rung(1), kMeanRung);
    EXPECT_EQ(report().at_best, 0);
    EXPECT_NEAR(report().error, 1.0 / 0.05, 1e-12);
    EXPECT_NEAR(report().least_error, 0.01 / 0.05, 1e-12);
    world_.destroy(budget_);
    const std::vector<glm::vec4> best = settle();
    EXPECT_GT(difference(cheapest, best), 0.01F);
}

TEST_F(FrameBudgets, ARungIsDrawnAsItsMaterial) {
    for (const ecs::Entity disc : discs_) world_.add(disc, RecordedRung{kDirectRung});
    set_budget(1e9);
    const std::vector<glm::vec4> rung = settle();
    world_.destroy(budget_);
    const auto material =
        make_gpu_material(cook(kCd, R"({"representation": "direct", "key_lights": 0})"), glm::dmat3(1.0));
    for (const ecs::Entity disc : discs_) world_.get<DiffractionSurface>(disc).material = material;
    EXPECT_LT(difference(settle(), rung), 1e-5F);  // its program does not multiply by a part of the light
}

/// Of a sphere, whose normals vary. The matte surface is what a dielectric reflects beyond a black one.
TEST_F(FrameBudgets, TheMeanColourIsThatOfAMatteSurface) {
    const ecs::Entity lamp = world_.create();
    world_.add(lamp, scene::Transform{.translation = {0.0F, 3.0F, 3.0F}});
    world_.add(lamp, scene::PunctualLight{.intensity = {20.0F, 10.0F, 5.0F}});
    const scene::Mesh sphere = scene::build_mesh(scene::SphereRecipe{.radius = 0.9, .rings = 96, .segments = 192});
    for (const ecs::Entity disc : discs_) {
        world_.add(disc, render::make_mesh_instance(scene::Mesh(sphere)));
        world_.add(disc, RecordedRung{kMeanRung});
    }
    set_budget(1e9);
    const std::vector<glm::vec4> mean = settle();
    EXPECT_EQ(rung(0), kMeanRung);
    world_.destroy(budget_);
    const CookedMaterial cooked = ladder_material();
    const LayerWeights weights = layer_weights(cooked.material.grating, cooked.material.quality.illuminant);
    ASSERT_EQ(cooked.material.base.colour, glm::vec3(0.0F));
    const glm::vec3 albedo(colour::xyz_to_rec709() * weights.reflected);
    for (const ecs::Entity disc : discs_) world_.remove<DiffractionSurface>(disc);
    const auto drawn_dielectric = [&](const glm::vec3& colour) {
        for (const ecs::Entity disc : discs_)
            world_.add(disc, render::StandardMaterial{.base_colour = colour, .metallic = 0.0F, .roughness = 1.0F});
        return draw();
    };
    std::vector<glm::vec4> matte = drawn_dielectric(albedo);
    const std::vector<glm::vec4> black = drawn_dielectric(glm::vec3(0.0F));
    float brightest = 0.0F;
    float error = 0.0F;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        if (black[i] == matte[i]) continue;  // background
        matte[i] -= black[i];
        for (int c = 0; c < 3; ++c) {
            brightest = std::max(brightest, matte[i][c]);
            error = std::max(error, std::abs(mean[i][c] - matte[i][c]));
        }
    }
    EXPECT_GT(brightest, 0.1F);
    EXPECT_LT(error, 0.005F * brightest);
}

/// Among neighbouring frames, also while a rung gives way to the next, no pixel jumps.
TEST_F(FrameBudgets, RungsFadeIntoEachOther) {
    set_budget(1e9);
    std::vector<glm::vec4> before = settle();
    const std::vector<glm::vec4> best = before;
    const int programs = renderer_.report().programs;
    const auto largest_step = [&](int frames) {
        float largest = 0.0F;
        for (int frame = 0; frame < frames; ++frame) {
            const std::vector<glm::vec4> picture = draw();
            largest = std::max(largest, difference(picture, before));
            before = picture;
        }
        return largest;
    };
    set_budget(1e-9);
    const float urgent = largest_step(16);
    const std::vector<glm::vec4> cheapest = settle();
    EXPECT_LT(difference(before, cheapest), 1e-6F) << "the fade is over";
    constexpr float kSteepest = 1.6F;  // smoothstep's 3/2
    EXPECT_LT(urgent, kSteepest / kLeastFadeFrames * difference(best, cheapest));
    set_budget(1e9);
    const float to_better = largest_step(16 + kMostFadeFrames);
    EXPECT_LT(difference(before, settle()), 1e-6F) << "the fade is over";
    EXPECT_LT(to_better, kSteepest / (kMostFadeFrames + 1) * difference(best, cheapest));
    EXPECT_GT(to_better, 0.0F);
    EXPECT_EQ(renderer_.report().programs, programs) << "all rungs' programs were linked with the first";
}

/// The ladder's material, drawn by key lights alone, with a map that is there when the test says so.
class LateMap final : public GpuMaterial {
 public:
    explicit LateMap(const bool& filled)
        : GpuMaterial(std::make_shared<const CookedMaterial>(ladder_material()), glm::dmat3(1.0)), filled_(filled) {}

    void update(const SurfaceObject&, SurfaceLight&, SurfaceState& state) const override {
        state.without_map = !filled_;
    }

 private:
    void describe(const SurfaceState&, gpu::ProgramDesc&) const override {}
    void bind_tables(const gpu::Program&, const SurfaceState&) const override {}

    const bool& filled_;
};

TEST_F(FrameBudgets, AFadeWaitsForTheMapOfItsRung) {
    bool filled = false;
    const auto material = std::make_shared<const LateMap>(filled);
    for (const ecs::Entity disc : discs_) world_.get<DiffractionSurface>(disc).material = material;
    set_budget(1e-9);
    const std::vector<glm::vec4> cheapest = settle();
    set_budget(1e9);
    const auto drawn = [&](std::size_t disc) -> const DrawnRung& { return world_.get<DrawnRung>(discs_[disc]); };
    int frames_without = 0;
    for (int frame = 0; frame < 300 && frames_without < 16; ++frame) {
        const std::vector<glm::vec4> picture = draw();
        if (drawn(0).changes() && drawn(1).changes()) ++frames_without;
        for (const std::size_t disc : {0U, 1U}) ASSERT_EQ(drawn(disc).fade_frame, 0) << frame;
        ASSERT_LT(difference(picture, cheapest), 1e-6F) << frame;
    }
    EXPECT_EQ(frames_without, 16);
    filled = true;
    for (int frame = 0; frame < 2; ++frame) draw();
    EXPECT_EQ(drawn(0).fade_frame, 1);
    EXPECT_EQ(drawn(1).fade_frame, 1);
    settle();
    EXPECT_EQ(rung(0), kMapRung);
    EXPECT_EQ(rung(1), kMapRung);
}

TEST_F(FrameBudgets, WhatIsNotSeenChangesAtOnce) {
    set_budget(1e9);
    settle();
    world_.get<scene::Transform>(discs_[1]).translation.z = 100.0F;  // behind the camera
    settle();
    EXPECT_EQ(report().objects, 1);
    world_.get<scene::Transform>(discs_[1]).translation.z = 0.0F;
    const std::vector<glm::vec4> again = settle();
    EXPECT_EQ(report().objects, 2);
    EXPECT_EQ(rung(1), kMapRung);
    for (const glm::vec4& pixel : again) ASSERT_TRUE(std::isfinite(pixel.x));
}

TEST_F(FrameBudgets, ARecordedRungIsDrawnInPlaceOfACheaperOne) {
    world_.add(discs_[0], RecordedRung{kArcRung});
    world_.add(discs_[1], RecordedRung{});
    set_budget(1e-9);
    settle();
    EXPECT_EQ(rung(0), kArcRung);
    EXPECT_EQ(rung(1), kMapRung);
    EXPECT_EQ(report().objects, 2);
    EXPECT_EQ(report().at_best, 1);
    EXPECT_NEAR(report().error, (0.2 + 0.01) / 2.0 / 0.05, 0.02) << "the discs cover about as many pixels";
    for (const ecs::Entity disc : discs_) world_.remove<RecordedRung>(disc);
    settle();
    EXPECT_EQ(rung(0), kMeanRung);
    EXPECT_EQ(rung(1), kMeanRung);
}

/// What needs both slots for its probes cannot fade. The box's probe and the renderer's each light a half of the first
/// disc.
TEST_F(FrameBudgets, BetweenTwoProbesARungStaysUnlessTheTimeIsExceeded) {
    constexpr float kHalf_m = 5.0F;
    const ecs::Entity box = world_.create();
    world_.add(box, scene::Transform{.translation = {-1.5F - kHalf_m, 0.0F, 0.0F}});
    world_.add(box, render::ProbeVolume{.probe = std::make_shared<const lighting::LightProbe>(probe_),
                                        .half = glm::vec3(kHalf_m)});
    set_budget(1e-9);
    settle();
    EXPECT_EQ(rung(0), kMeanRung) << "the time is exceeded";
    EXPECT_EQ(rung(1), kMeanRung);
    const auto settle_patiently = [&] {
        for (int frame = 0; frame < 16; ++frame) draw();  // until better rungs are wanted
        settle();
    };
    set_budget(1e9);
    settle_patiently();
    EXPECT_EQ(rung(0), kMeanRung);
    EXPECT_EQ(rung(1), kMapRung);
    world_.destroy(box);
    settle_patiently();
    EXPECT_EQ(rung(0), kMapRung);
}

/// Counts the pixels of a disc by the picture, whose background is black.
TEST_F(FrameBudgets, TheSamplesOfEachDrawAreCounted) {
    set_budget(1e9);
    settle();
    const double both = world_.get<DrawnRung>(discs_[0]).size.samples + world_.get<DrawnRung>(discs_[1]).size.samples;
    world_.destroy(discs_[1]);
    const std::vector<glm::vec4> one = settle();
    world_.destroy(discs_[0]);
    const std::vector<glm::vec4> none = draw();
    int pixels = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
        if (one[i] != none[i]) ++pixels;
    EXPECT_GT(pixels, 300);
    EXPECT_NEAR(both / 2.0, pixels, 0.02 * pixels);
}

}  // namespace
}  // namespace rowland::diffraction
