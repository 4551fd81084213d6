#include "editor/cooker/attach_command.h"

#include <memory>

#include "editor/cooker/attach.h"

namespace rowland::editor {

void add_attach_commands(CLI::App& program, const cook::Registry& registry, int& exit_code) {
    CLI::App* command = program.add_subcommand("attach", "Give materials of a .gltf or .glb their gratings");
    const auto options = std::make_shared<AttachOptions>();
    command->add_option("SCENE", options->scene, "The scene; without -o it is replaced")->required();
    command
        ->add_option("--material", options->attached,
                     "A material, by name or as #NUMBER, and its grating (may be repeated)")
        ->type_name("NAME GRATING.json");
    command->add_option("--remove", options->removed, "Take a material's grating away (may be repeated)")
        ->type_name("NAME")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        ->add_option("--groove-rotation-deg", options->rotation_deg,
                     "Turn the grooves, from the tangent toward the bitangent")
        ->type_name("ANGLE");
    command
        ->add_option("--groove-texture", options->texture,
                     "An image that varies the grooves: red their direction, green their pitch")
        ->type_name("IMAGE");
    command->add_option("-o,--output", options->output, "Write here instead");
    command->add_option("--depfile", options->depfile, "Write the files that were read, in Makefile syntax");
    command->footer(
        "Writes what is named into the file's text and nothing else: all other bytes stay. A refused grating changes\n"
        "nothing. The material's own surface stays under the grating; the grating's `base` is left out.\n\n"
        "Example: rowland-cook attach truck.glb --material Chrome content/materials/dvd.json -o truck_dvd.glb");
    command->callback([options, &registry] { attach(registry, *options); });

    command = program.add_subcommand("list", "List the materials of a .gltf or .glb and what is attached to them");
    const auto scene = std::make_shared<std::filesystem::path>();
    command->add_option("SCENE", *scene, "The scene")->required();
    command->footer(
        "Prints one line per material: its number, its name, its grating, the meshes that use it.\n\n"
        "Example: rowland-cook list truck.glb");
    command->callback([scene, &registry, &exit_code] { exit_code = list_materials(registry, *scene); });
}

}  // namespace rowland::editor
