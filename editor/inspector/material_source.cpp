#include "editor/inspector/material_source.h"

#include "engine/core/utf8.h"
#include "modules/diffraction/asset/gltf_object.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::inspector {

std::shared_ptr<const MaterialSource> accept_material(const Json& material, const std::string& file,
                                                      const std::filesystem::path& folder) {
    diffraction::Material parsed =
        diffraction::parse_material(nlohmann::json(material), file, diffraction::read_beside(folder));
    diffraction::GltfGrating alone;
    alone.material = parsed;
    alone.has_base = true;
    return std::make_shared<const MaterialSource>(MaterialSource{material, std::move(parsed), file, std::move(alone)});
}

std::shared_ptr<const MaterialSource> accept_extension(const Json& extension, const std::string& file,
                                                       const std::filesystem::path& folder, const std::string& pointer,
                                                       const NewTextures* textures) {
    diffraction::GltfGrating parsed =
        diffraction::parse_gltf_extension(nlohmann::json(extension), file, folder, pointer);
    MaterialSource source{extension, parsed.material, file, std::move(parsed)};
    if (textures != nullptr && source.gltf.groove_texture)
        source.groove_picture = textures->find(static_cast<std::size_t>(source.gltf.groove_texture->index));
    return std::make_shared<const MaterialSource>(std::move(source));
}

Json moved(Json material, const std::filesystem::path& from, const std::filesystem::path& to) {
    if (from == to) return material;
    diffraction::move_named_files(material, from, to);
    if (!material.is_object() || !material.contains("quality") || !material["quality"].contains("probes"))
        return material;
    for (Json& probe : material["quality"]["probes"]) {
        Json& name = probe.is_object() ? probe["image"] : probe;
        if (name.is_string())
            name = require_utf8(std::filesystem::proximate(from / name.get<std::string>(), to),
                                "rename it, or save elsewhere");
    }
    return material;
}

}  // namespace rowland::inspector
