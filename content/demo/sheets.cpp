#include "content/demo/sheets.h"

#include <memory>
#include <nlohmann/json.hpp>

#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material_json.h"
#include "modules/diffraction/runtime/glare_pattern.h"

namespace rowland::demo {

namespace {

diffraction::GltfGrating grating_of(const Sheet& sheet, const DemoScene& scene) {
    if (!sheet.file.empty())
        return diffraction::parse_gltf_extension(diffraction::load_material_json(sheet.file), sheet.file.string(),
                                                 sheet.file.parent_path());
    const nlohmann::json* json = scene.sheet();
    return diffraction::parse_gltf_extension(json != nullptr ? *json : nlohmann::json(), sheet.name, {},
                                             "/extras/glare");
}

}  // namespace

std::vector<Sheet> sheets(const Options& options, const DemoScene& scene) {
    if (options.glare) return {{options.glare->stem().string(), *options.glare}};
    std::vector<Sheet> all;
    if (scene.sheet() != nullptr) all.push_back({options.scene->filename().string() + "'s camera", {}});
    for (const char* name : {"diffraction_glasses", "feather", "screen_door", "camera_under_display"})
        if (const auto file = options.content_folder / "materials" / (std::string(name) + ".json");
            std::filesystem::exists(file))
            all.push_back({name, file});
    return all;
}

post::GlareSettings glare_of(const Sheet& sheet, const DemoScene& scene, const glm::dmat3& xyz_to_working) {
    const diffraction::GltfGrating grating = grating_of(sheet, scene);
    return {.pattern = std::make_shared<post::GlarePattern>(
                diffraction::glare_pattern(grating.material.grating, xyz_to_working)),
            .angle = static_cast<float>(grating.groove_rotation)};
}

}  // namespace rowland::demo
