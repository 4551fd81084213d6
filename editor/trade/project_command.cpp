#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iterator>
#include <memory>

#include "editor/trade/commands.h"
#include "editor/trade/inputs.h"
#include "editor/trade/results.h"
#include "engine/math/sh_basis.h"

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

}  // namespace

void add_project_command(CLI::App& program) {
    CLI::App* command = program.add_subcommand("project", "Project a light probe onto spherical harmonics");
    command->footer(
        "Writes l,m,r,g,b: raw radiance coefficients, real and orthonormal, no Condon-Shortley phase, polar axis z.\n"
        "Example:\n  rowland-trade project --probe sunset.hdr --bands 5 > sunset_sh.csv");
    const auto options = std::make_shared<ProjectOptions>();
    command->add_option("--probe", options->probe, "Light probe, Radiance .hdr or OpenEXR")
        ->required()
        ->type_name("FILE");
    command
        ->add_option("--probe-mapping", options->mapping,
                     "How the image covers the sphere: equirect, angular, or auto (recognised)")
        ->check(CLI::IsMember({"auto", "equirect", "angular"}))
        ->capture_default_str();
    command->add_option("--bands", options->bands, "Bands n: n*n coefficients per channel")
        ->required()
        ->check(CLI::Range(1, math::kMaximumBands));
    command->callback([options] { project(*options); });
}

}  // namespace rowland::trade
