// rowland-cook over the asset types of all modules, with its commands "foil", "export" and "capture".

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/cooker/cooker_program.h"
#include "editor/cooker/foil_command.h"
#include "engine/command_line/command_line.h"
#include "engine/core/child_process.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/program.h"
#include "engine/lighting/probe_image.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/asset_types.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/portable/portable.h"

namespace rowland::editor {

namespace {

struct Options {
    std::filesystem::path material;
    std::filesystem::path output;
    std::optional<std::filesystem::path> probe;
    std::string mapping = "equirect";
    int key_lights = 16;
    int bands = 5;
    std::vector<double> normal;
    int resolution = 256;
    bool arc = false;
};

[[noreturn]] void refuse_usage(const char* option, std::string found, std::string expected) {
    refuse_input(option, {}, std::move(found), std::move(expected), "see rowland-cook export --help");
}

std::filesystem::path bytes_beside(const std::filesystem::path& json) {
    return std::filesystem::path(json).replace_extension(".bin");
}

void check_usage(const Options& options) {
    std::vector<std::filesystem::path> inputs{options.material};
    if (options.probe) inputs.push_back(*options.probe);
    const std::vector<Output> outputs{{.option = "--output", .path = options.output, .extension = ".json"},
                                      {.option = "--output", .path = bytes_beside(options.output)}};
    check_outputs(inputs, outputs);
    if (options.normal.empty()) return;
    if (!options.probe) refuse_usage("--planar", "no --probe", "the probe that the map is of");
    if (!(glm::length(glm::dvec3(options.normal[0], options.normal[1], options.normal[2])) > 0.0))
        refuse_usage("--planar", "0 0 0", "a direction");
}

diffraction::CookedMaterial load(const std::filesystem::path& path) {
    if (path.extension() != ".json") return diffraction::load_cooked_material(path);
    const diffraction::Material material = diffraction::load_material(path);
    diffraction::require_baked_grooves(material.grating, path.string());
    return diffraction::bake_kernel(with_efficiencies(material, path.string()));
}

void add_light(const Options& options, const diffraction::CookedMaterial& cooked,
               diffraction::PortableDocument& document) {
    const diffraction::EvaluationLight light(
        lighting::load_probe_image(*options.probe, lighting::parse_mapping(options.mapping)), options.key_lights,
        math::SphericalWindow::None);
    add_probe(light, options.bands, document);
    if (options.normal.empty()) return;
    if (!is_flat(cooked.material.grating.lobe))
        refuse_input(options.material.string(), "grating/groove_lobe", "a lobe that is not flat, with --planar",
                     "\"flat\"",
                     "leave --planar out: the map of this material is a volume, which a document does not hold");
    const glm::dvec3 normal(options.normal[0], options.normal[1], options.normal[2]);
    add_planar_map(cooked, light, glm::normalize(normal), diffraction::planar_map_size(options.resolution), document);
}

void run_export(const Options& options) {
    check_usage(options);
    const std::filesystem::path bytes = bytes_beside(options.output);
    const diffraction::CookedMaterial cooked = load(options.material);
    if (cooked.material.grating.lattice)
        refuse_input(options.material.string(), "/grating/lattice", "a lattice", "grooves of one direction (pitch_nm)",
                     "a document does not hold the pattern of a lattice");
    if (cooked.material.grating.transmission)
        refuse_input(options.material.string(), "transmission", "a sheet that transmits", "a reflecting grating",
                     "documents hold reflected light alone");
    if (std::holds_alternative<diffraction::PitSequenceLobe>(cooked.material.grating.lobe))
        refuse_input(options.material.string(), "/grating/groove_lobe/pit_sequence", "a pit sequence",
                     "\"flat\", a sigma, or pits", "documents do not hold its orders");
    diffraction::PortableDocument document = diffraction::make_portable(bytes.filename().string());
    add_material(cooked, document);
    if (options.arc) {
        const diffraction::ArcSettings settings{.bands = options.bands,
                                                .storage = diffraction::Storage::Float,
                                                .illuminant = cooked.material.quality.illuminant};
        add_arc(bake(cooked.material.grating, settings), document);
    }
    if (options.probe) add_light(options, cooked, document);
    document.json["bytes"]["length"] = document.bytes.size();
    write_file_atomic(bytes, document.bytes);
    write_file_atomic(options.output, document.json.dump(1) + "\n");
}

/// Adds `export`, which writes a diffraction material, and on request a probe and a map, for programs in any language:
/// modules/diffraction/portable.
void add_export_command(CLI::App& program) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand(
        "export", "Write a diffraction material, and a probe, as JSON and an array file for programs in any language");
    command->add_option("MATERIAL", options->material, "A material, JSON or cooked")->required();
    command->add_option("-o,--output", options->output, "The JSON; its arrays go beside it, as .bin")->required();
    command->add_flag("--arc", options->arc, "Also the table of the representation arc");
    command->add_option("--probe", options->probe, "Also this light: its key lights, and the rest as SH");
    command->add_option("--probe-mapping", options->mapping, "How the image covers the sphere: equirect or angular")
        ->check(CLI::IsMember({"equirect", "angular"}))
        ->capture_default_str();
    command->add_option("--key-lights", options->key_lights, "Bright parts of the probe that are taken out")
        ->check(CLI::Range(0, lighting::kMaximumKeyLights))
        ->capture_default_str();
    command->add_option("--bands", options->bands, "Bands of the SH and of --arc")
        ->check(CLI::Range(1, math::kMaximumBands))
        ->capture_default_str();
    command->add_option("--planar", options->normal, "Also the map of a flat surface with this normal")
        ->expected(3)
        ->check(finite(-1e6, 1e6));
    command->add_option("--resolution", options->resolution, "Azimuths and views of the map; even")
        ->check(CLI::Range(8, 1024))
        ->check([](const std::string& text) {
            return text.find_last_of("02468") == text.size() - 1 ? "" : text + " is odd";
        })
        ->capture_default_str();
    command->footer(
        "modules/diffraction/portable/FORMAT.md describes the files.\n\n"
        "Example: rowland-cook export content/materials/cd_paper.json --probe sunset.hdr --planar 0 1 0 -o cd.json");
    command->callback([options] { run_export(*options); });
}

/// Adds `capture`, which is a program of its own: editor/capture.
void add_capture_command(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("capture", "Capture the light probes of a .gltf or .glb from the scene itself");
    command->prefix_command();
    command->set_help_flag();  // its own
    command->callback([command] { continue_as(helper_program("rowland-capture"), command->remaining()); });
}

}  // namespace

}  // namespace rowland::editor

int main(int argc, char** argv) {
    return rowland::editor::run_cooker(
        argc, argv, *rowland::modules::asset_types(),
        {rowland::editor::add_foil_command, rowland::editor::add_export_command, rowland::editor::add_capture_command});
}
