#include "modules/diffraction/cook.h"

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::diffraction {

void register_cook_types(cook::Registry& registry) {
    cook::AssetType type;
    type.name = kMaterialAssetType;
    type.version = kMaterialAssetVersion;
    type.extension = ".material";
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && json->is_object() && json->contains("grating");
    };
    type.cook = [](cook::Context& context) {
        const nlohmann::json json = context.read_json(context.source());
        return write_cooked_material(json, cook_material(json, context.source().string()));
    };
    type.check = [](cook::Context& context) {
        parse_material(context.read_json(context.source()), context.source().string());
    };
    type.describe = [](std::span<const std::byte> payload, const std::string& file) {
        return describe(read_cooked_material(payload, file));
    };
    registry.add(std::move(type));
}

}  // namespace rowland::diffraction
