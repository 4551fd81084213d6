// Captures the light probes of a glTF's boxes from the scene itself.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <glm/matrix.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/asset/container.h"
#include "engine/colour/colour_space.h"
#include "engine/command_line/command_line.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "engine/lighting/light_probe.h"
#include "engine/live/live_assets.h"
#include "engine/platform/gl_context.h"
#include "engine/render/capture.h"
#include "engine/render/scene_instance.h"
#include "engine/scene/transform.h"
#include "modules/asset_types.h"
#include "modules/material_types.h"

namespace rowland::editor {

namespace {

struct Options {
    std::filesystem::path scene;
    std::filesystem::path sky;
    int face_size = 256;
    std::vector<std::string> only;
};

/// The probes to capture, keyed by the file that each is written to. Throws Error (input).
std::map<std::filesystem::path, scene::ImportedProbe> wanted(const scene::ImportedScene& scene,
                                                             const Options& options) {
    const std::string file = options.scene.string();
    std::map<std::filesystem::path, scene::ImportedProbe> probes;
    std::vector<std::string> names;
    for (const scene::ImportedProbe& probe : scene.probes) {
        const std::string& name = names.emplace_back(scene.nodes[probe.node].name);
        if (!options.only.empty() && std::ranges::find(options.only, name) == options.only.end()) continue;
        const auto [known, is_new] = probes.emplace(options.scene.parent_path() / probe.file, probe);
        if (!is_new)
            refuse_input(file, "",
                         fmt::format("the file {} for \"{}\" and \"{}\"", probe.file.string(),
                                     scene.nodes[known->second.node].name, name),
                         "a file for each probe");
    }
    for (const std::string& name : options.only)
        if (std::ranges::find(names, name) == names.end())
            refuse_input("--only", "", fmt::format("\"{}\"", name),
                         fmt::format("one of \"{}\"", fmt::join(names, "\", \"")));
    if (probes.empty())
        refuse_input(file, "", "no node with ROWLAND_light_probe", "at least one box",
                     "give a node the extension: \"The light of a room\" in content/README.md");
    return probes;
}

void write_probe(const std::filesystem::path& path, const lighting::LightProbe& probe) {
    std::vector<std::byte> payload = lighting::serialise(probe);
    const Hash128 hash = Hasher().bytes(payload).digest();
    write_file_atomic(path, asset::pack({{"probe", lighting::kLightProbeVersion, hash}, std::move(payload)}));
    log_info("wrote {}", path.string());
}

void capture(const Options& options) {
    if (options.scene.extension() == ".scene")
        refuse_input(options.scene.string(), "", "a cooked scene", "the .gltf or .glb that it was cooked from",
                     "its probes are written beside it");
    const auto registry = modules::asset_types();
    std::vector<std::filesystem::path> files;
    const scene::ImportedScene scene = live::load_scene(*registry, options.scene, live::default_cache_folder(), files);
    const auto probes = wanted(scene, options);
    const lighting::LightProbe sky = live::load_probe(*registry, options.sky, "auto", files);

    const platform::HeadlessContext context;
    render::Renderer renderer(glm::inverse(colour::rec709_to_xyz()));
    modules::register_material_types(renderer, {.diffraction = {.map_pace = diffraction::MapPace::Whole}});
    renderer.set_probe(sky);
    renderer.use_key_lights(true);
    ecs::World world;
    const render::SceneInstance instance = render::instantiate(world, scene, renderer, options.scene.string());
    // Probes of earlier captures light nothing, so that a capture does not depend on the last one.
    for (const ecs::Entity probe : instance.probes) world.destroy(probe);
    scene::update_world_matrices(world);

    lighting::LightProbeSettings settings;
    settings.light_face = options.face_size;
    settings.illuminant = sky.illuminant;
    Progress progress("capturing " + options.scene.filename().string(), probes.size());
    for (const auto& [path, probe] : probes) {
        const glm::vec3 position(scene.nodes[probe.node].world[3]);
        const lighting::ProbeImage image = render::capture_surroundings(renderer, world, position, options.face_size);
        write_probe(path, lighting::build_light_probe(image, settings));
        progress.advance();
    }
}

int run(int argc, const char* const* argv) {
    Options options;
    CLI::App app("Capture the light probes of a glTF's boxes from the scene itself.", "rowland-cook capture");
    app.add_option("SCENE", options.scene, "A .gltf or .glb with nodes that have ROWLAND_light_probe")->required();
    app.add_option("--probe", options.sky, "The light far away: .hdr, .exr, a probe recipe or a cooked .probe")
        ->required();
    app.add_option("--face", options.face_size, "Texels along each side of the six pictures of a probe")
        ->check(CLI::IsMember({32, 64, 128, 256, 512}))
        ->capture_default_str();
    app.add_option("--only", options.only, "Only the probe of this node (may be repeated)")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.footer(
        "Draws each probe's surroundings without a window and writes the cooked probe to the file that its\n"
        "node names, beside the scene. Surfaces are lit by the scene's lights and the light far away alone,\n"
        "so that the result does not depend on an earlier capture. Cook the scene again to take them over.\n\n"
        "Example: rowland-cook capture level.glb --probe content/probes/clear_sky.json");
    if (!parse_command_line(app, argc, argv)) return 0;
    capture(options);
    return 0;
}

}  // namespace

}  // namespace rowland::editor

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::editor::run(argc, argv); });
}
