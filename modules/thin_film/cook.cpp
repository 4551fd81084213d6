#include "modules/thin_film/cook.h"

#include <fmt/format.h>

#include "engine/core/json_schema.h"
#include "engine/scene/imported_scene.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/asset/gltf_iridescence.h"

namespace rowland::thin_film {

namespace {

cook::GltfExtension iridescence() {
    cook::GltfExtension extension;
    extension.name = kIridescenceExtension;
    extension.describe = [](const nlohmann::json& object, const std::string& file, const std::string& pointer) {
        return describe(parse_gltf_iridescence(object, file, pointer));
    };
    extension.version = kGltfFilmVersion;
    extension.cook = [](cook::Context& context, const cook::SceneExtension& film) {
        const std::string file = context.source().string();
        const std::optional<FilmMaterial> material =
            film_material(parse_gltf_iridescence(film.object, file, film.pointer), film.scene.materials[film.material],
                          file, film.pointer);
        return material ? write_gltf_film(*material, bake_film(*material)) : std::vector<std::byte>();
    };
    extension.describe_tables = [](std::span<const std::byte> tables, const std::string& file) {
        return tables.empty() ? std::string("table: none, the film is not drawn\n")
                              : describe(read_gltf_film(tables, file));
    };
    extension.source_type = kFilmAssetType;
    extension.from_source = [](cook::Context& context) {
        const std::string file = context.source().string();
        parse_film_material(context.read_json(context.source()), file);
        return gltf_object(context.read_ordered_json(context.source()), file);
    };
    extension.texture_member = "iridescenceThicknessTexture";
    return extension;
}

cook::GltfExtension ior() {
    cook::GltfExtension extension;
    extension.name = kIorExtension;
    extension.describe = [](const nlohmann::json& object, const std::string& file, const std::string& pointer) {
        return fmt::format("ior {:g}, under a film only", parse_gltf_ior(object, file, pointer));
    };
    return extension;
}

std::vector<std::byte> cook_source(cook::Context& context) {
    const nlohmann::json json = context.read_json(context.source());
    return write_cooked_film(json, cook_film(json, context.source().string()));
}

}  // namespace

void register_module(cook::Registry& registry) {
    registry.add_gltf_extension(iridescence());
    registry.add_gltf_extension(ior());
    cook::AssetType type;
    type.name = kFilmAssetType;
    type.version = kFilmAssetVersion;
    type.extension = ".film";
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && json->is_object() && json->contains("film");
    };
    type.cook = cook_source;
    type.schema = [] { return json_schema("Rowland thin film", [](JsonReader& json) { parse_film_material(json); }); };
    type.check = [](cook::Context& context) {
        parse_film_material(context.read_json(context.source()), context.source().string());
    };
    type.describe = [](std::span<const std::byte> payload, const std::string& file) {
        return describe(read_cooked_film(payload, file));
    };
    registry.add(std::move(type));
}

}  // namespace rowland::thin_film
