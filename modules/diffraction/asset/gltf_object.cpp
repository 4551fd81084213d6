#include "modules/diffraction/asset/gltf_extension.h"

#include <fmt/format.h>

#include <numbers>

#include "engine/core/text.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

namespace {

using OrderedJson = nlohmann::ordered_json;

/// Rewrites the member under `key` if it is a relative file name that ends in `extension`, which distinguishes files of
/// illuminants from built-in ones.
void move_name(OrderedJson& owner, const char* key, const std::string& extension, const std::filesystem::path& from,
               const std::filesystem::path& to) {
    if (!owner.is_object() || !owner.contains(key) || !owner[key].is_string()) return;
    const std::string name = owner[key];
    if (!name.ends_with(extension) || std::filesystem::path(name).has_root_directory()) return;
    const auto canonical = [](const std::filesystem::path& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
    };
    // Between drives only whole names lead.
    const std::filesystem::path moved = canonical(from / name).lexically_proximate(canonical(to));
    owner[key] = require_utf8(moved.generic_string(), "rename the folders between the two");
}

}  // namespace

OrderedJson gltf_object(OrderedJson material, const std::filesystem::path& from, const std::filesystem::path& folder) {
    material.erase("base");
    move_named_files(material, from, folder);
    return material;
}

void move_named_files(OrderedJson& object, const std::filesystem::path& from, const std::filesystem::path& to) {
    const auto member = [](OrderedJson& owner, const char* key) -> OrderedJson* {
        return owner.is_object() && owner.contains(key) ? &owner[key] : nullptr;
    };
    OrderedJson* grating = member(object, "grating");
    OrderedJson* profile = grating ? member(*grating, "profile") : nullptr;
    if (profile) move_name(*profile, "file", "", from, to);
    OrderedJson* quality = member(object, "quality");
    if (!quality) return;
    move_name(*quality, "illuminant", ".csv", from, to);
    OrderedJson* probes = member(*quality, "probes");
    if (!probes || !probes->is_array()) return;
    for (OrderedJson& probe : *probes) {
        if (probe.is_object()) move_name(probe, "image", "", from, to);
        OrderedJson recipe = {{"name", probe}};
        move_name(recipe, "name", "", from, to);
        probe = recipe["name"];
    }
}

std::string describe(const GltfGrating& grating) {
    const Grating& grooves = grating.material.grating;
    std::string text = fmt::format("{:g} nm {}", grooves.pitch_nm,
                                   grooves.lattice ? "lattice" : profile_descriptors()[grooves.profile.index()].name);
    if (grating.groove_rotation != 0.0)
        text += fmt::format(", grooves turned by {:.4g} degrees", grating.groove_rotation * 180.0 / std::numbers::pi);
    if (grating.groove_texture) text += fmt::format(", groove texture {}", grating.groove_texture->index);
    return text;
}

nlohmann::json material_members(nlohmann::json object) {
    for (const char* key : {"grooveRotation", "grooveTexture", "extras", "extensions"}) object.erase(key);
    return object;
}

}  // namespace rowland::diffraction
