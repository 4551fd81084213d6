// The results that `./rowland gpu` gathers, as one page.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "engine/command_line/command_line.h"
#include "engine/core/file.h"
#include "engine/core/program.h"
#include "tests/gpu_report/report.h"

namespace rowland {
namespace {

using namespace gpu_report;

constexpr std::uint64_t kMostResultBytes = 1 << 26;

struct Options {
    std::filesystem::path folder;
    std::string revision = "unknown";
    std::vector<std::string> tests;
    std::vector<std::string> sizes;
};

std::optional<Options> parse_options(int argc, char** argv) {
    Options options;
    CLI::App app{
        "One page of the tests' results and frame times that ./rowland gpu gathers, into FOLDER/report.md. Exit\n"
        "code 1 if a test failed.",
        "rowland-gpu-report"};
    app.footer("example: rowland-gpu-report build/gpu --tests test_gpu,test_gpu_scene --sizes 1920x1080");
    app.add_option("folder", options.folder, "Holds TEST.json, frames-SIZE.json and flight-SIZE.json")->required();
    app.add_option("--revision", options.revision, "Of the sources");
    app.add_option("--tests", options.tests, "Programs of tests, with commas between them")->delimiter(',')->required();
    app.add_option("--sizes", options.sizes, "Sizes of pictures, with commas between them")->delimiter(',')->required();
    if (!parse_command_line(app, argc, argv)) return std::nullopt;
    return options;
}

nlohmann::json read_json(const std::filesystem::path& path) {
    return nlohmann::json::parse(read_text_file(path, kMostResultBytes));
}

int run(int argc, char** argv) {
    const std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    Report report{.revision = options->revision, .tests = {}, .sizes = {}};
    for (const std::string& test : options->tests) {
        const std::filesystem::path path = options->folder / (test + ".json");
        std::optional<std::string> results;
        if (std::filesystem::exists(path)) results = read_text_file(path, kMostResultBytes);
        report.tests.push_back(results_of(test, results));
    }
    for (const std::string& size : options->sizes)
        report.sizes.push_back({read_json(options->folder / ("frames-" + size + ".json")),
                                read_json(options->folder / ("flight-" + size + ".json"))});
    write_file_atomic(options->folder / "report.md", to_markdown(report));
    return all_passed(report) ? 0 : 1;
}

}  // namespace
}  // namespace rowland

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::run(argc, argv); });
}
