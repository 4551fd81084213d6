#include "editor/trade/evaluate_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iterator>

#include "editor/trade/inputs.h"
#include "editor/trade/results.h"
#include "engine/core/error.h"
#include "engine/math/sh_basis.h"
#include "engine/math/sh_window.h"
#include "modules/diffraction/asset/baked_tables.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material_json.h"
#include "modules/diffraction/evaluate/point_shader.h"

namespace rowland::trade {

namespace {

constexpr std::array kMethods = {"reference", "spikes", "bins",   "transfer", "arc",
                                 "planar",    "circle", "streak", "direct"};
constexpr int kDefaultBands = 5;
constexpr int kMaximumSpikes = 401;
constexpr int kMaximumBins = 400;
constexpr int kMaximumRank = 64;
constexpr int kKeyLights = 16;  ///< that a probe is cooked with unless it says otherwise
constexpr int kMaximumResolution = 1024;

[[noreturn]] void refuse_usage(std::string option, std::string found, std::string expected) {
    throw Error({.file = std::move(option),
                 .place = {},
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = "see rowland-trade evaluate --help"});
}

diffraction::Storage parse_storage(const std::string& name) {
    if (name == "fp32") return diffraction::Storage::Float;
    if (name == "fp16") return diffraction::Storage::Half;
    return name == "unorm8" ? diffraction::Storage::Unorm8 : diffraction::Storage::Unorm16;
}

/// Nine significant digits each.
std::string format_row(const glm::dvec3& xyz) {
    return fmt::format("{:.9g},{:.9g},{:.9g}", xyz.x, xyz.y, xyz.z);
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
    command->add_option("--bins", bins, "Wavelength bins of the method bins")
        ->check(CLI::Range(1, kMaximumBins))
        ->capture_default_str();
    command->add_option("--rank", rank, "Rank of the method arc")
        ->check(CLI::Range(1, kMaximumRank))
        ->capture_default_str();
    command
        ->add_option(
            "--resolution", resolution,
            "Spikes and bins: a view table of n theta by 2n phi nodes (spikes are exact for every view if not\n"
            "given); planar: cells of azimuth and of view; circle: texels of a chart's side")
        ->check(CLI::Range(2, kMaximumResolution));
    command
        ->add_option(
            "--key-lights", key_lights,
            "Bright parts of the probe that are shaded on their own, exactly (0; for the method direct, and for\n"
            "cooked assets that take key lights, 16)")
        ->check(CLI::Range(0, lighting::kMaximumKeyLights));
    command->add_option("--storage", storage, "Components of the tables: fp32, fp16, unorm16 or unorm8")
        ->check(CLI::IsMember({"fp32", "fp16", "unorm16", "unorm8"}))
        ->capture_default_str();
    command->add_option("--window", window, "Window on the light's bands: none, lanczos or hann")
        ->check(CLI::IsMember({"none", "lanczos", "hann"}))
        ->capture_default_str();
    command->add_flag("--error", error,
                      "With the reference: a fourth column, how much each row changes at half the steps (relative)");
    command->add_option("--frames", frames, "Frames, CSV")->required()->type_name("FILE");
    return command;
}

void EvaluateCommand::check_usage() const {
    if (material.has_value() == cooked.has_value())
        refuse_usage("--material, --cooked", material ? "both" : "neither", "one of them");
    if (probe.has_value() == probe_sh.has_value())
        refuse_usage("--probe, --probe-sh", probe ? "both" : "neither", "one of them");
    if (cooked) {
        if (error) refuse_usage("--error", "--cooked", "--method reference");
        if (!method.empty()) refuse_usage("--method", method, "no method with --cooked: the asset holds its own");
        return;
    }
    if (method.empty()) refuse_usage("--method", "none", fmt::format("one of {}", fmt::join(kMethods, ", ")));
    if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end())
        refuse_usage("--method", method, fmt::format("a method that exists: {}", fmt::join(kMethods, ", ")));
    if (error && method != "reference") refuse_usage("--error", "--method " + method, "--method reference");
}

diffraction::EvaluationLight EvaluateCommand::light(int usual_key_lights) const {
    const math::SphericalWindow taming = math::parse_window(window);
    if (probe_sh) {
        if (key_lights.value_or(0) > 0 || method == "direct")
            refuse_usage("--probe-sh", "light without bright parts", "a probe, to take key lights out of");
        return diffraction::EvaluationLight(read_sh_light(*probe_sh), taming);
    }
    return diffraction::EvaluationLight(read_probe(*probe, mapping), key_lights.value_or(usual_key_lights), taming);
}

diffraction::Representation EvaluateCommand::representation(const colour::LightSpectra& spectra) const {
    const int n = bands.value_or(kDefaultBands);
    const diffraction::Storage stored = parse_storage(storage);
    const colour::Illuminant& white = spectra.illuminant();
    if (method == "spikes")
        return diffraction::SpikeTableSettings{.spikes = {.bands = n, .spikes = spikes, .illuminant = white},
                                               .theta_nodes = resolution.value_or(2),
                                               .phi_nodes = 2 * resolution.value_or(2),
                                               .storage = stored};
    if (method == "bins") {
        diffraction::BinSettings settings{.bands = n, .bins = bins, .storage = stored, .illuminant = white};
        if (resolution) settings.grid = {.columns = 2 * *resolution, .rows = *resolution};
        return settings;
    }
    if (method == "transfer")
        return diffraction::TransferSettings{.bands = n, .grid = {}, .storage = stored, .illuminant = white};
    const diffraction::ArcSettings arc{
        .bands = n, .rank = rank, .grid = {}, .pitch = {}, .storage = stored, .illuminant = white};
    if (method == "arc") return arc;
    if (method == "planar") {
        diffraction::PlanarMapSize size;
        if (resolution) size = {.azimuths = *resolution, .views = *resolution};
        return diffraction::PlanarSettings{.size = size, .stand_in = arc};
    }
    if (method == "circle") {
        diffraction::CircleMapSize size;
        if (resolution) size.side = *resolution;
        return diffraction::CircleSettings{.size = size};
    }
    return diffraction::DirectSettings{};
}

std::vector<glm::dvec3> EvaluateCommand::by_reference(const colour::LightSpectra& spectra,
                                                      const std::vector<diffraction::Frame>& points) const {
    const diffraction::Grating grating = diffraction::load_material(*material).grating;
    if (probe_sh) return reference_radiance(grating, read_sh_light(*probe_sh), spectra, points);
    return reference_radiance(grating, read_probe(*probe, mapping), spectra, points);
}

std::vector<diffraction::CheckedRadiance> EvaluateCommand::by_checked_reference(
    const colour::LightSpectra& spectra, const std::vector<diffraction::Frame>& points) const {
    const diffraction::Grating grating = diffraction::load_material(*material).grating;
    if (probe_sh) return checked_reference(grating, read_sh_light(*probe_sh), spectra, points);
    return checked_reference(grating, read_probe(*probe, mapping), spectra, points);
}

std::vector<glm::dvec3> EvaluateCommand::by_representation(const colour::LightSpectra& spectra,
                                                           const std::vector<diffraction::Frame>& points) const {
    if (cooked) {
        const diffraction::CookedMaterial asset = diffraction::load_cooked_material(*cooked);
        return evaluate_baked(asset, light(asset.material.quality.key_lights ? kKeyLights : 0), points);
    }
    diffraction::CookedMaterial baked;
    baked.material = diffraction::load_material(*material);
    const diffraction::Grating& grating = baked.material.grating;
    const diffraction::ColourKernel kernel(grating, spectra);
    baked.kernel = tabulate(kernel);
    baked.zero_order_xyz = kernel.zero_order_xyz();
    const diffraction::EvaluationLight lit = light(method == "direct" ? kKeyLights : 0);
    if (method == "streak") {
        if (!lit.key_lights().empty())
            refuse_usage("--key-lights", "some", "none with the method streak, which sees the whole probe");
        const diffraction::PointShader shader =
            diffraction::streak(grating, spectra, bands.value_or(kDefaultBands), lit);
        return evaluate_points(method, shader, baked, lit, points);
    }
    const diffraction::Representation chosen = representation(spectra);
    if (method == "spikes" && !resolution) {
        const auto& settings = std::get<diffraction::SpikeTableSettings>(chosen).spikes;
        return evaluate_points(method, exact_spikes(grating, settings, lit), baked, lit, points);
    }
    baked.tables = bake_tables(grating, chosen);
    return evaluate_baked(baked, lit, points);
}

void EvaluateCommand::run() const {
    check_usage();
    const auto points = read_frames(frames);
    const colour::LightSpectra spectra(illuminant ? colour::load_illuminant(*illuminant) : colour::d65());
    if (error) {
        std::string text = "X,Y,Z,error\n";
        for (const auto& row : by_checked_reference(spectra, points))
            fmt::format_to(std::back_inserter(text), "{},{:.3g}\n", format_row(row.xyz), row.error);
        write_results(text);
        return;
    }
    const auto results =
        !cooked && method == "reference" ? by_reference(spectra, points) : by_representation(spectra, points);
    std::string text = "X,Y,Z\n";
    for (const glm::dvec3& xyz : results) text += format_row(xyz) + '\n';
    write_results(text);
}

}  // namespace rowland::trade
