// Frame time of the CD with the paper's spikes against the plain material and the unlit frame, all in one run.
#include <epoxy/gl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <string>
#include <vector>

#include "engine/asset/container.h"
#include "engine/colour/working_space.h"
#include "engine/core/program.h"
#include "engine/core/progress.h"
#include "engine/platform/headless_context.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "engine/scene/directional_light.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/benchmark/entity_benchmark.h"
#include "tests/benchmark/processor.h"

namespace rowland {
namespace {

using Clock = std::chrono::steady_clock;

std::filesystem::path cooked_folder() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "cooked";
}

/// The CD over half the picture, under the studio probe and one directional light.
class Scene {
 public:
    Scene(int width, int height)
        : renderer_(colour::xyz_to_acescg()), target_({.width = width, .height = height, .depth = true}) {
        diffraction::register_module(renderer_);
        const auto probe = asset::load(cooked_folder() / "studio.probe", "probe", lighting::kLightProbeVersion);
        renderer_.set_probe(lighting::deserialise(probe.payload, "studio.probe"));
        material_ = diffraction::make_gpu_material(
            diffraction::load_cooked_material(cooked_folder() / "cd_paper.material"), colour::xyz_to_acescg());

        disc_ = world_.create();
        world_.add(disc_, scene::Transform{});
        scene::Mesh mesh = scene::merge_instances(scene::load_gltf(cooked_folder() / "cd.glb"));
        vertices_ = mesh.positions.size();
        world_.add(disc_, render::make_mesh_instance(std::move(mesh)));
        world_.add(disc_, material_->base());
        world_.add(world_.create(), scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.3F, 1.0F, 0.4F)),
                                                            .irradiance = glm::vec3(0.5F)});
        camera_.eye = {0.0F, 0.096F, 0.02F};
        camera_.vertical_field_of_view = 0.9F;
        tilt(0);
    }

    void use_grating(bool on) {
        if (on)
            world_.add(disc_, diffraction::DiffractionSurface{material_});
        else
            world_.remove<diffraction::DiffractionSurface>(disc_);
    }
    /// Turns the disc a little, to another place for every step.
    void tilt(int step) {
        const float angle = 0.02F * static_cast<float>(step % 11);
        world_.get<scene::Transform>(disc_).rotation = glm::angleAxis(angle, glm::vec3(1.0F, 0.0F, 0.0F));
        scene::update_world_matrices(world_);
    }
    double draw_ms(render::Shading shading) {
        const Clock::time_point start = Clock::now();
        renderer_.render(world_, camera_, target_, shading);
        glFinish();
        return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }
    /// Share of the pixels that show the disc: those that differ between shadings.
    double coverage() {
        const std::vector<glm::vec4> lit = (draw_ms(render::Shading::Full), target_.read_rgba_float());
        const std::vector<glm::vec4> unlit = (draw_ms(render::Shading::Unlit), target_.read_rgba_float());
        std::size_t differing = 0;
        for (std::size_t i = 0; i < lit.size(); ++i) differing += lit[i] != unlit[i] ? 1U : 0U;
        return static_cast<double>(differing) / static_cast<double>(lit.size());
    }
    std::size_t vertices() const { return vertices_; }

 private:
    render::Renderer renderer_;
    gpu::Framebuffer target_;
    ecs::World world_;
    ecs::Entity disc_;
    scene::Camera camera_;
    std::shared_ptr<const diffraction::GpuMaterial> material_;
    std::size_t vertices_ = 0;
};

struct Variant {
    const char* name;
    std::function<double(int step)> frame_ms;
    double minimum_ms = std::numeric_limits<double>::infinity();
};

int run(int argc, char** argv) {
    int width = 1280;
    int height = 720;
    int rounds = 30;
    CLI::App app{"Frame time of the diffraction material against the plain one (minima over interleaved rounds).",
                 "rowland-benchmark"};
    app.footer("example: rowland-benchmark --width 640 --height 360 --rounds 50");
    app.add_option("--width", width, "Width in pixels")->check(CLI::Range(16, 8192))->capture_default_str();
    app.add_option("--height", height, "Height in pixels")->check(CLI::Range(16, 8192))->capture_default_str();
    app.add_option("--rounds", rounds, "Rounds; each draws every variant once")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }

    const platform::HeadlessContext context({.debug = false});
    Scene scene(width, height);
    scene.use_grating(false);
    const double coverage = scene.coverage();

    const auto draw = [&scene](bool grating, int step, render::Shading shading) {
        scene.use_grating(grating);
        scene.tilt(step);
        return scene.draw_ms(shading);
    };
    std::vector<Variant> variants = {
        {"unlit", [&](int) { return draw(false, 0, render::Shading::Unlit); }},
        {"plain material", [&](int) { return draw(false, 0, render::Shading::Full); }},
        {"spikes, object at rest", [&](int) { return draw(true, 0, render::Shading::Full); }},
        {"spikes, object turning", [&](int step) { return draw(true, step, render::Shading::Full); }},
    };
    {
        Progress progress("frames", static_cast<std::size_t>(rounds));
        for (int round = 0; round < rounds; ++round, progress.advance())
            for (Variant& variant : variants) {
                variant.frame_ms(2 * round);  // after another variant: what changed with it is not timed
                variant.minimum_ms = std::min(variant.minimum_ms, variant.frame_ms(2 * round + 1));
            }
    }

    std::printf("%s, %s\n", processor_name().c_str(), context.renderer().c_str());
    std::printf("%dx%d, disc of %zu vertices over %.0f %% of the picture, post off, sky on, minima of %d rounds\n",
                width, height, scene.vertices(), 100.0 * coverage, rounds);
    std::printf("%-26s %10s %10s\n", "variant", "ms", "x plain");
    for (const Variant& variant : variants)
        std::printf("%-26s %10.2f %10.2f\n", variant.name, variant.minimum_ms,
                    variant.minimum_ms / variants[1].minimum_ms);
    benchmark::print_entity_times(rounds);
    return 0;
}

}  // namespace
}  // namespace rowland

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::run(argc, argv); });
}
