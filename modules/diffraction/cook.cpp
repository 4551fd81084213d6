#include "modules/diffraction/cook.h"

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material_json.h"

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

}  // namespace

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
        return write_cooked_material(json, cook_material(json, context.source().string(), read_through(context)));
    };
    type.check = [](cook::Context& context) {
        parse_material(context.read_json(context.source()), context.source().string(), read_through(context));
    };
    type.describe = [](std::span<const std::byte> payload, const std::string& file) {
        return describe(read_cooked_material(payload, file));
    };
    registry.add(std::move(type));
}

}  // namespace rowland::diffraction
