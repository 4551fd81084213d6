// What AMD's shader compiler makes of each frame of the benchmark, without a GPU.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>

#include "engine/command_line/command_line.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "tests/gpu_cost/captured_frames.h"
#include "tests/gpu_cost/cost_table.h"
#include "tests/support/files.h"

namespace rowland {
namespace {

using namespace gpu_cost;

constexpr const char* kAssumptions =
    "× plain: cycles over those of the frame 'plain'. cycles: the compiler's \"inverse throughput\" of 64 pixels or\n"
    "vertices: the busiest unit's work or, if greater, the latency that other waves cannot hide. instr: instructions\n"
    "that run. fetch: those of them that read textures, buffers or attributes. waves: what a SIMD unit holds.\n"
    "Assumed: caches hit. Loops over lights, streak segments and constants run as often as in the frame, those over a\n"
    "pixel's parts once, others whose length the pixel computes 8 times. Three waves of four enter a branch;\n"
    "half of them one that all pixels decide alike. FRAME/pass:1 and on: what the frame's effect draws before, per "
    "pixel\n"
    "of its own; those of ambient occlusion are a quarter of the picture's.\n";

struct Options {
    std::vector<std::string> only;
    std::optional<std::filesystem::path> json;
    std::optional<std::filesystem::path> check;
};

/// nullopt if only help was asked for.
std::optional<Options> parse_options(int argc, char** argv) {
    Options options;
    CLI::App app{
        "What AMD's shader compiler makes of the benchmark's frames: instructions, fetches, registers, waves and\n"
        "cycles, as × plain, for two generations. Needs no GPU.",
        "rowland-gpu-cost"};
    app.footer(
        std::string(kAssumptions) +
        "\nexample: rowland-gpu-cost --only 'planar,arc*' --json cost.json\n"
        "needs Mesa's Vulkan driver of AMD's GPUs and glslangValidator (Debian: mesa-vulkan-drivers glslang-tools)");
    CLI::Option* only = app.add_option("--only", options.only,
                                       "Names or patterns of rowland-benchmark's frames, with commas between them")
                            ->delimiter(',');
    app.add_option("--json", options.json, "Also write the results to a file");
    app.add_option("--check", options.check,
                   "Compare with such a file: exit code 1 if a ratio has grown by more than 5 %")
        ->excludes(only);
    if (!parse_command_line(app, argc, argv)) return std::nullopt;
    return options;
}

/// Registers and waves of the program as it is; all else of the one whose loops are written out.
StageCost stage_cost(const StageStatistics& as_drawn, StageStatistics unrolled) {
    unrolled.vector_registers = as_drawn.vector_registers;
    unrolled.waves = as_drawn.waves;
    return {unrolled, 0.0};
}

/// A frame's program as SPIR-V.
struct CompiledFrame {
    std::string name;
    Spirv as_drawn;
    Spirv unrolled;
};

CompiledFrame compile_frame(const CapturedFrame& frame) {
    const ProgramText text = for_vulkan(frame.text);
    return {frame.name, compile_to_spirv(text), compile_to_spirv(with_loops_unrolled(text, frame.lengths))};
}

std::vector<CompiledFrame> compile_frames(std::vector<std::string> patterns) {
    const test::TemporaryFolder folder;
    if (!patterns.empty()) patterns.emplace_back("plain");
    capture_programs(folder.path(), patterns);
    const std::vector<CapturedFrame> frames = read_frames(folder.path());
    std::vector<CompiledFrame> compiled;
    Progress progress("SPIR-V", frames.size());
    for (const CapturedFrame& frame : frames) {
        compiled.push_back(compile_frame(frame));
        progress.advance();
    }
    return compiled;
}

GenerationCost cost_of(const Generation& generation, const AmdCompiler& compiler,
                       const std::vector<CompiledFrame>& frames) {
    GenerationCost cost{generation.name, compiler.device(), compiler.driver(), {}};
    Progress progress(generation.name, frames.size());
    for (const CompiledFrame& frame : frames) {
        const PipelineStatistics as_drawn = compiler.compile(frame.as_drawn);
        const PipelineStatistics unrolled = compiler.compile(frame.unrolled);
        cost.frames.push_back({frame.name, stage_cost(as_drawn.fragment, unrolled.fragment),
                               stage_cost(as_drawn.vertex, unrolled.vertex)});
        progress.advance();
    }
    divide_by_plain(cost);
    return cost;
}

int check(const std::vector<GenerationCost>& costs, const std::filesystem::path& file) {
    const Comparison comparison = compare_with(read_text_file(file, 1 << 24), file.string(), costs);
    for (const std::string& line : comparison.grown) std::printf("grown: %s\n", line.c_str());
    if (!comparison.same_driver) std::printf("not compared: %s is by another version of Mesa\n", file.c_str());
    return comparison.grown.empty() ? 0 : 1;
}

int run(int argc, char** argv) {
    const std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    if (options->json) check_outputs({}, std::array{Output{"--json", *options->json}});
    // First, as it may fail, and frames take a minute.
    std::vector<std::unique_ptr<AmdCompiler>> compilers;
    for (const Generation& generation : generations()) compilers.push_back(std::make_unique<AmdCompiler>(generation));
    const std::vector<CompiledFrame> frames = compile_frames(options->only);
    std::vector<GenerationCost> costs;
    for (std::size_t i = 0; i < compilers.size(); ++i) {
        costs.push_back(cost_of(generations()[i], *compilers[i], frames));
        std::printf("%s\n", to_text(costs.back()).c_str());
    }
    std::fputs(kAssumptions, stdout);
    if (options->json) write_file_atomic(*options->json, to_json(costs));
    return options->check ? check(costs, *options->check) : 0;
}

}  // namespace
}  // namespace rowland

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::run(argc, argv); });
}
