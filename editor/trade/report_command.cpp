#include "editor/trade/report_command.h"

#include <CLI/CLI.hpp>

#include "editor/trade/results.h"
#include "editor/trade/sweep_tables.h"
#include "engine/core/file.h"
#include "engine/core/progress.h"

namespace rowland::trade {

namespace {

constexpr const char* kPaperSetting = "spikes/bands=5/spikes=4";
constexpr int kMagnified = 3;
constexpr std::size_t kPaperParts = 3;

std::vector<DifferencePicture> difference_pictures(Sweep& sweep, const SweepResults& results) {
    std::vector<DifferencePicture> pictures;
    const PictureFrames& frames = sweep.picture_frames();
    for (std::size_t m = 0; m < results.materials.size(); ++m)
        for (std::size_t p = 0; p < results.probes.size(); ++p)
            for (const std::size_t s : pictured_settings(results, m, p)) {
                const auto reference = sweep.reference(m, p, frames.frames);
                const auto shown = sweep.by_setting(m, p, results.settings[m][s], frames.frames);
                pictures.push_back({.material = m,
                                    .probe = p,
                                    .setting = setting_name(results.settings[m][s]),
                                    .error = compare(shown, reference).relative_rms,
                                    .picture = difference_image(picture(frames, shown), picture(frames, reference),
                                                                frames.width, frames.height, kMagnified)});
            }
    return pictures;
}

/// The first material, and its light loop if that can be drawn.
PaperEvidence paper_evidence(const Sweep& sweep) {
    const diffraction::CookedMaterial paper = sweep.cook(0, parse_setting(kPaperSetting));
    const diffraction::Grating& grating = paper.material.grating;
    PaperEvidence evidence{.figure_2 = figure_2(grating), .grooves = grating.grooves};
    if (!sweep.inputs().times || !diffraction::is_flat(grating.lobe)) return evidence;
    Progress progress("the paper's figures", kPaperParts);
    PaperStage stage(paper, sweep.inputs().frame_size);
    evidence.rates = stage.rates();
    progress.advance();
    evidence.figure_6 = stage.figure_6();
    progress.advance();
    evidence.figure_3 = stage.figure_3({1, 2, 4, 8, 16, 32, 64, 128, 256, 512});
    progress.advance();
    return evidence;
}

}  // namespace

CLI::App* ReportCommand::declare(CLI::App& program) {
    CLI::App* command = program.add_subcommand("report", "Sweep, and draw all of it as one HTML file");
    command->footer(
        "Writes report.html into the output folder, beside what sweep writes: error against frame time and memory,\n"
        "difference pictures, tables, and the figures of Lindsay & Agu 2006. The file needs no network and no other\n"
        "file. Goes on where a sweep or report was stopped.\n"
        "Example:\n"
        "  rowland-trade report --material cd.json --probe sunset.hdr --probe church.hdr:angular --output results");
    options.declare(*command);
    return command;
}

void ReportCommand::run() const {
    Sweep sweep(options.inputs());
    const SweepResults results = sweep.run();
    write_file_atomic(options.output / "sweep.jsonl", sweep_json_lines(results));
    write_file_atomic(options.output / "sweep.csv", sweep_csv(results));
    const auto differences = difference_pictures(sweep, results);
    const auto data = report_data(results, sweep.inputs(), differences, paper_evidence(sweep));
    write_file_atomic(options.output / "report.html", report_html(data));
    write_results("file\n" + (options.output / "report.html").string() + "\n");
}

}  // namespace rowland::trade
