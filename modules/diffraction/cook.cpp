#include "modules/diffraction/cook.h"

#include "engine/image/limits.h"
#include "engine/image/load.h"
#include "engine/lighting/clear_sky.h"
#include "engine/lighting/probe_recipe.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/gltf_object.h"
#include "modules/diffraction/asset/material_json.h"
#include "modules/diffraction/evaluate/budget.h"
#include "modules/diffraction/evaluate/error_measure.h"

namespace rowland::diffraction {

namespace {

/// Reads what a material names through the context, so that its cook depends on it.
ReadNamed read_through(cook::Context& context) {
    return [&context](const std::string& name) {
        const std::filesystem::path path = context.beside_source(name);
        const std::vector<std::byte> bytes = context.read(path, kMaximumNamedFileSize);
        return NamedText{.text = {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, .file = path.string()};
    };
}

image::Image read_image(cook::Context& context, const std::filesystem::path& path) {
    return image::decode_image(context.read(path, image::kMaximumFileBytes), path.string());
}

BudgetProbe read_recipe(cook::Context& context, const std::string& name) {
    const std::filesystem::path path = context.beside_source(name);
    const lighting::ProbeRecipe recipe = lighting::parse_probe_recipe(context.read_json(path), path.string());
    const auto beside_recipe = [&](const std::string& file) { return read_image(context, path.parent_path() / file); };
    return {.name = name,
            .image = lighting::render_recipe(recipe, beside_recipe, path.string()),
            .key_lights = recipe.settings.key_lights};
}

/// The light that a material's max_error is measured under.
std::vector<BudgetProbe> read_probes(cook::Context& context, const Quality& quality) {
    constexpr int kWidth = 1024;
    const int key_lights = lighting::LightProbeSettings().key_lights;
    if (quality.probes.empty())
        return {{.name = "the built-in clear sky",
                 .image = {lighting::render_clear_sky({}, kWidth), lighting::Mapping::Equirectangular, "clear sky"},
                 .key_lights = key_lights}};
    std::vector<BudgetProbe> probes;
    for (const MeasuredProbe& named : quality.probes) {
        const std::filesystem::path path = context.beside_source(named.file);
        if (path.extension() == ".json")
            probes.push_back(read_recipe(context, named.file));
        else
            probes.push_back({.name = named.file,
                              .image = {read_image(context, path), named.mapping, path.string()},
                              .key_lights = key_lights});
    }
    return probes;
}

/// Chooses the cheapest settings within the material's max_error, and pins them in `json`.
CookedMaterial choose(cook::Context& context, const Material& material, nlohmann::json& json) {
    const std::string file = context.source().string();
    require_baked_grooves(material.grating, file);
    const std::vector<BudgetProbe> probes = read_probes(context, material.quality);
    const std::vector<ShadingPoint> frames = measured_points(material.quality.measure, material.quality.surface);
    BudgetChoice choice = choose_representation(material, probes, frames, file);
    const nlohmann::json asked = json.value("quality", nlohmann::json::object());
    json["quality"] = choice.settings;
    json["quality"]["max_error"] = material.quality.max_error;
    if (asked.contains("illuminant")) json["quality"]["illuminant"] = asked["illuminant"];
    return std::move(choice.cooked);
}

std::vector<std::byte> cook_source(cook::Context& context) {
    nlohmann::json json = context.read_json(context.source());
    const Material material = parse_material(json, context.source().string(), read_through(context));
    const CookedMaterial cooked = material.quality.pinned
                                      ? cook_material(json, context.source().string(), read_through(context))
                                      : choose(context, material, json);
    return write_cooked_material(json, cooked);
}

void check_source(cook::Context& context) {
    const Material material =
        parse_material(context.read_json(context.source()), context.source().string(), read_through(context));
    if (!material.quality.pinned) read_probes(context, material.quality);
}

cook::GltfExtension gltf_extension() {
    cook::GltfExtension extension;
    extension.name = kGltfExtension;
    extension.describe = [](const nlohmann::json& object, const std::string& file, const std::string& pointer) {
        const std::filesystem::path folder = std::filesystem::path(file).parent_path();
        return describe(parse_gltf_extension(object, file, folder, pointer));
    };
    extension.source_type = kMaterialAssetType;
    extension.from_source = [](cook::Context& context) {
        const nlohmann::json json = context.read_json(context.source());
        parse_material(json, context.source().string(), read_through(context));
        const std::vector<std::byte> text = context.read(context.source(), kMaximumNamedFileSize);
        const auto* const begin = reinterpret_cast<const char*>(text.data());
        const std::filesystem::path folder = context.source().parent_path();
        return gltf_object(nlohmann::ordered_json::parse(begin, begin + text.size()), folder, folder);
    };
    extension.move = move_named_files;
    extension.rotation_member = "grooveRotation";
    extension.texture_member = "grooveTexture";
    return extension;
}

}  // namespace

void register_module(cook::Registry& registry) {
    registry.add_gltf_extension(gltf_extension());
    cook::AssetType type;
    type.name = kMaterialAssetType;
    type.version = kMaterialAssetVersion;
    type.extension = ".material";
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && json->is_object() && json->contains("grating");
    };
    type.cook = cook_source;
    type.check = check_source;
    type.describe = [](std::span<const std::byte> payload, const std::string& file) {
        return describe(read_cooked_material(payload, file));
    };
    registry.add(std::move(type));
}

}  // namespace rowland::diffraction
