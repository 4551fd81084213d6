#include <chrono>
#include <cstdio>
#include <utility>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/capture.h"
#include "content/demo/demo_scene.h"
#include "content/demo/options.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "engine/gpu/debug.h"
#include "engine/platform/headless_context.h"
#include "engine/post/display_pass.h"
#include "engine/post/shader_files.h"
#include "engine/post/working_space.h"
#include "engine/render/renderer.h"
#include "modules/diffraction/module.h"

namespace rowland::demo {
namespace {

constexpr double kSecondsPerFrame = 1.0 / 30.0;
constexpr int kSamples = 4;  ///< a pixel, against jagged edges

/// A probe, and where its pictures go.
struct Job {
    std::filesystem::path probe;
    std::optional<std::filesystem::path> capture;
    std::optional<std::filesystem::path> capture_linear;
};

std::vector<Job> jobs(const Options& options) {
    const bool named = options.capture || options.capture_linear;
    std::vector<std::filesystem::path> probes;
    if (options.probe)
        probes = {*options.probe};
    else if (named)
        probes = {options.cooked_folder / "studio.probe"};
    else
        probes = {options.cooked_folder / "studio.probe", options.cooked_folder / "clear_sky.probe"};

    std::vector<Job> result;
    for (const std::filesystem::path& probe : probes) {
        if (named)
            result.push_back({probe, options.capture, options.capture_linear});
        else
            result.push_back({probe, options.output_folder / (probe.stem().string() + ".png"), std::nullopt});
    }
    return result;
}

/// Everything that lives as long as the GL context.
class Demo {
 public:
    Demo(const Options& options, const post::OcioConfig& config)
        : options_(options),
          xyz_to_working_(post::xyz_to_scene_linear(config)),
          renderer_(xyz_to_working_),
          scene_(sources()),
          display_(make_display(config)),
          multisampled_({.width = options.width, .height = options.height, .depth = true, .samples = kSamples}),
          linear_({.width = options.width, .height = options.height}),
          encoded_({.width = options.width, .height = options.height, .colours = {gpu::Format::RGBA8}}) {
        if (options.light_window == "auto")
            diffraction::register_module(renderer_);
        else
            diffraction::register_module(renderer_, math::parse_window(options.light_window));
    }

    void run(const Job& job) {
        renderer_.set_probe(load_probe(job.probe, options_.probe_mapping));
        for (int frame = 0; frame < options_.frames; ++frame) {
            scene_.advance_to(frame * kSecondsPerFrame);
            renderer_.render(scene_.world(), scene_.camera(), multisampled_);
            multisampled_.resolve_to(linear_);
            display_.draw(linear_.colour(), options_.exposure_stops, encoded_);
            if (job.capture_linear) {
                const auto path = numbered(*job.capture_linear, frame, options_.frames);
                write_linear_capture(linear_, path);
                log_info("wrote {}", path.string());
            }
            if (job.capture) {
                const auto path = numbered(*job.capture, frame, options_.frames);
                write_display_capture(encoded_, path);
                log_info("wrote {}", path.string());
            }
        }
    }

 private:
    SceneSources sources() const {
        SceneSources result;
        result.grating_is_disc = !options_.mesh;
        result.grating = load_mesh(options_.mesh.value_or(options_.cooked_folder / "cd.glb"));
        result.sphere = load_mesh(options_.cooked_folder / "sphere.glb");
        result.ground = load_mesh(options_.cooked_folder / "ground.glb");
        const auto cooked = load_material(options_.material.value_or(options_.cooked_folder / "cd.material"));
        result.material = std::make_shared<const diffraction::GpuSpikeMaterial>(cooked, xyz_to_working_);
        return result;
    }
    post::DisplayPass make_display(const post::OcioConfig& config) const {
        gpu::ShaderLibrary library;
        library.add_embedded(post::shader_files());
        return {library, post::DisplayTransform(config, {.display = {}, .view = options_.view})};
    }

    const Options& options_;
    glm::dmat3 xyz_to_working_;
    render::Renderer renderer_;
    DemoScene scene_;
    post::DisplayPass display_;
    gpu::Framebuffer multisampled_;
    gpu::Framebuffer linear_;
    gpu::Framebuffer encoded_;
};

int run(int argc, char** argv) {
    std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    if (options->cooked_folder.empty()) options->cooked_folder = default_cooked_folder();
    const post::OcioConfig config = post::OcioConfig::choose(options->ocio_config);
    if (options->list_views) {
        for (const std::string& view : config.views(config.default_display())) std::puts(view.c_str());
        return 0;
    }
    const platform::HeadlessContext context;
    gpu::enable_debug_output(false);
    log_info("rendering on {}", context.renderer());
    const auto started = std::chrono::steady_clock::now();
    Demo demo(*options, config);
    for (const Job& job : jobs(*options)) demo.run(job);
    log_info("done in {:.1f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count());
    return 0;
}

}  // namespace
}  // namespace rowland::demo

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::demo::run(argc, argv); });
}
