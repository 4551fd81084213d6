// Frame times of every representation against the plain material, all variants interleaved in one run.
#include <CLI/CLI.hpp>

#include "engine/command_line/command_line.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "tests/benchmark/frame_report.h"
#include "tests/benchmark/frame_stage.h"
#include "tests/benchmark/program_log.h"

namespace rowland {
namespace {

using namespace benchmark;

constexpr int kFramesPerRound = 2;          ///< in sequence: the second has warm caches
constexpr double kMost_ms_per_round = 250;  ///< of a variant: slower ones skip rounds

struct Options {
    glm::ivec2 size{1280, 720};
    int rounds = 4;
    std::vector<std::string> only;
    bool list = false;
    bool require_gpu = false;
    std::optional<std::filesystem::path> json;
    std::optional<std::filesystem::path> output_folder;
    std::optional<std::filesystem::path> programs;
};

/// nullopt if only help was asked for.
std::optional<Options> parse_options(int argc, char** argv) {
    Options options;
    CLI::App app{"Frame times of the diffraction material against the plain one: minima over interleaved rounds.",
                 "rowland-benchmark"};
    app.footer(
        "A name is REPRESENTATION[/WHAT IS DIFFERENT]; --list prints all. Ratios are to the frame in the last column,\n"
        "which is drawn as well: of the time until the picture is done, and of the GPU's own time, or where the\n"
        "processor draws of the time of all its threads, which other programs hardly disturb.\n"
        "example: rowland-benchmark --only 'planar*,arc' --rounds 30 --json frames.json");
    app.add_option("--width", options.size.x, "Width in pixels")->check(CLI::Range(16, 8192))->capture_default_str();
    app.add_option("--height", options.size.y, "Height in pixels")->check(CLI::Range(16, 8192))->capture_default_str();
    app.add_option("--rounds", options.rounds, "Rounds; each draws every variant twice, slow ones more rarely")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app.add_option("--only", options.only, "Names or patterns, with commas between them")->delimiter(',');
    app.add_flag("--list", options.list, "Print the names of all variants and draw nothing");
    app.add_option("--json", options.json, "Also write the results to a file");
    app.add_option("--output-folder", options.output_folder,
                   "Also write results and table to frames-RENDERER.json and .txt in a folder");
    app.add_flag("--require-gpu", options.require_gpu, "Fail where the processor draws");
    app.add_option("--programs", options.programs,
                   "Write the GLSL of all programs, and which one draws each frame's disc, to a folder; times nothing");
    if (!parse_command_line(app, argc, argv)) return std::nullopt;
    return options;
}

double mean_radiance(const gpu::Framebuffer& picture) {
    const std::vector<glm::vec4> pixels = picture.read_rgba_float();
    double sum = 0.0;
    for (const glm::vec4& pixel : pixels) sum += static_cast<double>(pixel.r + pixel.g + pixel.b) / 3.0;
    return sum / static_cast<double>(pixels.size());
}

/// The fraction of the pixels that show the disc: those that differ between the plain and the unlit frame.
double coverage(FrameStage& stage, bool software) {
    FrameVariant variant = all_variants().front();
    FrameScene(variant, stage, software).draw();
    const std::vector<glm::vec4> lit = stage.picture().read_rgba_float();
    variant.shader = Shader::Unlit;
    FrameScene(variant, stage, software).draw();
    const std::vector<glm::vec4> unlit = stage.picture().read_rgba_float();
    std::size_t differing = 0;
    for (std::size_t i = 0; i < lit.size(); ++i) differing += lit[i] != unlit[i] ? 1U : 0U;
    return static_cast<double>(differing) / static_cast<double>(lit.size());
}

/// A variant while it is timed.
struct Timed {
    FrameScene scene;
    double mean_radiance;
    std::vector<double> wall_ms = {};
    std::vector<double> work_ms = {};
    double spent_ms = 0.0;
};

FrameResult result_of(Timed& timed) {
    std::sort(timed.wall_ms.begin(), timed.wall_ms.end());
    return {.name = timed.scene.variant().name,
            .baseline = timed.scene.variant().baseline,
            .minimum_ms = timed.wall_ms.front(),
            .median_ms = timed.wall_ms[timed.wall_ms.size() / 2],
            .work_ms = *std::min_element(timed.work_ms.begin(), timed.work_ms.end()),
            .mean_radiance = timed.mean_radiance};
}

std::vector<Timed> prepare(const Options& options, FrameStage& stage, bool software) {
    const std::vector<FrameVariant> variants = choose_variants(options.only);
    std::vector<Timed> timed;
    Progress progress("preparing", variants.size());
    for (const FrameVariant& variant : variants) {
        FrameScene scene(variant, stage, software);
        scene.settle();
        timed.push_back({std::move(scene), mean_radiance(stage.picture())});
        progress.advance();
    }
    return timed;
}

void time_frames(Timed& timed) {
    for (int frame = 0; frame < kFramesPerRound; ++frame) {
        const FrameTime time = timed.scene.draw();
        timed.wall_ms.push_back(time.wall_ms);
        timed.work_ms.push_back(time.work_ms);
        timed.spent_ms += time.wall_ms;
    }
}

std::vector<FrameResult> measure(const Options& options, FrameStage& stage, bool software) {
    std::vector<Timed> timed = prepare(options, stage, software);
    Progress progress("frames", static_cast<std::size_t>(options.rounds) * timed.size());
    for (int round = 0; round < options.rounds; ++round)
        for (Timed& one : timed) {
            if (one.spent_ms <= round * kMost_ms_per_round) time_frames(one);
            progress.advance();
        }
    std::vector<FrameResult> results;
    for (Timed& one : timed) results.push_back(result_of(one));
    return results;
}

int run(int argc, char** argv) {
    const std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    if (options->list) {
        for (const FrameVariant& variant : all_variants()) std::printf("%s\n", variant.name.c_str());
        return 0;
    }
    std::vector<Output> outputs;
    if (options->json) outputs.push_back({"--json", *options->json});
    if (options->output_folder) outputs.push_back({"--output-folder", *options->output_folder / "frames.json"});
    if (options->programs) outputs.push_back({"--programs", *options->programs / "programs.json"});
    check_outputs({}, outputs);
    const platform::HeadlessContext context({.debug = false});
    FrameReport report = describe_machine(context);
    if (options->require_gpu && report.software)
        fail_system("--require-gpu", report.renderer + " draws, no GPU with OpenGL 4.5 and EGL",
                    "run it without the option, or on another machine");
    if (options->programs) {
        write_programs(*options->programs, choose_variants(options->only), options->size, report.software);
        return 0;
    }
    FrameStage stage(options->size, diffraction::MapPace::Whole);
    report.size = options->size;
    report.rounds = options->rounds;
    report.results = measure(*options, stage, report.software);
    report.coverage = coverage(stage, report.software);

    std::fputs(to_text(report).c_str(), stdout);
    if (options->json) write_file_atomic(*options->json, to_json(report));
    if (options->output_folder) {
        const std::filesystem::path base = *options->output_folder / ("frames-" + file_name_of(report.renderer));
        write_file_atomic(base.string() + ".json", to_json(report));
        write_file_atomic(base.string() + ".txt", to_text(report));
    }
    return 0;
}

}  // namespace
}  // namespace rowland

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::run(argc, argv); });
}
