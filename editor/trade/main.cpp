#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/trade/commands.h"
#include "editor/trade/inputs.h"
#include "editor/trade/measure_error.h"
#include "editor/trade/sweep.h"
#include "engine/command_line/command_line.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/program.h"
#include "engine/core/text.h"
#include "engine/image/byte_image.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::trade {

namespace {

struct ProjectOptions {
    std::filesystem::path probe;
    std::string mapping = "auto";
    int bands = 5;
};

void project(const ProjectOptions& options) {
    const lighting::ShLight light = lighting::project(read_probe(options.probe, options.mapping), options.bands);
    std::string text = "l,m,r,g,b\n";
    for (int l = 0; l < options.bands; ++l)
        for (int m = -l; m <= l; ++m) {
            const glm::dvec3& c = light.coefficients[static_cast<std::size_t>(math::sh_index(l, m))];
            fmt::format_to(std::back_inserter(text), "{},{},{:.17g},{:.17g},{:.17g}\n", l, m, c.r, c.g, c.b);
        }
    write_results(text);
}

void add_project_command(CLI::App& program) {
    CLI::App* command = program.add_subcommand("project", "Project a light probe onto spherical harmonics");
    command->footer(
        "Writes l,m,r,g,b: raw radiance coefficients, real and orthonormal, no Condon-Shortley phase, polar axis z.\n"
        "Example:\n  rowland-trade project --probe sunset.hdr --bands 5 > sunset_sh.csv");
    const auto options = std::make_shared<ProjectOptions>();
    command->add_option("--probe", options->probe, "Light probe, Radiance .hdr or OpenEXR")
        ->required()
        ->type_name("FILE");
    add_probe_mapping(*command, options->mapping);
    command->add_option("--bands", options->bands, "Bands n: n*n coefficients per channel")
        ->required()
        ->check(CLI::Range(1, math::kMaximumBands));
    command->callback([options] { project(*options); });
}

std::vector<glm::dvec3> radiance(const std::filesystem::path& material, const lighting::ProbeImage& probe,
                                 const std::string& method, const FrameSet& set) {
    if (method == "reference") {
        const diffraction::Material parsed = with_efficiencies(diffraction::load_material(material), material.string());
        return reference_radiance(parsed.grating, probe, colour::LightSpectra(parsed.quality.illuminant),
                                  all_frames(set));
    }
    const diffraction::Method setting = diffraction::parse_method(method);
    return shaded(cook(diffraction::load_material_json(material), material.string(), setting),
                  diffraction::EvaluationLight(probe, setting.key_lights, setting.window), set);
}

/// `rowland-trade compare`: the error of one method against another, on the tool's scene or over given frames.
struct CompareCommand {
    std::filesystem::path material;
    std::string probe;
    std::string mapping = "auto";
    std::string method;
    std::string against = "reference";
    std::optional<std::filesystem::path> frames;
    std::optional<std::filesystem::path> difference;
    std::vector<int> size = {160, 90};
    int magnified = 3;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;
};

CLI::App* CompareCommand::declare(CLI::App& program) {
    CLI::App* command = program.add_subcommand("compare", "Compare two methods on one scene: numbers and a picture");
    command->footer(
        "The scene is a disc of the material with a sphere of it over the hole, or the points of --frames. A method "
        "is\n"
        "\"reference\" or a setting, such as arc/bands=5/rank=8/key_lights=16. Writes quantity,value: relative RMS "
        "and\n"
        "largest error over the largest value (both XYZ), the mean error of Y where the scene is dark over its mean "
        "Y,\n"
        "CIEDE2000 on the display and, of the scene, the mean of HDR-FLIP: 0 looks the same, 1 could not be further.\n"
        "Example:\n"
        "  rowland-trade compare --material cd.json --probe sunset.hdr --method spikes/bands=5 --difference d.png");
    command->add_option("--material", material, "Material, JSON")->required()->type_name("FILE");
    command->add_option("--probe", probe, "Light probe, Radiance .hdr or OpenEXR")
        ->required()
        ->type_name("FILE[:MAPPING]");
    add_probe_mapping(*command, mapping);
    command->add_option("--method", method, "The method whose error is measured")->required()->type_name("METHOD");
    command->add_option("--against", against, "The method to compare with")->capture_default_str()->type_name("METHOD");
    command->add_option("--frames", frames, "Points, CSV vx,vy,vz,nx,ny,nz,gx,gy,gz, in place of the scene")
        ->type_name("FILE");
    command
        ->add_option(
            "--difference", difference,
            fmt::format("PNG of both pictures and of their difference, black (none) to yellow (CIEDE2000 of {}\n"
                        "or more)",
                        kFullDifference))
        ->type_name("FILE");
    command->add_option("--size", size, "Pixels of the picture")
        ->expected(2)
        ->check(CLI::Range(8, 1024))
        ->capture_default_str();
    command->add_option("--magnified", magnified, "Pixels of the PNG for each pixel's side")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    return command;
}

void CompareCommand::run() const {
    if (frames && difference)
        refuse_input("--difference", "", "--frames, which are no picture", "the tool's scene: no --frames");
    const ProbeFile file = parse_probe_file(probe, mapping);
    if (difference) {
        std::vector<std::filesystem::path> files =
            files_named_in(diffraction::load_material_json(material), material.parent_path());
        files.insert(files.end(), {material, file.path});
        check_outputs(files, std::array{Output{"--difference", *difference, ".png"}});
    }
    for (const std::string& name : {method, against})
        if (name != "reference")
            check_method(diffraction::load_material_json(material), material.string(), diffraction::parse_method(name));
    const lighting::ProbeImage image = read_probe(file.path, file.mapping);
    const PictureFrames scene = picture_frames(far_camera(), size[0], size[1]);
    const FrameSet set = frames ? frames_of_file("frames", *frames) : scene.frames;
    const std::vector<glm::dvec3> b = radiance(material, image, against, set);
    const std::vector<glm::dvec3> a = radiance(material, image, method, set);
    const MethodError error = frames ? compare(a, b) : compare_pictures(scene, a, b);
    if (difference) {
        const RgbPicture shown = difference_image(picture(scene, a), picture(scene, b), size[0], size[1], magnified);
        image::write_png(*difference, shown.width, shown.height, shown.rgb);
    }
    write_results(
        fmt::format("quantity,value\nrelative_rms,{:.6g}\nlargest,{:.6g}\ndark_absolute,{:.6g}\n"
                    "median_delta_e,{:.6g}\np95_delta_e,{:.6g}\n",
                    error.relative_rms, error.largest, error.dark_absolute, error.median_delta_e, error.high_delta_e));
    if (error.flip) write_results(fmt::format("hdr_flip,{:.6g}\n", *error.flip));
}

/// The arguments in one line, quoted for a shell.
std::string command_line(std::span<char*> arguments) {
    const auto is_plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) ||
               std::string_view("-_./=:,+@%").find(c) != std::string_view::npos;
    };
    std::string text;
    for (const std::string argument : arguments) {
        if (!text.empty()) text += ' ';
        if (!argument.empty() && std::ranges::all_of(argument, is_plain)) {
            text += argument;
            continue;
        }
        text += '\'';
        for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
        text += '\'';
    }
    return valid_utf8(text);
}

}  // namespace

void add_probe_mapping(CLI::App& command, std::string& mapping) {
    command
        .add_option("--probe-mapping", mapping,
                    "How the image covers the sphere: equirect, angular, or auto (recognised)")
        ->check(CLI::IsMember({"auto", "equirect", "angular"}))
        ->capture_default_str();
}

}  // namespace rowland::trade

int main(int argc, char** argv) {
    return rowland::run_program([&]() -> int {
        CLI::App program("rowland-trade: the error and the cost of each way to shade a grating", "rowland-trade");
        program.require_subcommand(1);
        program.footer(
            "Results go to standard output, messages to standard error. Exit codes: 0 success, 2 bad input or usage,\n"
            "1 any other failure.\n"
            "Example:\n"
            "  rowland-trade evaluate --material cd.json --probe sunset.hdr --method spikes --frames frames.csv");
        rowland::trade::add_project_command(program);
        rowland::trade::add_evaluate_command(program);
        rowland::trade::CompareCommand compare;
        compare.declare(program)->callback([&] { compare.run(); });
        rowland::trade::add_sweep_commands(program,
                                           rowland::trade::command_line({argv, static_cast<std::size_t>(argc)}));
        rowland::trade::add_films_command(program);
        rowland::trade::add_rigorous_command(program);
        rowland::parse_command_line(program, argc, argv);
        return 0;
    });
}
