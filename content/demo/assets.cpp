#include "content/demo/assets.h"

#include "engine/asset/container.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"
#include "engine/image/load.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/scene/gltf_import.h"

namespace rowland::demo {

namespace {

constexpr std::uint64_t kMaximumJsonBytes = 1 << 20;

nlohmann::json read_json(const std::filesystem::path& path) {
    return parse_json(read_text_file(path, kMaximumJsonBytes), path.string());
}

lighting::LightProbe render_probe_recipe(const std::filesystem::path& path) {
    const lighting::ProbeRecipe recipe = lighting::parse_probe_recipe(read_json(path), path.string());
    const auto load = [&path](const std::string& name) { return image::load_image(path.parent_path() / name); };
    return lighting::build_light_probe(lighting::render_recipe(recipe, load, path.string()), recipe.settings);
}

}  // namespace

SceneSources load_sources(const Options& options, const glm::dmat3& xyz_to_working) {
    SceneSources sources;
    sources.grating_is_disc = !options.mesh;
    sources.grating = load_mesh(options.mesh.value_or(options.cooked_folder / "cd.glb"));
    sources.sphere = load_mesh(options.cooked_folder / "sphere.glb");
    sources.ground = load_mesh(options.cooked_folder / "ground.glb");
    const auto cooked = load_material(options.material.value_or(options.cooked_folder / "cd.material"));
    sources.material = std::make_shared<const diffraction::GpuSpikeMaterial>(cooked, xyz_to_working);
    return sources;
}

std::vector<std::filesystem::path> probe_paths(const Options& options) {
    if (options.probe) return {*options.probe};
    return {options.cooked_folder / "studio.probe", options.cooked_folder / "clear_sky.probe"};
}

std::filesystem::path default_cooked_folder() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "cooked";
}

lighting::LightProbe load_probe(const std::filesystem::path& path, const std::string& mapping) {
    if (path.extension() == ".json") return render_probe_recipe(path);
    if (path.extension() == ".probe")
        return lighting::deserialise(asset::load(path, "probe", lighting::kLightProbeVersion).payload, path.string());
    const lighting::ProbeImage probe(image::load_image(path), lighting::parse_mapping(mapping), path.string());
    if (const lighting::TexelReport& report = probe.report(); report.total() > 0)
        log_warning("{}: {} NaN, {} infinite and {} negative components are treated as 0", path.string(), report.nan,
                    report.infinite, report.negative);
    return lighting::build_light_probe(probe);
}

scene::Mesh load_mesh(const std::filesystem::path& path) {
    const scene::ImportedScene imported = scene::load_gltf(path);
    for (const std::string& warning : imported.warnings) log_warning("{}: {}", path.string(), warning);
    return scene::merge_instances(imported);
}

diffraction::CookedMaterial load_material(const std::filesystem::path& path) {
    if (path.extension() == ".json") return diffraction::cook_material(read_json(path), path.string());
    return diffraction::load_cooked_material(path);
}

}  // namespace rowland::demo
