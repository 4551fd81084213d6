// Frames of many gratings against the same frames of plain metal, and what frame budgets make of them.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "engine/asset/container.h"
#include "engine/command_line/command_line.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "engine/gpu/framebuffer.h"
#include "engine/live/live_assets.h"
#include "engine/platform/gl_context.h"
#include "engine/post/ocio_config.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_instance.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/transform.h"
#include "modules/asset_types.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/material_types.h"

namespace rowland {
namespace {

using Clock = std::chrono::steady_clock;
using Materials = std::vector<std::shared_ptr<const diffraction::GpuMaterial>>;

/// By the surface that they are for.
struct Palette {
    Materials flat;
    Materials curved;
};

struct Options {
    glm::ivec2 size{1280, 720};
    int rounds = 12;
    std::vector<int> counts{1, 10, 100, 1000};
    int budget_count = 60;  ///< objects of the budgets' scene
    std::string probe = "captured_interior";
    std::vector<std::string> scenes{"cabinet", "lattices"};  ///< whose gratings are drawn
};

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double resident_mb() {
    std::ifstream file("/proc/self/statm");
    double pages = 0.0;
    double resident = 0.0;
    file >> pages >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

std::filesystem::path cooked(const std::string& name) {
    return program_prefix() / "cooked" / name;
}

/// A grid of discs and spheres, in turn, that fills the picture.
class Level {
 public:
    /// Without materials it is plain metal.
    Level(const Options& options, int count, const Palette& materials, gpu::Framebuffer& picture)
        : renderer_(post::xyz_to_scene_linear(post::OcioConfig::shipped())), picture_(picture) {
        modules::register_material_types(renderer_);
        const auto probe = asset::load(cooked(options.probe + ".probe"), "probe", lighting::kLightProbeVersion);
        renderer_.set_probe(lighting::deserialise(probe.payload, options.probe));
        renderer_.use_key_lights(true);
        const auto disc = render::make_mesh_instance(
            scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.2, .outer_radius = 1.0, .rings = 6, .segments = 64}));
        const auto sphere = render::make_mesh_instance(
            scene::build_mesh(scene::SphereRecipe{.radius = 0.9, .rings = 24, .segments = 48}));
        const double aspect = static_cast<double>(options.size.x) / options.size.y;
        const int columns = std::max(1, static_cast<int>(std::lround(std::sqrt(count * aspect))));
        const int rows = (count + columns - 1) / columns;
        const glm::quat facing = glm::angleAxis(1.2F, glm::vec3(1.0F, 0.0F, 0.0F));
        for (int i = 0; i < count; ++i) {
            const ecs::Entity entity = world_.create();
            const int column = i % columns;
            const int row = i / columns;
            const glm::vec3 at(static_cast<float>(2 * column - (columns - 1)), static_cast<float>(2 * row - (rows - 1)),
                               0.0F);
            world_.add(entity, scene::Transform{.translation = at, .rotation = facing});
            world_.add(entity, render::MeshInstance(i % 2 == 0 ? disc : sphere));
            world_.add(entity,
                       render::StandardMaterial{.base_colour = glm::vec3(0.9F), .metallic = 1.0F, .roughness = 0.3F});
            if (materials.flat.empty()) continue;
            const Materials& suited = i % 2 == 0 ? materials.flat : materials.curved;
            const auto& material = suited[static_cast<std::size_t>(i / 2) % suited.size()];
            diffraction::add_surface(world_, entity, {.material = material}, true);
        }
        camera_.vertical_field_of_view = 0.6F;
        camera_.eye.z = static_cast<float>(std::max(rows, 1)) / std::tan(0.3F);
        camera_.near_plane = 0.01F * camera_.eye.z;
        scene::update_world_matrices(world_);
    }

    /// Until the picture is there.
    double draw_ms() {
        const Clock::time_point start = Clock::now();
        renderer_.render(world_, camera_, picture_);
        glFinish();
        return ms_since(start);
    }
    void settle() {
        for (int frame = 0; frame < 4; ++frame) draw_ms();
        while (diffraction::maps_are_filling(world_)) draw_ms();
    }
    ecs::World& world() { return world_; }

 private:
    render::Renderer renderer_;
    gpu::Framebuffer& picture_;
    ecs::World world_;
    scene::Camera camera_;
};

/// The gratings of cooked scenes that nothing is seen through, each once.
Palette materials_of(const std::vector<std::string>& scenes) {
    Palette palette;
    for (const std::string& scene_name : scenes) {
        const std::string name = scene_name + ".scene";
        render::Renderer renderer(post::xyz_to_scene_linear(post::OcioConfig::shipped()));
        modules::register_material_types(renderer);
        ecs::World world;
        std::vector<std::filesystem::path> read_files;
        const auto registry = modules::asset_types();
        const scene::ImportedScene scene = live::load_scene(*registry, cooked(name), {}, read_files);
        render::instantiate(world, scene, renderer, name);
        world.view<diffraction::DiffractionSurface>().each([&](ecs::Entity,
                                                               const diffraction::DiffractionSurface& surface) {
            const std::optional<diffraction::BudgetRecord>& measured = surface.material->cooked()->measured;
            if (!measured || surface.material->base().passes_light) return;
            Materials& materials = measured->surface == diffraction::SurfaceShape::Flat ? palette.flat : palette.curved;
            if (std::ranges::find(materials, surface.material) == materials.end())
                materials.push_back(surface.material);
        });
    }
    return palette;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

void compare_with_plain(const Options& options, const Palette& materials, gpu::Framebuffer& picture) {
    std::printf("%8s %10s %10s %7s %13s %13s %7s %12s\n", "gratings", "plain ms", "ms", "ratio", "plain start",
                "start ms", "ratio", "MB beyond");
    for (const int count : options.counts) {
        Clock::time_point start = Clock::now();
        const double before = resident_mb();
        Level plain(options, count, {}, picture);
        plain.draw_ms();
        const double plain_start = ms_since(start);
        const double plain_mb = resident_mb() - before;
        start = Clock::now();
        Level gratings(options, count, materials, picture);
        gratings.draw_ms();
        const double gratings_start = ms_since(start);
        gratings.settle();
        const double gratings_mb = resident_mb() - before - plain_mb;
        double plain_ms = 1e9;
        double gratings_ms = 1e9;
        for (int round = 0; round < options.rounds; ++round) {
            plain_ms = std::min(plain_ms, plain.draw_ms());
            gratings_ms = std::min(gratings_ms, gratings.draw_ms());
        }
        std::printf("%8d %10.2f %10.2f %7.2f %13.0f %13.0f %7.2f %12.1f\n", count, plain_ms, gratings_ms,
                    gratings_ms / plain_ms, plain_start, gratings_start, gratings_start / plain_start, gratings_mb);
        std::fflush(stdout);
    }
}

/// Draws under a budget: the time that was taken and the error, each the median over 100 frames.
void measure_budgets(const Options& options, const Palette& materials, gpu::Framebuffer& picture) {
    constexpr int kFrames = 100;
    Level level(options, options.budget_count, materials, picture);
    const ecs::Entity holder = level.world().create();
    const auto draw = [&](double ms, int frames) {
        level.world().add(holder, diffraction::FrameBudget{ms});
        std::vector<diffraction::FrameBudgetReport> reports;
        for (int frame = 0; frame < frames; ++frame) {
            level.draw_ms();
            reports.push_back(level.world().get<diffraction::FrameBudgetReport>(holder));
        }
        return reports;
    };
    const auto middle = [](const std::vector<diffraction::FrameBudgetReport>& reports,
                           double diffraction::FrameBudgetReport::*value) {
        std::vector<double> values;
        for (const auto& report : reports) values.push_back(report.*value);
        return median(values);
    };
    draw(1e9, 4);
    while (diffraction::maps_are_filling(level.world())) draw(1e9, 1);
    const auto free = draw(1e9, kFrames);
    const double free_ms = middle(free, &diffraction::FrameBudgetReport::spent_ms);
    std::printf("\n%d gratings, not limited: %.2f ms of the GPU, error × %.3f\n", options.budget_count, free_ms,
                middle(free, &diffraction::FrameBudgetReport::error));
    const auto cheapest = (draw(1e-6, 150), draw(1e-6, kFrames));
    std::printf("cheapest: %.2f ms, error × %.3f\n", middle(cheapest, &diffraction::FrameBudgetReport::spent_ms),
                middle(cheapest, &diffraction::FrameBudgetReport::error));
    std::printf("%8s %10s %10s %7s %10s %9s %9s\n", "part", "budget ms", "ms", "ratio", "predicted", "error ×",
                "changing");
    for (const double part : {0.9, 0.75, 0.5, 0.25, 0.1}) {
        draw(part * free_ms, 400);
        const auto reports = draw(part * free_ms, kFrames);
        int changing = 0;
        for (const auto& report : reports) changing += report.fading > 0 ? 1 : 0;
        const double ms = middle(reports, &diffraction::FrameBudgetReport::spent_ms);
        std::printf("%8.2f %10.2f %10.2f %7.2f %10.2f %9.3f %9d\n", part, part * free_ms, ms, ms / (part * free_ms),
                    middle(reports, &diffraction::FrameBudgetReport::predicted_ms),
                    middle(reports, &diffraction::FrameBudgetReport::error), changing);
        std::fflush(stdout);
    }
    // Other programs take the processors.
    const double budget = 0.6 * free_ms;
    draw(budget, 150);
    std::atomic<bool> stop = false;
    std::vector<std::jthread> load;
    for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i)
        load.emplace_back([&] {
            while (!stop) std::this_thread::yield();
        });
    const auto loaded = draw(budget, 60);
    stop = true;
    std::printf("under a sudden load, budget %.2f ms; taken in frames 1, 2, …:", budget);
    for (const auto& report : loaded) std::printf(" %.1f", report.last_ms);
    std::printf("\n");
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app{
        "Frames of many gratings against those of plain metal, interleaved, and what frame budgets make of them.",
        "rowland-level-benchmark"};
    app.footer("example: rowland-level-benchmark --counts 1,100 --rounds 30");
    app.add_option("--width", options.size.x, "Width in pixels")->check(CLI::Range(16, 8192))->capture_default_str();
    app.add_option("--height", options.size.y, "Height in pixels")->check(CLI::Range(16, 8192))->capture_default_str();
    app.add_option("--counts", options.counts, "Numbers of gratings, with commas between them")
        ->delimiter(',')
        ->check(CLI::Range(1, 10000));
    app.add_option("--rounds", options.rounds, "Frames of each, whose minimum counts")->check(CLI::Range(1, 10000));
    app.add_option("--budget-count", options.budget_count, "Gratings of the scene under budgets; 0: skip it")
        ->check(CLI::Range(0, 10000));
    app.add_option("--scenes", options.scenes,
                   "Names of cooked scenes whose gratings are drawn, with commas between them")
        ->delimiter(',');
    app.add_option("--probe", options.probe, "Name of a cooked probe")->capture_default_str();
    if (!parse_command_line(app, argc, argv)) return 0;
    const platform::HeadlessContext context({.debug = false});
    gpu::Framebuffer picture({.width = options.size.x, .height = options.size.y, .depth = true});
    const Palette materials = materials_of(options.scenes);
    std::printf("%s, %d × %d, %zu materials of flat surfaces, %zu of curved ones, %s\n",
                reinterpret_cast<const char*>(glGetString(GL_RENDERER)), options.size.x, options.size.y,
                materials.flat.size(), materials.curved.size(), options.probe.c_str());
    compare_with_plain(options, materials, picture);
    if (options.budget_count > 0) measure_budgets(options, materials, picture);
    return 0;
}

}  // namespace
}  // namespace rowland

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::run(argc, argv); });
}
