// Times of the parts that run on the processor, without a frame around them. Google Benchmark's own options apply, such
// as --benchmark_filter=sh_ and --benchmark_format=json.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "engine/core/program.h"
#include "engine/math/frame_rotation.h"
#include "tests/benchmark/microbenchmarks.h"
#include "tests/benchmark/processor.h"

namespace rowland::microbenchmark {
namespace {

std::string counters_of(const ::benchmark::UserCounters& counters) {
    std::string text;
    for (const auto& [name, counter] : counters)
        text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", name, counter.value);
    return text;
}

/// Prints to the console as Google Benchmark does, and keeps the runs as a Markdown table.
class MarkdownReporter final : public ::benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs)
            rows_ += fmt::format("| {} | {:.4g} {} | {} |\n", run.benchmark_name(), run.GetAdjustedRealTime(),
                                 ::benchmark::GetTimeUnitString(run.time_unit), counters_of(run.counters));
    }
    std::string table() const { return "| part | time | |\n| --- | --- | --- |\n" + rows_; }

 private:
    std::string rows_;
};

/// Takes `--markdown-file=FILE` out of the arguments.
std::optional<std::string> take_markdown_file(int& argc, char** argv) {
    const std::string option = "--markdown-file=";
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument.rfind(option, 0) != 0) continue;
        for (int j = i; j + 1 < argc; ++j) argv[j] = argv[j + 1];
        --argc;
        return argument.substr(option.size());
    }
    return std::nullopt;
}

void register_all() {
    register_sh_evaluation();
    register_sh_rotation();
    register_frame_rotation();
    register_vertex_updates();
    register_projection();
    register_key_lights();
    register_bakes();
    register_brute_force();
    register_map_fills();
    register_entities();
}

int run(int argc, char** argv) {
    const std::optional<std::string> markdown_file = take_markdown_file(argc, argv);
    ::benchmark::Initialize(&argc, argv);
    if (::benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    ::benchmark::AddCustomContext("processor", processor_name());
    ::benchmark::AddCustomContext("instruction set", instruction_set_name(math::best_instruction_set()));
    register_all();
    if (markdown_file) {
        MarkdownReporter reporter;
        ::benchmark::RunSpecifiedBenchmarks(&reporter);
        write_file_atomic(*markdown_file, processor_name() + "\n\n" + reporter.table());
    } else {
        ::benchmark::RunSpecifiedBenchmarks();
    }
    ::benchmark::Shutdown();
    return 0;
}

}  // namespace
}  // namespace rowland::microbenchmark

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::microbenchmark::run(argc, argv); });
}
