#include "editor/inspector/open_file.h"

#include <array>
#include <string>
#include <utility>

#include "editor/inspector/preview_shape.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/scene/gltf_import.h"
#include "modules/diffraction/asset/efficiency_csv.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::inspector {

namespace {

constexpr std::uint64_t kLargestSource = 16 << 20;

bool is_light_file(const std::string& extension) {
    return extension == ".hdr" || extension == ".exr" || extension == ".pic" || extension == ".probe";
}

bool is_probe_recipe(const std::filesystem::path& path) {
    const nlohmann::json json = parse_json(read_text_file(path, kLargestSource), path.string());
    return json.is_object() && json.contains("probe");
}

OpenedModel open_gltf(const std::filesystem::path& path) {
    const std::array<std::string, 1> handled = {diffraction::kGltfExtension};
    const scene::ImportedScene imported = scene::load_gltf(path, handled);
    OpenedModel model{fitted_model(scene::merge_instances(imported)), std::nullopt};
    for (const scene::MaterialDescription& description : imported.materials) {
        const auto found = description.extensions.find(diffraction::kGltfExtension);
        if (found == description.extensions.end()) continue;
        Json material = Json::object();
        for (const char* part : {"grating", "metal", "cover", "base", "quality"})
            if (found->second.contains(part)) material[part] = Json(found->second[part]);
        model.document = Document::make_new(std::move(material), path.filename().string(),
                                            std::filesystem::absolute(path).parent_path());
        break;
    }
    return model;
}

}  // namespace

OpenedFile open_file(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".gltf" || extension == ".glb") return open_gltf(path);
    if (extension == ".csv")
        return diffraction::parse_efficiency_csv(read_text_file(path, diffraction::kMaximumNamedFileSize),
                                                 path.string());
    if (is_light_file(extension) || is_probe_recipe(path)) return LightSource{path};
    return Document::open(path);
}

bool replaces_material(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".gltf" || extension == ".glb") return true;
    if (extension == ".csv" || is_light_file(extension)) return false;
    try {
        return !is_probe_recipe(path);
    } catch (const Error&) {
        return false;
    }
}

}  // namespace rowland::inspector
