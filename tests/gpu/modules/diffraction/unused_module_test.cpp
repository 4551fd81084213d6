// What a scene does not use costs it nothing, by what the driver is told.
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/lighting/light_probe.h"
#include "engine/scene/light.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/module.h"
#include "tests/gpu/modules/diffraction/upload_log.h"
#include "tests/gpu/render_test.h"

namespace rowland::diffraction {
namespace {

struct Told {
    std::size_t bytes = 0;
    std::vector<std::string> shaders;
};

class UnusedModule : public rowland::test::RenderTest {
 protected:
    /// What three frames of a lit square tell the driver. `material`: a grating's file, or none for a plain surface.
    Told frames(bool with_module, const char* material = nullptr) {
        const rowland::test::UploadLog log;
        render::Renderer renderer(glm::dmat3(1.0));
        if (with_module) register_module(renderer);
        renderer.use_key_lights(true);
        lighting::LightProbe probe = even_light(0.5F);
        probe.key_lights = {{.direction = {0.0, 0.6, 0.8}, .flux = glm::dvec3(0.4), .concentration = 900.0}};
        renderer.set_probe(probe);
        ecs::World world;
        const ecs::Entity square = world.create();
        world.add(square, render::make_mesh_instance(RenderTest::square()));
        world.add(square, render::StandardMaterial{});
        world.add(square, scene::Transform{});
        world.add(world.create(), scene::DirectionalLight{.casts_shadow = true});
        const ecs::Entity lamp = world.create();
        world.add(lamp, scene::PunctualLight{});
        world.add(lamp, scene::Transform{.translation = {0.0F, 0.0F, 2.0F}});
        if (material != nullptr) {
            const Material parsed = parse_material(nlohmann::json::parse(material), "grating.json");
            world.add(square, DiffractionSurface{make_gpu_material(bake_material(parsed), glm::dmat3(1.0))});
        }
        for (int frame = 0; frame < 3; ++frame) {
            world.get<scene::Transform>(square).rotation =
                glm::angleAxis(0.1F * static_cast<float>(frame), glm::vec3(0.0F, 1.0F, 0.0F));
            scene::update_world_matrices(world);
            renderer.render(world, camera_, target_);
        }
        return {log.bytes(), log.shaders()};
    }
};

TEST_F(UnusedModule, ASceneWithoutGratingsUploadsAndCompilesNothingOfIt) {
    const Told without = frames(false);
    const Told with = frames(true);
    EXPECT_GT(without.bytes, 0U);
    EXPECT_EQ(with.bytes, without.bytes);
    EXPECT_FALSE(without.shaders.empty());
    EXPECT_EQ(with.shaders, without.shaders);
}

/// One representation's shaders, and its tables once.
TEST_F(UnusedModule, AGratingUploadsAndCompilesWhatItNeeds) {
    const Told without = frames(false);
    const Told grating = frames(true, R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}},
                                          "quality": {"representation": "arc", "key_lights": 0}})");
    const std::size_t table = std::size_t{256} * 2 * 4 * 2;  // texels of halves
    EXPECT_GE(grating.bytes, without.bytes + table);
    std::size_t arcs = 0;
    for (const std::string& source : grating.shaders) {
        if (source.find("arc_radiance") != std::string::npos) ++arcs;
        for (const char* other : {"spike_xyz", "map_radiance", "streak_map"})
            EXPECT_EQ(source.find(other), std::string::npos) << other;
    }
    EXPECT_GE(arcs, 1U);
}

}  // namespace
}  // namespace rowland::diffraction
