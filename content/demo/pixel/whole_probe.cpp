#include "content/demo/pixel/whole_probe.h"

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/image/load.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_recipe.h"

namespace rowland::demo {

namespace {

constexpr std::uint64_t kLargestRecipe = 1 << 20;

WholeProbe from_recipe(const std::filesystem::path& path) {
    const std::string file = path.string();
    const lighting::ProbeRecipe recipe =
        lighting::parse_probe_recipe(parse_json(read_text_file(path, kLargestRecipe), file), file);
    const auto beside = [&](const std::string& name) { return image::load_image(path.parent_path() / name); };
    return {.image = lighting::render_recipe(recipe, beside, file), .key_lights = recipe.settings.key_lights};
}

}  // namespace

WholeProbe load_whole_probe(const std::filesystem::path& path, const std::string& mapping,
                            const std::filesystem::path& recipes) {
    if (path.extension() == ".json") return from_recipe(path);
    if (path.extension() != ".probe")
        return {.image = {image::load_image(path), lighting::parse_mapping(mapping), path.string()},
                .key_lights = lighting::LightProbeSettings().key_lights};
    const std::filesystem::path name = path.stem().replace_extension(".json");
    for (const std::filesystem::path& folder : {recipes, path.parent_path() / "recipes"})
        if (std::filesystem::is_regular_file(folder / name)) return from_recipe(folder / name);
    refuse_input(path.string(), "", "a cooked probe without its recipe " + (recipes / name).string(),
                 "the light at full resolution", "give the probe's image or recipe");
}

}  // namespace rowland::demo
