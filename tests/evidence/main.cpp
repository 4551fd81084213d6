// rowland-evidence: the models beside measurements, and beside what others would use, as one page.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/command_line/command_line.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "tests/evidence/section.h"

namespace rowland::evidence {

namespace {

struct Options {
    std::filesystem::path output = "evidence.html";
    std::optional<std::filesystem::path> json;
    std::vector<std::string> only;
    Inputs inputs;
};

/// nullopt if only help was asked for.
std::optional<Options> parse_options(int argc, char** argv) {
    std::vector<std::string> names;
    for (const Section& section : sections()) names.emplace_back(section.name);
    const char* data = std::getenv("ROWLAND_DATA");
    Options options;
    options.inputs.data = data != nullptr ? data : ROWLAND_SOURCE_FOLDER "/../shared";
    CLI::App app(
        "Measured gratings, discs in photographs, indices of metals, and other models on the same disc, as one page.",
        "rowland-evidence");
    app.footer(
        "Sections: curves, photographs, metals, peers, pit_sequence, and on request level, which needs the rooms\n"
        "(./rowland rooms) and ten minutes.\n"
        "Example:\n  rowland-evidence --only curves,metals --json figures.json -o evidence.html");
    app.add_option("-o,--output", options.output, "The page, HTML")->capture_default_str()->type_name("FILE");
    app.add_option("--json", options.json, "Also write what was measured, without the page")->type_name("FILE");
    app.add_option("--only", options.only, "Sections, with commas between them; without it all but level")
        ->delimiter(',')
        ->check(CLI::IsMember(names));
    app.add_option("--data", options.inputs.data, "Folder of the measured data and the probes (also $ROWLAND_DATA)")
        ->capture_default_str()
        ->type_name("FOLDER");
    if (!parse_command_line(app, argc, argv)) return std::nullopt;
    return options;
}

int run(int argc, char** argv) {
    const std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    std::vector<Output> outputs{{"--output", options->output, ".html"}};
    if (options->json) outputs.push_back({"--json", *options->json, ".json"});
    check_outputs({}, outputs);
    Json measured = Json::array();
    for (const Section& section : sections()) {
        const bool is_named = std::ranges::find(options->only, section.name) != options->only.end();
        if (options->only.empty() ? section.on_request : !is_named) continue;
        log_info("measuring: {}", section.name);
        Json json = section.measure(options->inputs);
        json["name"] = section.name;
        measured.push_back(std::move(json));
    }
    write_file_atomic(options->output, page_html(measured));
    if (options->json) write_file_atomic(*options->json, measured.dump(1) + '\n');
    return 0;
}

}  // namespace

}  // namespace rowland::evidence

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::evidence::run(argc, argv); });
}
