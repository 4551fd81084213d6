#include "editor/inspector/material_source.h"

#include "engine/core/utf8.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::inspector {

namespace {

/// Rewrites a file name that is relative to one folder so that it is relative to another.
void move_name(Json& name, const std::filesystem::path& from, const std::filesystem::path& to) {
    if (!name.is_string()) return;
    const std::filesystem::path file = name.get<std::string>();
    if (file.empty() || file.is_absolute()) return;
    name = require_utf8(std::filesystem::proximate(from / file, to), "rename it, or save elsewhere");
}

}  // namespace

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
    if (from == to || !material.is_object() || !material.contains("grating")) return material;
    Json& profile = material["grating"]["profile"];
    if (profile.contains("file")) move_name(profile["file"], from, to);
    if (!material.contains("quality")) return material;
    Json& quality = material["quality"];
    if (quality.contains("illuminant") && quality["illuminant"].is_string() &&
        quality["illuminant"].get<std::string>().ends_with(".csv"))
        move_name(quality["illuminant"], from, to);
    if (quality.contains("probes"))
        for (Json& probe : quality["probes"]) move_name(probe.is_object() ? probe["image"] : probe, from, to);
    return material;
}

}  // namespace rowland::inspector
