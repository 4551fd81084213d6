#include "editor/inspector/open_file.h"

#include <string>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/efficiency_csv.h"
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

}  // namespace

bool is_scene_file(const std::filesystem::path& path) {
    return path.extension() == ".gltf" || path.extension() == ".glb";
}

bool is_picture_file(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

OpenedScene open_scene(const std::filesystem::path& path) {
    auto object = load_scene_object(path);
    Document document = Document::open_scene(scene::EditableGltf::open(path), object->without_material);
    return {std::move(object), std::move(document)};
}

OpenedFile open_file(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".csv")
        return diffraction::parse_efficiency_csv(read_text_file(path, diffraction::kMaximumNamedFileSize),
                                                 path.string());
    if (is_light_file(extension) || is_probe_recipe(path)) return LightSource{path};
    return Document::open(path);
}

bool replaces_material(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (is_scene_file(path)) return true;
    if (extension == ".csv" || is_light_file(extension) || is_picture_file(path)) return false;
    try {
        return !is_probe_recipe(path);
    } catch (const Error&) {
        return false;
    }
}

}  // namespace rowland::inspector
