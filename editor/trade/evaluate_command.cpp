#include "editor/trade/evaluate_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iterator>

#include "editor/trade/inputs.h"
#include "editor/trade/results.h"
#include "editor/trade/spikes_method.h"
#include "engine/core/error.h"
#include "engine/math/sh_basis.h"
#include "engine/math/sh_window.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material_json.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::trade {

namespace {

constexpr std::array kMethods = {"reference", "spikes"};
constexpr int kDefaultBands = 5;
constexpr int kMaximumSpikes = 401;
constexpr int kMaximumResolution = 1024;

[[noreturn]] void refuse_usage(std::string option, std::string found, std::string expected) {
    throw Error({.file = std::move(option),
                 .place = {},
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = "see rowland-trade evaluate --help"});
}

}  // namespace

CLI::App* EvaluateCommand::declare(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("evaluate", "Evaluate a material's diffraction term under a probe, by a chosen method");
    command->footer(
        "Reads frames vx,vy,vz,nx,ny,nz,gx,gy,gz (world axes: toward the eye, normal, grating vector) and writes a "
        "row\n"
        "X,Y,Z for each: the listed orders only, no base layer, no mirror.\n"
        "Options that a method does not use are ignored by it.\n"
        "Example:\n"
        "  rowland-trade evaluate --material cd.json --probe sunset.hdr --method reference --frames frames.csv");
    command->add_option("--material", material, "Material, JSON")->type_name("FILE");
    command->add_option("--cooked", cooked, "Cooked material, in place of --material and --method")->type_name("FILE");
    command->add_option("--probe", probe, "Light probe, Radiance .hdr or OpenEXR")->type_name("FILE");
    command->add_option("--probe-mapping", mapping, "How the image covers the sphere: equirect or angular")
        ->check(CLI::IsMember({"equirect", "angular"}))
        ->capture_default_str();
    command->add_option("--probe-sh", probe_sh, "In place of --probe: CSV l,m,r,g,b, which is the light itself")
        ->type_name("FILE");
    command->add_option("--illuminant", illuminant, "CSV wavelength_nm,relative_power of the light; D65 if not given")
        ->type_name("FILE");
    command->add_option("--method", method, fmt::format("One of: {}", fmt::join(kMethods, ", ")))->type_name("NAME");
    command->add_option("--bands", bands, "Bands of the light and of the material (5)")
        ->check(CLI::Range(1, math::kMaximumBands));
    command->add_option("--spikes", spikes, "Spikes per view")
        ->check(CLI::Range(1, kMaximumSpikes))
        ->capture_default_str();
    command
        ->add_option("--resolution", resolution,
                     "Spikes from a view table of n theta by 2n phi nodes; exact for every view if not given")
        ->check(CLI::Range(2, kMaximumResolution));
    command->add_option("--storage", storage, "Components of the view table: unorm16 or fp16")
        ->check(CLI::IsMember({"unorm16", "fp16"}))
        ->capture_default_str();
    command->add_option("--window", window, "Window on the light's bands: none, lanczos or hann")
        ->check(CLI::IsMember({"none", "lanczos", "hann"}))
        ->capture_default_str();
    command->add_option("--frames", frames, "Frames, CSV")->required()->type_name("FILE");
    return command;
}

void EvaluateCommand::check_usage() const {
    if (material.has_value() == cooked.has_value())
        refuse_usage("--material, --cooked", material ? "both" : "neither", "one of them");
    if (probe.has_value() == probe_sh.has_value())
        refuse_usage("--probe, --probe-sh", probe ? "both" : "neither", "one of them");
    if (cooked) {
        if (!method.empty()) refuse_usage("--method", method, "no method with --cooked: the asset holds its own");
        return;
    }
    if (method.empty()) refuse_usage("--method", "none", fmt::format("one of {}", fmt::join(kMethods, ", ")));
    if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end())
        refuse_usage("--method", method, fmt::format("a method that exists: {}", fmt::join(kMethods, ", ")));
}

lighting::ShLight EvaluateCommand::bandlimited_light(int bands_wanted) const {
    const lighting::ShLight light =
        probe_sh ? read_sh_light(*probe_sh) : lighting::project(read_probe(*probe, mapping), bands_wanted);
    return lighting::limit_bands(light, std::min(bands_wanted, light.bands), math::parse_window(window));
}

std::vector<glm::dvec3> EvaluateCommand::by_reference(const colour::LightSpectra& spectra,
                                                      const std::vector<diffraction::Frame>& points) const {
    const diffraction::Grating grating = diffraction::load_material(*material).grating;
    if (probe_sh) return reference_radiance(grating, read_sh_light(*probe_sh), spectra, points);
    return reference_radiance(grating, read_probe(*probe, mapping), spectra, points);
}

std::vector<glm::dvec3> EvaluateCommand::by_spikes(const colour::LightSpectra& spectra,
                                                   const std::vector<diffraction::Frame>& points) const {
    const diffraction::Grating grating = diffraction::load_material(*material).grating;
    const diffraction::SpikeSettings settings{
        .bands = bands.value_or(kDefaultBands), .spikes = spikes, .illuminant = spectra.illuminant()};
    const lighting::ShLight light = bandlimited_light(settings.bands);
    if (!resolution) return evaluate_exact_spikes(grating, settings, light, spectra, points);
    const auto table = diffraction::bake_spike_table(
        grating, {.spikes = settings,
                  .theta_nodes = *resolution,
                  .phi_nodes = 2 * *resolution,
                  .storage = storage == "fp16" ? diffraction::Storage::Half : diffraction::Storage::Unorm16});
    return evaluate_spike_table(table, light, spectra, points);
}

std::vector<glm::dvec3> EvaluateCommand::by_cooked_asset(const colour::LightSpectra& spectra,
                                                         const std::vector<diffraction::Frame>& points) const {
    const diffraction::CookedMaterial asset = diffraction::load_cooked_material(*cooked);
    return evaluate_spike_table(asset.table, bandlimited_light(asset.table.bands), spectra, points);
}

void EvaluateCommand::run() const {
    check_usage();
    const auto points = read_frames(frames);
    const colour::LightSpectra spectra(illuminant ? colour::load_illuminant(*illuminant) : colour::d65());
    const auto results = cooked                  ? by_cooked_asset(spectra, points)
                         : method == "reference" ? by_reference(spectra, points)
                                                 : by_spikes(spectra, points);
    std::string text = "X,Y,Z\n";
    for (const glm::dvec3& xyz : results)
        fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g},{:.9g}\n", xyz.x, xyz.y, xyz.z);
    write_results(text);
}

}  // namespace rowland::trade
