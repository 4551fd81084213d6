#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "editor/trade/commands.h"
#include "editor/trade/inputs.h"
#include "engine/command_line/command_line.h"
#include "engine/core/error.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/rigorous/solver.h"

namespace rowland::trade {

namespace {

struct RigorousOptions {
    std::filesystem::path material;
    double wavelength_nm = 0.0;
    double s_g = 0.0;
    double s_h = 0.0;
    std::vector<std::pair<double, double>> films;
};

void print_efficiencies(const RigorousOptions& options) {
    using diffraction::Light;
    const std::string file = options.material.string();
    const diffraction::Grating grating = diffraction::load_material(options.material).grating;
    diffraction::Relief relief = diffraction::relief_of(grating, file);
    for (const auto& [ior, thickness_nm] : options.films) relief.films.push_back({ior, thickness_nm});
    diffraction::check_relief(relief, options.films.empty() ? file : "--film");
    if (options.s_g * options.s_g + options.s_h * options.s_h >= 1.0)
        refuse_input("--s-g", "", fmt::format("s_g {}, s_h {}", options.s_g, options.s_h),
                     "a direction above the surface: s_g^2 + s_h^2 below 1");
    const diffraction::ClassicalIncidence incidence =
        diffraction::classical_incidence(relief.ambient_ior, options.wavelength_nm, options.s_g, options.s_h);
    if (incidence.wavelength_nm >= 2.0 * grating.pitch_nm)
        refuse_input(file, "/grating/pitch_nm", fmt::format("{} at {} nm", grating.pitch_nm, options.wavelength_nm),
                     fmt::format("more than {:.6g}: from no direction in this plane does an order but 0 propagate",
                                 incidence.wavelength_nm / 2.0),
                     "increase the pitch or reduce the wavelength");
    const diffraction::Substrate substrate = diffraction::substrate_of(grating);
    const diffraction::Converged solved = diffraction::solve_converged(
        relief, diffraction::index_of(substrate, options.wavelength_nm), incidence.wavelength_nm, incidence.s_g);
    std::string text = "order,TE,TM,mean\n";
    for (std::size_t j = 0; j < solved.efficiencies.v_g.size(); ++j) {
        if (std::abs(solved.efficiencies.v_g[j]) >= 1.0) continue;  // trapped under the cover
        const int order = solved.efficiencies.first + static_cast<int>(j);
        const auto eta = [&](Light light) { return leaving(solved.efficiencies, order, substrate, light); };
        fmt::format_to(std::back_inserter(text), "{},{:.9g},{:.9g},{:.9g}\n", order, eta(Light::TE), eta(Light::TM),
                       eta(Light::Unpolarised));
    }
    fmt::print(stderr, "orders -{0} to {0} solved for; the last {1} changed no efficiency by more than {2:.1g}\n",
               solved.truncation, solved.added, solved.error);
    write_results(text);
}

}  // namespace

void add_rigorous_command(CLI::App& program) {
    CLI::App* command = program.add_subcommand("rigorous", "Efficiencies of a grating's orders by Maxwell's equations");
    command->footer(
        "Writes order,TE,TM,mean for every order that propagates: the fraction of light from (s_g, s_h) that it "
        "takes;\n"
        "TE: the electric field lies along the grooves. For lamellar, sinusoidal and blazed grooves of a metal, or of\n"
        "a sheet with \"transmission\", whose light leaves on the other side. Under a cover the light is the part "
        "that\n"
        "has entered it. With --s-h the classical problem of the same cone is solved, which is an approximation.\n"
        "Example:\n  rowland-trade rigorous ruled_1200.json --wavelength-nm 550 --s-g 0.3");
    const auto options = std::make_shared<RigorousOptions>();
    command->add_option("material", options->material, "Material, JSON")->required()->type_name("FILE");
    command->add_option("--wavelength-nm", options->wavelength_nm, "Wavelength in air")
        ->required()
        ->check(finite(1.0, 1e5));
    command->add_option("--s-g", options->s_g, "Direction to the light, in air: its component along g")
        ->required()
        ->check(finite(-1.0, 1.0));
    command->add_option("--s-h", options->s_h, "The same along the grooves")
        ->capture_default_str()
        ->check(finite(-1.0, 1.0));
    command
        ->add_option("--film", options->films,
                     "A transparent film on the relief: index and thickness in nm; up to four, from the metal up")
        ->type_name("IOR NM");
    command->callback([options] { print_efficiencies(*options); });
}

}  // namespace rowland::trade
