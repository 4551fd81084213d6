#include "editor/inspector/light.h"

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/live/live_assets.h"
#include "engine/module.h"

namespace rowland::inspector {

std::shared_ptr<const InspectedLight> load_light(const std::filesystem::path& path, const std::string& mapping) {
    if (path.extension() == ".probe")
        refuse_input(path.string(), "", "a cooked probe, which does not have the full resolution",
                     "its source: an .hdr or .exr image, or a recipe", "the reference needs every texel");
    auto [image, key_lights] = lighting::load_full_resolution_probe(path, mapping);
    std::vector<std::filesystem::path> read_files;
    lighting::LightProbe probe = live::load_probe(*make_registry({}), path, mapping, read_files);
    diffraction::EvaluationLight divided(image, key_lights, math::SphericalWindow::None);
    return std::make_shared<const InspectedLight>(
        InspectedLight{path, std::move(image), std::move(probe), key_lights, std::move(divided)});
}

void LightChoice::choose(const std::filesystem::path& path) {
    path_ = std::make_shared<const std::filesystem::path>(path);
}

void LightChoice::choose_mapping(const std::string& mapping) {
    mapping_ = mapping;
    if (path_) choose(std::filesystem::path(*path_));
}

std::vector<std::filesystem::path> LightChoice::shipped() const {
    std::vector<std::filesystem::path> result;
    std::error_code ignored;
    for (const std::filesystem::path& folder : folders_) {
        const auto before = static_cast<std::ptrdiff_t>(result.size());
        for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
            if (entry.path().extension() == ".json") result.push_back(entry.path());
        std::sort(result.begin() + before, result.end());
    }
    return result;
}

bool LightChoice::update() {
    light_.want(path_ ? std::optional(path_) : std::nullopt,
                [path = path_, mapping = mapping_](const std::stop_token& stop, auto&&) {
                    Light light = load_light(*path, mapping);
                    return stop.stop_requested() ? std::nullopt : std::optional(std::move(light));
                });
    const auto change = poll(light_, messages_);
    if (change.value)
        messages_.say(current()->path.filename().string() + ": the light" +
                      (current()->image.mapping() == lighting::Mapping::Angular ? ", an angular map" : ""));
    return change.value || !change.failure.empty();
}

}  // namespace rowland::inspector
