#include "modules/diffraction/cook.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/json_schema.h"
#include "engine/core/log.h"
#include "engine/image/image.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/lighting/procedural_probe.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/groove_pitches.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/evaluate/budget.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/foil/card.h"

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

/// For schemas: files are named, not read.
NamedText read_nothing(const std::string& name) {
    return {.text = {}, .file = name};
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

/// A material in a source: its JSON as a material file has it.
struct MaterialSource {
    nlohmann::json json;
    Material material;
};

/// Pins the chosen settings in the material's JSON.
void pin(const nlohmann::json& settings, MaterialSource& source) {
    const nlohmann::json asked = source.json.value("quality", nlohmann::json::object());
    nlohmann::json& quality = source.json["quality"];
    quality = settings;
    quality["max_error"] = source.material.quality.max_error;
    if (asked.contains("illuminant")) quality["illuminant"] = asked["illuminant"];
}

std::vector<MeasuredViews> views_under(std::span<const BudgetProbe> probes, const Material& material) {
    std::vector<MeasuredViews> views;
    for (const BudgetProbe& probe : probes) views.push_back(drawn_views(material, probe.image));
    return views;
}

/// The members of a "quality" that pin its representation.
nlohmann::json pinned_settings(const nlohmann::json& quality) {
    const RepresentationInfo& info = *find_representation(quality.at("representation").get<std::string>());
    nlohmann::json settings{{"representation", info.name}};
    if (quality.contains("key_lights") && quality["key_lights"].is_number())
        settings["key_lights"] = quality["key_lights"];
    for (const SettingInfo& setting : info.settings)
        if (quality.contains(setting.key)) settings[setting.key] = quality[setting.key];
    return settings;
}

/// Chooses the cheapest settings within the material's max_error, and pins them.
CookedMaterial choose(cook::Context& context, MaterialSource& source, const ChoiceRules& rules) {
    const std::string file = context.source().string();
    const std::vector<BudgetProbe> probes = read_probes(context, source.material.quality);
    BudgetChoice choice =
        choose_representation(source.material, probes, views_under(probes, source.material), file, rules);
    pin(choice.settings, source);
    return std::move(choice.cooked);
}

std::vector<std::byte> cook_source(cook::Context& context) {
    const std::string file = context.source().string();
    nlohmann::json json = context.read_json(context.source());
    Material material = parse_material(json, file, read_through(context));
    require_baked_grooves(material.grating, file);
    material = with_efficiencies(std::move(material), file);
    MaterialSource source{.json = std::move(json), .material = std::move(material)};
    const CookedMaterial cooked =
        source.material.quality.pinned ? bake_material(source.material) : choose(context, source, {});
    return write_cooked_material(source.json, cooked);
}

/// Whether every instance with a scene's material is flat.
bool is_flat(const scene::ImportedScene& scene, std::size_t material) {
    constexpr float kFlatness = 0.005F;  // radians
    return std::ranges::all_of(scene.instances, [&](const scene::ImportedInstance& instance) {
        const std::vector<glm::vec3>& normals = scene.meshes[instance.mesh].normals;
        return instance.material != material || std::ranges::all_of(normals, [&](const glm::vec3& normal) {
                   return glm::distance(normal, normals.front()) < kFlatness;
               });
    });
}

std::optional<GroovePitches> pitches_of(const GltfGrating& grating, const cook::SceneExtension& extension,
                                        const std::string& file) {
    if (!grating.groove_texture) return std::nullopt;
    const auto index = static_cast<std::size_t>(grating.groove_texture->index);
    scene::require_texture(extension.scene, index, file, extension.pointer + "/grooveTexture");
    return groove_pitches(*extension.scene.images[extension.scene.textures[index].image]);
}

/// GltfExtension::part_key. The grooves' rotation is the surface's.
std::string part_key(const cook::SceneExtension& extension) {
    nlohmann::json object = extension.object;
    object.erase("grooveRotation");
    std::string key = object.dump() + (is_flat(extension.scene, extension.material) ? " flat" : " curved");
    if (const auto use = extension.object.find("grooveTexture"); use != extension.object.end()) {
        const nlohmann::json index = use->is_object() ? use->value("index", nlohmann::json()) : nlohmann::json();
        const auto& textures = extension.scene.textures;
        if (index.is_number_integer() && index >= 0 && index < textures.size())
            if (const auto& image = extension.scene.images[textures[index.get<std::size_t>()].image])
                key += ' ' + Hasher()
                                 .bytes(std::as_bytes(std::span(image->rgba)))
                                 .bytes(std::as_bytes(std::span(image->rgba16)))
                                 .digest()
                                 .hex();
    }
    return key;
}

/// Cooks a grating of a scene. Errors are measured without the groove texture.
std::vector<std::byte> cook_extension(cook::Context& context, const cook::SceneExtension& extension) {
    const std::string file = context.source().string();
    GltfGrating grating = parse_gltf_extension(extension.object, file, read_through(context), extension.pointer);
    const std::optional<GroovePitches> pitches = pitches_of(grating, extension, file);
    const GroovePitches* const of_texture = pitches ? &*pitches : nullptr;
    drawable_material(grating, of_texture, file, extension.pointer);  // refuses what cannot be drawn

    grating.material = with_efficiencies(std::move(grating.material), file);
    MaterialSource source{.json = material_members(extension.object), .material = std::move(grating.material)};
    const nlohmann::json asked = source.json.value("quality", nlohmann::json::object());
    Quality& quality = source.material.quality;
    if (!asked.contains("surface") && !is_flat(extension.scene, extension.material))
        quality.surface = SurfaceShape::Curved;
    const auto suits_texture = [&](const Quality& candidate) {
        Material with = source.material;
        with.quality = candidate;
        return !groove_refusal(with, *pitches);
    };
    ChoiceRules rules{.pointer = extension.pointer, .must_meet_budget = asked.contains("max_error")};
    if (pitches) rules.allows = suits_texture;
    CookedMaterial cooked;
    if (quality.pinned) {
        cooked.material = source.material;
        const std::vector<BudgetProbe> probes = read_probes(context, quality);
        std::vector<MeasuredViews> views = views_under(probes, source.material);
        for (MeasuredViews& few : views) few.parts.resize(1);  // the error of what is pinned decides nothing
        if (auto record = measure_pinned(source.material, pinned_settings(asked), probes, views, rules.allows)) {
            cooked.measured = std::move(record->measured);
            cooked.cheaper = std::move(record->cheaper);
        }
    } else {
        cooked = choose(context, source, rules);
    }
    if (quality.pinned || pitches) {
        CookedMaterial measured = std::move(cooked);
        const auto bake_drawn = [&](const Quality& drawn) {
            grating.material = measured.material;
            grating.material.quality = drawn;
            return bake_material(drawable_material(grating, of_texture, file, extension.pointer));
        };
        cooked = bake_drawn(measured.material.quality);
        cooked.measured = std::move(measured.measured);
        cooked.cheaper = std::move(measured.cheaper);
        if (pitches)
            for (CookedRung& rung : cooked.cheaper)
                if (rung.baked) rung.baked = std::make_shared<const CookedMaterial>(bake_drawn(rung.quality));
    }
    return write_gltf_tables(source.json, cooked, pitches.value_or(GroovePitches{}));
}

void check_source(cook::Context& context) {
    const Material material =
        parse_material(context.read_json(context.source()), context.source().string(), read_through(context));
    if (!material.quality.pinned) read_probes(context, material.quality);
}

cook::GltfExtension gltf_extension() {
    cook::GltfExtension extension;
    extension.name = kGltfExtension;
    extension.schema = [] {
        return json_schema(kGltfExtension, [](JsonReader& json) { parse_gltf_extension(json, read_nothing); });
    };
    extension.describe = [](const nlohmann::json& object, const std::string& file, const std::string& pointer) {
        const std::filesystem::path folder = std::filesystem::path(file).parent_path();
        return describe(parse_gltf_extension(object, file, folder, pointer));
    };
    extension.version = kGltfTablesVersion + kMaterialAssetVersion;
    extension.cook = cook_extension;
    extension.part_key = part_key;
    extension.describe_tables = [](std::span<const std::byte> tables, const std::string& file) {
        return describe(read_gltf_tables(tables, file));
    };
    extension.source_type = kMaterialAssetType;
    extension.from_source = [](cook::Context& context) {
        const nlohmann::json json = context.read_json(context.source());
        parse_material(json, context.source().string(), read_through(context));
        const std::filesystem::path folder = context.source().parent_path();
        return gltf_object(context.read_ordered_json(context.source()), folder, folder);
    };
    extension.move = move_named_files;
    extension.rotation_member = "grooveRotation";
    extension.texture_member = "grooveTexture";
    return extension;
}

constexpr std::uint64_t kMaximumPictureFile = std::uint64_t{256} << 20;

std::vector<std::byte> cook_foil(cook::Context& context) {
    const std::string file = context.source().string();
    const foil::Recipe recipe = foil::parse_foil_recipe(context.read_json(context.source()), file);
    foil::NamedPictures pictures;
    for (const std::string& name : foil::picture_names(recipe)) {
        const std::filesystem::path path = context.beside_source(name);
        pictures[name] = {path.string(), context.read(path, kMaximumPictureFile, "scale the picture down")};
    }
    Progress progress("foil", foil::kCardSteps);
    return foil::make_card(recipe, pictures, file, [&] { progress.advance(); });
}

cook::AssetType foil_type() {
    cook::AssetType type;
    type.name = foil::kFoilAssetType;
    type.extension = ".glb";
    type.in_container = false;
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && foil::is_foil_recipe(*json);
    };
    type.cook = cook_foil;
    type.schema = [] {
        return json_schema("Rowland foil recipe", [](JsonReader& json) { foil::parse_foil_recipe(json); });
    };
    type.check = [](cook::Context& context) { cook_foil(context); };
    type.describe = [](std::span<const std::byte> payload, const std::string& file) {
        const std::vector<std::string> extensions = {kGltfExtension};
        const scene::ImportedScene card = scene::load_glb(payload, file, extensions);
        std::string text = "format: glTF 2.0 binary\n";
        for (const scene::MaterialDescription& material : card.materials)
            if (const auto found = material.extensions.find(kGltfExtension); found != material.extensions.end())
                text += "foil: " + describe(parse_gltf_extension(found->second, file, read_nothing, "")) + "\n";
        return text;
    };
    return type;
}

}  // namespace

void register_module(cook::Registry& registry) {
    registry.add_gltf_extension(gltf_extension());
    registry.add(foil_type());
    cook::AssetType type;
    type.name = kMaterialAssetType;
    type.version = kMaterialAssetVersion;
    type.extension = ".material";
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && json->is_object() && json->contains("grating");
    };
    type.cook = cook_source;
    type.schema = [] {
        return json_schema("Rowland grating material", [](JsonReader& json) {
            parse_material(json, read_nothing);
            json.finish();
        });
    };
    type.check = check_source;
    type.describe = [](std::span<const std::byte> payload, const std::string& file) {
        return describe(read_cooked_material(payload, file));
    };
    registry.add(std::move(type));
}

}  // namespace rowland::diffraction
