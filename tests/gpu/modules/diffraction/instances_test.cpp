// Entities of one mesh and material are drawn at once, and look as if each had been drawn by itself.
#include <glm/gtc/quaternion.hpp>

#include "engine/scene/light.h"
#include "engine/scene/mesh_recipe.h"
#include "tests/gpu/call_counts.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

constexpr int kSize = 96;
constexpr const char* kCircleQuality = R"({"representation": "circle", "map_resolution": 32, "key_lights": 3})";
constexpr const char* kStreakQuality =
    R"({"representation": "streak", "map_resolution": 64, "bands": 3, "rank": 6, "view_resolution": 12})";

/// Rows of objects in front of the camera.
class Instances : public test::GlTest {
 protected:
    explicit Instances(const DiffractionSettings& settings = {.map_pace = MapPace::Whole}) {
        register_module(renderer_, settings);
        renderer_.set_probe(probe());
        renderer_.use_key_lights(true);
    }

    static lighting::LightProbe probe() {
        return lighting::build_light_probe(
            smooth_probe(), {.bands = 8, .key_lights = 3, .light_face = 32, .prefilter = {.face_size = 32}});
    }
    static scene::Mesh sphere() { return scene::build_mesh(scene::SphereRecipe{.radius = 0.3}); }
    static scene::Mesh disc() {
        return scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.05, .outer_radius = 0.35, .segments = 24});
    }

    /// Adds twelve objects, in four rows of three.
    void add_twelve(scene::Mesh mesh, const std::shared_ptr<const GpuMaterial>& material) {
        const render::MeshInstance shared = render::make_mesh_instance(std::move(mesh));
        for (int i = 0; i < 12; ++i) {
            const ecs::Entity entity = objects_.emplace_back(world_.create());
            const auto row = static_cast<float>(i / 3);
            const glm::vec3 position(0.75F * static_cast<float>(i % 3) - 0.75F, 0.6F * row - 0.9F, 0.1F * row);
            world_.add(entity, scene::Transform{.translation = position, .rotation = kFacing});
            world_.add(entity, render::MeshInstance(shared));
            world_.add(entity, render::StandardMaterial{.base_colour = {0.7F, 0.5F, 0.3F}, .roughness = 0.4F});
            if (material) add_surface(world_, entity, {.material = material}, true);
        }
    }

    std::vector<glm::vec4> draw() {
        scene::update_world_matrices(world_);
        renderer_.render(world_, camera_, target_);
        test::CallCounts counts;
        renderer_.render(world_, camera_, target_);
        draws_ = counts.take().draws;
        return target_.read_rgba_float();
    }

    /// Draws twice: all at once as far as may be, and each by itself, as one that fills whole columns of the picture
    /// is. `least_saved`: of the calls that draw.
    void expect_as_by_itself(int least_saved) {
        const std::vector<glm::vec4> at_once = draw();
        const int draws_at_once = draws_;
        for (const ecs::Entity entity : objects_) world_.add(entity, render::PictureColumns{});
        const std::vector<glm::vec4> by_itself = draw();
        EXPECT_LE(draws_at_once, draws_ - least_saved);
        float brightest = 0.0F;
        float largest = 0.0F;
        for (std::size_t i = 0; i < at_once.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                brightest = std::max(brightest, by_itself[i][c]);
                largest = std::max(largest, std::abs(at_once[i][c] - by_itself[i][c]));
            }
        EXPECT_GT(brightest, 0.1F);
        EXPECT_LE(largest, 1e-5F * brightest);
        for (const ecs::Entity entity : objects_) world_.remove<render::PictureColumns>(entity);
    }

    static inline const glm::quat kFacing = glm::angleAxis(1.0F, glm::vec3(1.0F, 0.0F, 0.0F));

    render::Renderer renderer_{glm::dmat3(1.0)};
    ecs::World world_;
    std::vector<ecs::Entity> objects_;
    scene::Camera camera_{.eye = {0.0F, 0.0F, 3.0F}};
    gpu::Framebuffer target_{
        gpu::FramebufferDesc{.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true}};
    int draws_ = 0;
};

/// No map is there in the first frame.
class InstancesToCome : public Instances {
 protected:
    InstancesToCome() : Instances({.map_pace = MapPace::Incremental, .map_wait = std::chrono::milliseconds(0)}) {}
};

TEST_F(Instances, OfThePlainSurfaceCastShadowsAndShutOutLight) {
    add_twelve(sphere(), nullptr);
    const ecs::Entity lamp = world_.create();
    world_.add(lamp, scene::Transform{.rotation = glm::angleAxis(-0.7F, glm::vec3(1.0F, 1.0F, 0.0F))});
    world_.add(lamp, scene::DirectionalLight{.irradiance = glm::vec3(2.0F), .casts_shadow = true});
    renderer_.set_effects({.ambient_occlusion = render::AmbientOcclusionSettings{}});
    expect_as_by_itself(33);  // one draw for twelve in the picture, in the shadow map and in the occlusion's depth
}

TEST_F(Instances, OfGratingsShareTheirMaps) {
    for (const char* quality : {kCircleQuality, R"({"representation": "direct"})",
                                R"({"representation": "planar", "map_resolution": 48, "key_lights": 3})"}) {
        SCOPED_TRACE(quality);
        const bool flat = std::string_view(quality).find("planar") != std::string_view::npos;
        add_twelve(flat ? disc() : sphere(), make_gpu_material(cook(kSlitCd, quality), glm::dmat3(1.0)));
        expect_as_by_itself(11);
        for (const ecs::Entity entity : std::exchange(objects_, {})) world_.destroy(entity);
    }
}

TEST_F(Instances, ThatDifferInMoreThanTheirTransformAreDrawnApart) {
    const auto circle = make_gpu_material(cook(kSlitCd, kCircleQuality), glm::dmat3(1.0));
    const auto planar =
        make_gpu_material(cook(kSlitCd, R"({"representation": "planar", "map_resolution": 48})"), glm::dmat3(1.0));
    add_twelve(sphere(), circle);
    add_twelve(disc(), planar);
    for (std::size_t i = 12; i < 24; ++i) world_.get<scene::Transform>(objects_[i]).translation.z -= 0.6F;
    world_.get<DiffractionSurface>(objects_[0]).groove_rotation = 1.0F;
    world_.get<scene::Transform>(objects_[1]).scale.x = -1.0F;  // mirrored: its faces wind the other way
    world_.get<render::StandardMaterial>(objects_[2]).base_colour = glm::vec3(0.1F, 0.1F, 0.9F);
    world_.get<scene::Transform>(objects_[3]).scale = glm::vec3(0.5F, 1.0F, 1.5F);
    world_.get<scene::Transform>(objects_[13]).rotation *= glm::angleAxis(0.3F, glm::vec3(0.0F, 0.0F, 1.0F));
    expect_as_by_itself(24 - 6);
}

TEST_F(InstancesToCome, AreDrawnWithProgramsThatWereLinkedWhileTheirMapsWereFilled) {
    // The incoherent part of pits lies in each object's vertices: these are never drawn at once.
    const auto streak = make_gpu_material(cook(kPits, kStreakQuality), glm::dmat3(1.0));
    const auto planar =
        make_gpu_material(cook(kSlitCd, R"({"representation": "planar", "map_resolution": 48})"), glm::dmat3(1.0));
    add_twelve(disc(), streak);
    add_twelve(disc(), planar);
    scene::update_world_matrices(world_);
    renderer_.render(world_, camera_, target_);
    const auto linked = renderer_.report().programs;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (maps_are_filling(world_) && std::chrono::steady_clock::now() < deadline) draw();
    draw();
    EXPECT_EQ(draws_, 12 + 1 + 1);  // and the sky
    EXPECT_EQ(renderer_.report().programs, linked);
}

TEST_F(Instances, BetweenTwoProbesAreDrawnUnderEach) {
    add_twelve(sphere(), make_gpu_material(cook(kSlitCd, kCircleQuality), glm::dmat3(1.0)));
    lighting::LightProbe dim = probe();
    for (glm::dvec3& coefficient : dim.ambient.coefficients) coefficient *= 0.2;
    const ecs::Entity box = world_.create();
    world_.add(box, scene::Transform{.translation = {1e4F + 0.1F, 0.0F, 0.0F}});
    world_.add(box, render::ProbeVolume{.probe = std::make_shared<const lighting::LightProbe>(std::move(dim)),
                                        .half = glm::vec3(1e4F),
                                        .fade_m = 1.0F});
    expect_as_by_itself(20 - 5);  // in three columns, of which two are between the probes
}

TEST_F(Instances, AFewAreDrawnOneByOneWithTheProgramOfOne) {
    add_twelve(sphere(), nullptr);
    for (std::size_t i = 7; i < objects_.size(); ++i) world_.destroy(objects_[i]);
    objects_.resize(7);
    draw();
    EXPECT_EQ(draws_, 8);  // and the sky
}

}  // namespace
}  // namespace rowland::diffraction
