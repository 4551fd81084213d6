#include "engine/lighting/cook.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <variant>

#include "engine/core/json_schema.h"
#include "engine/image/image.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_recipe.h"

namespace rowland::lighting {

namespace {

bool is_probe_image_file(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".hdr" || extension == ".exr" || extension == ".pic";
}

image::Image read_image(cook::Context& context, const std::filesystem::path& path) {
    return image::decode_image(context.read(path, image::kMaximumFileBytes), path.string());
}

std::string read_illuminant_file(cook::Context& context, const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = context.read(path, colour::kMaximumIlluminantBytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

ProbeRecipe read_recipe(cook::Context& context) {
    ProbeRecipe recipe = parse_probe_recipe(context.read_json(context.source()), context.source().string());
    load_illuminant(recipe, [&context](const std::string& name) {
        return read_illuminant_file(context, context.beside_source(name));
    });
    return recipe;
}

ProbeImage make_probe(const ProbeRecipe& recipe, cook::Context& context) {
    return render_recipe(
        recipe, [&context](const std::string& name) { return read_image(context, context.beside_source(name)); },
        context.source().string());
}

cook::AssetType probe_type() {
    cook::AssetType type;
    type.name = "probe";
    type.version = kLightProbeVersion;
    type.extension = ".probe";
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && json->is_object() && json->contains("probe");
    };
    type.cook = [](cook::Context& context) {
        const ProbeRecipe recipe = read_recipe(context);
        return serialise(build_light_probe(make_probe(recipe, context), recipe.settings));
    };
    type.check = [](cook::Context& context) {
        const ProbeRecipe recipe = read_recipe(context);
        // A studio or a sky is computed from numbers that the recipe's parser has checked.
        if (std::holds_alternative<ImageRecipe>(recipe.source)) make_probe(recipe, context);
    };
    type.schema = [] {
        return json_schema("Rowland light probe recipe", [](JsonReader& json) { parse_probe_recipe(json); });
    };
    type.describe = [](std::span<const std::byte> payload, const std::string& file) {
        return describe(deserialise(payload, file));
    };
    return type;
}

cook::AssetType probe_image_type() {
    cook::AssetType type;
    type.name = "probe image";
    type.recognises = [](const std::filesystem::path& source, const nlohmann::json*) {
        return is_probe_image_file(source);
    };
    type.check = [](cook::Context& context) { read_image(context, context.source()); };
    return type;
}

}  // namespace

void register_cook_types(cook::Registry& registry) {
    registry.add(probe_type());
    registry.add(probe_image_type());
}

}  // namespace rowland::lighting
