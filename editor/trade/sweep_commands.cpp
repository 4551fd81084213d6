#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <memory>

#include "editor/trade/commands.h"
#include "editor/trade/inputs.h"
#include "editor/trade/paper_figures.h"
#include "editor/trade/report.h"
#include "editor/trade/sweep.h"
#include "editor/trade/sweep_plan.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/text.h"

namespace rowland::trade {

namespace {

constexpr int kMagnified = 3;

struct SweepOptions {
    std::vector<std::filesystem::path> materials;
    std::vector<std::string> probes;
    std::string mapping = "auto";
    std::vector<std::string> frames;  ///< NAME=FILE
    std::vector<std::string> settings;
    std::vector<int> picture_size = {160, 90};
    std::vector<int> frame_size = {640, 360};
    bool no_times = false;
    std::filesystem::path output;
};

void add_options(CLI::App& command, SweepOptions& options) {
    command.add_option("--material", options.materials, "Material, JSON; may be given several times")
        ->required()
        ->type_name("FILE");
    command
        .add_option(
            "--probe", options.probes,
            "Light probe, Radiance .hdr or OpenEXR; may be given several times. FILE:angular and FILE:equirect\n"
            "name its mapping. The first one lights the timed frames")
        ->required()
        ->type_name("FILE[:MAPPING]");
    add_probe_mapping(command, options.mapping);
    command
        .add_option("--frames", options.frames,
                    "A further set of frames, CSV vx,vy,vz,nx,ny,nz,gx,gy,gz; may be given several times. One named\n"
                    "tilted_cd or sphere replaces the built-in set")
        ->type_name("NAME=FILE");
    command
        .add_option("--setting", options.settings,
                    "Measures these settings in place of the plan, such as arc/bands=5/rank=8/key_lights=16: a\n"
                    "representation, then what a material file's \"quality\" takes, key_lights as a number, and window")
        ->type_name("SETTING");
    command.add_option("--picture-size", options.picture_size, "Pixels of the picture that errors are measured on")
        ->expected(2)
        ->check(CLI::Range(8, 1024))
        ->capture_default_str();
    command.add_option("--frame-size", options.frame_size, "Pixels of the frames that are timed")
        ->expected(2)
        ->check(CLI::Range(8, 8192))
        ->capture_default_str();
    command.add_flag("--no-times", options.no_times, "Times no frames; needs no OpenGL");
    command.add_option("--output", options.output, "Folder of the results. A stopped sweep continues in its folder")
        ->required()
        ->type_name("FOLDER");
}

/// The name and the file of NAME=FILE.
std::pair<std::string, std::filesystem::path> parse_frames(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || text.find(',') < equals)
        refuse_input("--frames", "", fmt::format("\"{}\"", text), "NAME=FILE, without a comma in the name");
    return {valid_utf8(text.substr(0, equals)), text.substr(equals + 1)};
}

/// Throws Error (input), also where the results cannot be written.
SweepInputs inputs_of(const SweepOptions& options, std::initializer_list<const char*> result_files) {
    SweepInputs result{.materials = options.materials,
                       .probes = {},
                       .frame_sets = {tilted_cd_frames(), sphere_frames()},
                       .settings = {},
                       .picture_size = {options.picture_size[0], options.picture_size[1]},
                       .frame_size = {options.frame_size[0], options.frame_size[1]},
                       .times = !options.no_times,
                       .folder = options.output};
    for (const std::string& text : options.settings) result.settings.push_back(diffraction::parse_method(text));
    std::vector<std::filesystem::path> files = options.materials;
    for (const std::string& probe : options.probes) {
        result.probes.push_back(parse_probe_file(probe, options.mapping));
        files.push_back(result.probes.back().path);
    }
    for (const std::string& text : options.frames) files.push_back(parse_frames(text).second);
    for (const auto& material : options.materials)
        std::ranges::copy(files_named_in(diffraction::load_material_json(material), material.parent_path()),
                          std::back_inserter(files));
    std::vector<Output> outputs;
    for (const char* name : {"references.jsonl", "journal.jsonl"})
        outputs.push_back({"--output", options.output / name});
    for (const char* name : result_files) outputs.push_back({"--output", options.output / name});
    check_outputs(files, outputs);
    for (const std::string& text : options.frames) {
        const auto [name, file] = parse_frames(text);
        if (name == "picture") refuse_input("--frames", "", "the name picture", "another name");
        const auto same = std::ranges::find(result.frame_sets, name, &FrameSet::name);
        if (same != result.frame_sets.end())
            *same = frames_of_file(name, file);
        else
            result.frame_sets.push_back(frames_of_file(name, file));
    }
    return result;
}

SweepResults run_and_write(Sweep& sweep) {
    SweepResults results = sweep.run();
    write_file_atomic(sweep.inputs().folder / "sweep.jsonl", sweep_json_lines(results));
    write_file_atomic(sweep.inputs().folder / "sweep.csv", sweep_csv(results));
    return results;
}

void run_sweep(const SweepOptions& options) {
    Sweep sweep(inputs_of(options, {"sweep.csv", "sweep.jsonl"}));
    run_and_write(sweep);
    write_results(fmt::format("file\n{}\n{}\n", (options.output / "sweep.csv").string(),
                              (options.output / "sweep.jsonl").string()));
}

const MethodError& picture_error(const SweepResults& results, std::size_t material, std::size_t probe,
                                 std::size_t setting) {
    const auto found = std::ranges::find_if(results.errors, [&](const ErrorRow& row) {
        return row.set == "picture" && row.material == material && row.probe == probe && row.setting == setting;
    });
    ROWLAND_CHECK(found != results.errors.end(), "every setting has its picture's error");
    return found->error;
}

std::vector<DifferencePicture> difference_pictures(Sweep& sweep, const SweepResults& results) {
    std::vector<DifferencePicture> pictures;
    const PictureFrames& frames = sweep.picture_frames();
    for (std::size_t m = 0; m < results.materials.size(); ++m)
        for (std::size_t p = 0; p < results.probes.size(); ++p)
            for (const std::size_t s : pictured_settings(results, m, p)) {
                const diffraction::Method& setting = results.settings[m][s];
                const diffraction::MeasuredScene& scene = sweep.scene(m, p, frames.frames);
                const auto shown = scene.shaded(sweep.cook(m, setting), setting.key_lights, setting.window);
                pictures.push_back(
                    {.material = m,
                     .probe = p,
                     .setting = method_name(setting),
                     .error = picture_error(results, m, p, s),
                     .picture = difference_image(picture(frames, shown), picture(frames, scene.reference), frames.width,
                                                 frames.height, kMagnified)});
            }
    return pictures;
}

std::vector<TheoryError> theory_errors(Sweep& sweep, const SweepResults& results) {
    std::vector<TheoryError> errors;
    for (std::size_t m = 0; m < results.materials.size(); ++m)
        for (std::size_t p = 0; p < results.probes.size(); ++p) {
            const auto add = [&](const FrameSet& set) {
                if (const auto error = sweep.theory_error(m, p, set)) errors.push_back({m, p, set.name, *error});
            };
            for (const FrameSet& set : sweep.inputs().frame_sets) add(set);
            add(sweep.picture_frames().frames);
        }
    return errors;
}

std::string now() {
    return fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)));
}

void run_report(const SweepOptions& options, const std::string& command_line) {
    Sweep sweep(inputs_of(options, {"sweep.csv", "sweep.jsonl", "report.html"}));
    const SweepResults results = run_and_write(sweep);
    const auto differences = difference_pictures(sweep, results);
    const auto paper = paper_evidence(sweep.cook(0, paper_setting()), sweep.inputs().frame_size, sweep.inputs().times);
    ReportOrigin origin{.date = now(), .command = command_line, .theories = theory_errors(sweep, results)};
    for (std::size_t i = 0; i < results.probes.size(); ++i) {
        origin.probes.push_back(statistics_of(sweep.probe(i)));
        origin.films.push_back(film_rows(sweep.probe(i)));
    }
    const auto data = report_data(results, sweep.inputs(), differences, paper, origin);
    write_file_atomic(options.output / "report.html", report_html(data));
    write_results(fmt::format("file\n{}\n", (options.output / "report.html").string()));
}

}  // namespace

void add_sweep_commands(CLI::App& program, const std::string& command_line) {
    const auto options = std::make_shared<SweepOptions>();
    CLI::App* sweep =
        program.add_subcommand("sweep", "Measure error and cost of settings, one axis at a time around each tier");
    sweep->footer(
        "Writes sweep.csv and sweep.jsonl into the output folder: a row for each material, probe, set of frames and\n"
        "setting. Errors are against the reference; times are of a frame on this machine's OpenGL device; the others\n"
        "are fixed counts. Each result is kept at once: start a stopped sweep again and it continues.\n"
        "Example:\n"
        "  rowland-trade sweep --material cd.json --probe sunset.hdr --probe church.hdr:angular --output results");
    add_options(*sweep, *options);
    sweep->callback([options] { run_sweep(*options); });
    CLI::App* report = program.add_subcommand("report", "Sweep, and draw the results as one HTML file");
    report->footer(
        "Writes report.html into the output folder, beside the files of sweep: error against frame time and memory,\n"
        "difference pictures, tables, methods for thin films, and the figures of Lindsay & Agu 2006. The file needs "
        "no\n"
        "network and no other file. Continues where a sweep or report was stopped.\n"
        "Example:\n"
        "  rowland-trade report --material cd.json --probe sunset.hdr --probe church.hdr:angular --output results");
    add_options(*report, *options);
    report->callback([options, command_line] { run_report(*options, command_line); });
}

}  // namespace rowland::trade
