#include "engine/lighting/probe_recipe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/image/image.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::lighting {

namespace {

constexpr NumberRange kRadiance{.minimum = 0, .maximum = 1e6};
constexpr NumberRange kAzimuth{.minimum = -360, .maximum = 360};

glm::dvec3 read_rgb(JsonReader& reader, const std::string& key, NumberRange range) {
    const auto values = reader.numbers(key, 3, range);
    return {values[0], values[1], values[2]};
}

SoftBox parse_box(JsonReader& reader) {
    SoftBox box;
    box.azimuth_deg = reader.number("azimuth_deg", kAzimuth);
    box.elevation_deg = reader.number("elevation_deg", {.minimum = -90, .maximum = 90});
    box.roll_deg = reader.number_or("roll_deg", 0, kAzimuth);
    const auto half = reader.numbers("half_size_deg", 2, {.minimum = 0.1, .maximum = 80});
    box.half_width_deg = half[0];
    box.half_height_deg = half[1];
    box.soft_edge_deg = reader.number_or("soft_edge_deg", 0, {.minimum = 0, .maximum = 80});
    box.radiance = read_rgb(reader, "radiance", kRadiance);
    reader.finish();
    return box;
}

StudioRecipe parse_studio(JsonReader& reader) {
    StudioRecipe studio;
    studio.ceiling = read_rgb(reader, "ceiling", kRadiance);
    studio.wall = read_rgb(reader, "wall", kRadiance);
    studio.floor = read_rgb(reader, "floor", kRadiance);
    constexpr std::size_t kMaximumBoxes = 256;
    for (JsonReader& box : reader.objects("boxes", 0, kMaximumBoxes)) studio.boxes.push_back(parse_box(box));
    return studio;
}

ClearSkyRecipe parse_clear_sky(JsonReader& reader) {
    ClearSkyRecipe sky;
    sky.sun_azimuth_deg = reader.number("sun_azimuth_deg", kAzimuth);
    sky.sun_elevation_deg = reader.number("sun_elevation_deg", {.minimum = 1, .maximum = 90});
    sky.sun_angular_diameter_deg =
        reader.number_or("sun_angular_diameter_deg", sky.sun_angular_diameter_deg, {.minimum = 0.2, .maximum = 20});
    sky.turbidity = reader.number_or("turbidity", sky.turbidity, {.minimum = 2, .maximum = 6});
    if (reader.has("ground_albedo")) sky.ground_albedo = read_rgb(reader, "ground_albedo", kFraction);
    return sky;
}

ImageRecipe parse_image(JsonReader& reader) {
    ImageRecipe recipe;
    recipe.file = reader.file_name("file", "a .hdr or .exr file beside the recipe");
    recipe.mapping = parse_mapping(reader.choice_or("mapping", "equirect", {"equirect", "angular"}));
    return recipe;
}

std::optional<CaptureDome> parse_dome(JsonReader& reader) {
    if (!reader.has("dome")) return std::nullopt;
    JsonReader object = reader.object("dome");
    CaptureDome dome;
    dome.height_m = object.number("height_m", {.minimum = 0, .maximum = kLargestDome_m, .exclusive_minimum = true});
    const double least = object.is_recording_schema() ? 0.0 : dome.height_m;
    dome.radius_m = object.number("radius_m", {.minimum = least, .maximum = kLargestDome_m, .exclusive_minimum = true});
    object.finish();
    return dome;
}

int parse_width(JsonReader& reader, int fallback) {
    const auto width = static_cast<int>(reader.integer_or("width", fallback, 64, 8192));
    reader.annotate("width", R"({"multipleOf": 4})");
    if (width % 4 != 0 && !reader.is_recording_schema()) reader.fail("width", std::to_string(width), "a multiple of 4");
    return width;
}

LightProbeSettings parse_settings(JsonReader& reader) {
    LightProbeSettings settings;
    settings.bands = static_cast<int>(reader.integer_or("bands", settings.bands, 1, math::kMaximumBands));
    settings.key_lights = static_cast<int>(reader.integer_or("key_lights", settings.key_lights, 0, kMaximumKeyLights));
    auto& size = settings.prefilter.face_size;
    size = static_cast<int>(reader.integer_or("face_size", size, 16, 1024));
    reader.annotate("face_size", R"({"enum": [16, 32, 64, 128, 256, 512, 1024]})");
    if (!std::has_single_bit(static_cast<unsigned>(size)))
        reader.fail("face_size", std::to_string(size), "a power of two");
    return settings;
}

/// Reads a built-in illuminant, or the name of a file that holds one, into `recipe`.
void parse_illuminant(JsonReader& reader, ProbeRecipe& recipe) {
    if (!reader.has("illuminant")) return;
    const std::variant<colour::Illuminant, std::string> named = colour::read_illuminant(reader, "the recipe");
    if (const auto* builtin = std::get_if<colour::Illuminant>(&named))
        recipe.settings.illuminant = *builtin;
    else
        recipe.illuminant_file = std::get<std::string>(named);
}

image::Image source_image(const ProbeRecipe& recipe, const std::function<image::Image(const std::string&)>& load) {
    if (const auto* studio = std::get_if<StudioRecipe>(&recipe.source)) return render_studio(*studio, recipe.width);
    if (const auto* sky = std::get_if<ClearSkyRecipe>(&recipe.source)) return render_clear_sky(*sky, recipe.width);
    return load(std::get<ImageRecipe>(recipe.source).file);
}

}  // namespace

ProbeRecipe parse_probe_recipe(JsonReader& document) {
    JsonReader reader = document.object("probe");
    document.finish();
    ProbeRecipe recipe;
    std::optional<CaptureDome> dome;
    enum Type : std::size_t { Studio, ClearSky, Image };
    reader.variant("type", {"studio", "clear_sky", "image"}, [&](JsonReader& json, std::size_t type) {
        if (type == Image) {
            recipe.source = parse_image(json);
            dome = parse_dome(json);
            return;
        }
        if (type == Studio)
            recipe.source = parse_studio(json);
        else
            recipe.source = parse_clear_sky(json);
        recipe.width = parse_width(json, recipe.width);
    });
    recipe.intensity = reader.number_or("intensity", 1, {.minimum = 1e-6, .maximum = 1e6});
    recipe.settings = parse_settings(reader);
    recipe.settings.dome = dome;
    parse_illuminant(reader, recipe);
    reader.finish();
    return recipe;
}

ProbeRecipe parse_probe_recipe(const nlohmann::json& json, const std::string& file) {
    JsonReader document(json, file);
    return parse_probe_recipe(document);
}

void load_illuminant(ProbeRecipe& recipe, const std::function<std::string(const std::string&)>& load_text) {
    if (recipe.illuminant_file.empty()) return;
    recipe.settings.illuminant = colour::parse_illuminant(load_text(recipe.illuminant_file), recipe.illuminant_file);
}

ProbeImage render_recipe(const ProbeRecipe& recipe, const std::function<image::Image(const std::string&)>& load,
                         const std::string& file) {
    image::Image image = source_image(recipe, load);
    if (recipe.intensity != 1)
        for (glm::vec3& texel : image.texels) texel *= static_cast<float>(recipe.intensity);
    const auto* capture = std::get_if<ImageRecipe>(&recipe.source);
    if (capture == nullptr) return {std::move(image), Mapping::Equirectangular, file};
    ProbeImage probe(std::move(image), capture->mapping, capture->file);
    warn_about(probe, capture->file);
    return probe;
}

FullResolutionProbe load_full_resolution_probe(const std::filesystem::path& path, const std::string& mapping) {
    constexpr std::uint64_t kMaximumRecipeBytes = 16 << 20;
    const std::string file = path.string();
    if (path.extension() != ".json")
        return {.image = {image::load_image(path), parse_mapping(mapping), file},
                .key_lights = LightProbeSettings().key_lights};
    const ProbeRecipe recipe = parse_probe_recipe(parse_json(read_text_file(path, kMaximumRecipeBytes), file), file);
    const auto beside = [&](const std::string& name) { return image::load_image(path.parent_path() / name); };
    return {.image = render_recipe(recipe, beside, file), .key_lights = recipe.settings.key_lights};
}

}  // namespace rowland::lighting
