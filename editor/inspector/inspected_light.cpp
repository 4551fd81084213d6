#include "editor/inspector/inspected_light.h"

#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/image/load.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/live/live_assets.h"
#include "engine/module.h"

namespace rowland::inspector {

namespace {

constexpr std::uint64_t kLargestRecipe = 16 << 20;

/// The probe's image and its number of key lights.
std::pair<lighting::ProbeImage, int> read_image(const std::filesystem::path& path, const std::string& mapping) {
    if (path.extension() == ".probe")
        refuse_input(path.string(), "", "a cooked probe, which does not have the full resolution",
                     "its source: an .hdr or .exr image, or a recipe", "the reference needs every texel");
    if (path.extension() != ".json")
        return {lighting::ProbeImage(image::load_image(path), lighting::parse_mapping(mapping), path.string()),
                lighting::LightProbeSettings().key_lights};
    const auto recipe =
        lighting::parse_probe_recipe(parse_json(read_text_file(path, kLargestRecipe), path.string()), path.string());
    const auto beside = [&](const std::string& name) { return image::load_image(path.parent_path() / name); };
    return {lighting::render_recipe(recipe, beside, path.string()), recipe.settings.key_lights};
}

}  // namespace

std::shared_ptr<const InspectedLight> load_light(const std::filesystem::path& path, const std::string& mapping) {
    auto [image, key_lights] = read_image(path, mapping);
    std::vector<std::filesystem::path> read_files;
    lighting::LightProbe probe = live::load_probe(*make_registry({}), path, mapping, read_files);
    diffraction::EvaluationLight divided(image, key_lights, math::SphericalWindow::None);
    return std::make_shared<const InspectedLight>(
        InspectedLight{path, std::move(image), std::move(probe), key_lights, std::move(divided)});
}

}  // namespace rowland::inspector
