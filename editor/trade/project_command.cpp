#include "editor/trade/project_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iterator>

#include "editor/trade/inputs.h"
#include "editor/trade/results.h"
#include "engine/math/sh_basis.h"

namespace rowland::trade {

CLI::App* ProjectCommand::declare(CLI::App& program) {
    CLI::App* command = program.add_subcommand("project", "Project a light probe onto spherical harmonics");
    command->footer(
        "Writes l,m,r,g,b: raw radiance coefficients, real and orthonormal, no Condon-Shortley phase, polar axis z.\n"
        "Example:\n  rowland-trade project --probe sunset.hdr --bands 5 > sunset_sh.csv");
    command->add_option("--probe", probe, "Light probe, Radiance .hdr or OpenEXR")->required()->type_name("FILE");
    command->add_option("--probe-mapping", mapping, "How the image covers the sphere: equirect or angular")
        ->check(CLI::IsMember({"equirect", "angular"}))
        ->capture_default_str();
    command->add_option("--bands", bands, "Bands n: n*n coefficients per channel")
        ->required()
        ->check(CLI::Range(1, math::kMaximumBands));
    return command;
}

void ProjectCommand::run() const {
    const lighting::ShLight light = lighting::project(read_probe(probe, mapping), bands);
    std::string text = "l,m,r,g,b\n";
    for (int l = 0; l < bands; ++l)
        for (int m = -l; m <= l; ++m) {
            const glm::dvec3& c = light.coefficients[static_cast<std::size_t>(math::sh_index(l, m))];
            fmt::format_to(std::back_inserter(text), "{},{},{:.17g},{:.17g},{:.17g}\n", l, m, c.r, c.g, c.b);
        }
    write_results(text);
}

}  // namespace rowland::trade
