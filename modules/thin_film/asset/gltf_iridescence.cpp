#include "modules/thin_film/asset/gltf_iridescence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/common.hpp>
#include <limits>

#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "modules/thin_film/asset/film_material.h"

namespace rowland::thin_film {

namespace {

constexpr std::int64_t kLargestIndex = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kLastUvSet = 1;

/// glTF allows both members on every object, with any content.
void allow_foreign(JsonReader& json) {
    json.has("extras");
    json.has("extensions");
}

void parse_uv_transform(JsonReader json, scene::TextureUse& use) {
    use.transform = {.offset = read_vector_or(json, "offset", glm::vec2(0.0F), kFiniteFloat),
                     .rotation = static_cast<float>(json.number_or("rotation", 0.0, kFiniteFloat)),
                     .scale = read_vector_or(json, "scale", glm::vec2(1.0F), kFiniteFloat)};
    use.uv_set = static_cast<int>(json.integer_or("texCoord", use.uv_set, 0, kLastUvSet));
}

std::optional<scene::TextureUse> parse_texture(JsonReader& json, const char* key) {
    std::optional<JsonReader> info = json.object_if_there(key);
    if (!info) return std::nullopt;
    scene::TextureUse use{.texture = static_cast<std::size_t>(info->integer("index", 0, kLargestIndex)),
                          .uv_set = static_cast<int>(info->integer_or("texCoord", 0, 0, kLastUvSet)),
                          .transform = {}};
    if (auto extensions = info->object_if_there("extensions"))
        if (auto transform = extensions->object_if_there("KHR_texture_transform")) parse_uv_transform(*transform, use);
    allow_foreign(*info);
    info->finish();
    return use;
}

/// The index of the material's KHR_materials_ior, by default glTF's 1.5.
double dielectric_ior(const scene::MaterialDescription& description, const std::string& file,
                      const std::string& pointer) {
    const auto found = description.extensions.find(kIorExtension);
    constexpr double kDefault = 1.5;
    if (found == description.extensions.end()) return kDefault;
    return parse_gltf_ior(found->second, file, pointer.substr(0, pointer.rfind('/') + 1) + kIorExtension);
}

/// PHYSICS §3: what the file names, else an index that gives the metallic-roughness surface's reflectance at normal
/// incidence.
Base base_of(const GltfIridescence& iridescence, const scene::MaterialDescription& description, double ior) {
    if (iridescence.base) return *iridescence.base;
    if (description.metallic == 0.0F) return std::complex<double>(ior, 0.0);
    const double dielectric = std::pow((ior - 1.0) / (ior + 1.0), 2.0);
    const glm::dvec3 colour = glm::clamp(glm::dvec3(description.base_colour), 0.0, 1.0);
    return NormalReflectance{glm::mix(glm::dvec3(dielectric), colour, static_cast<double>(description.metallic))};
}

}  // namespace

GltfIridescence parse_gltf_iridescence(const nlohmann::json& json, const std::string& file,
                                       const std::string& pointer) {
    JsonReader reader(json, file, pointer);
    GltfIridescence read;
    read.factor = reader.number_or("iridescenceFactor", read.factor, {.minimum = 0.0, .maximum = 1.0});
    read.factor_texture = parse_texture(reader, "iridescenceTexture");
    read.ior = reader.number_or("iridescenceIor", read.ior, kFilmIndexRange);
    read.minimum_thickness_nm =
        reader.number_or("iridescenceThicknessMinimum", read.minimum_thickness_nm, kThicknessRange_nm);
    read.maximum_thickness_nm =
        reader.number_or("iridescenceThicknessMaximum", read.maximum_thickness_nm, kThicknessRange_nm);
    read.thickness_texture = parse_texture(reader, "iridescenceThicknessTexture");
    if (reader.has("extras") && reader.raw("extras").is_object()) {
        JsonReader extras = reader.object("extras");
        if (extras.has("metal") || extras.has("base")) read.base = parse_base(extras);
        read.illuminant = colour::read_builtin_illuminant(extras);
    }
    allow_foreign(reader);
    reader.finish();
    return read;
}

double parse_gltf_ior(const nlohmann::json& json, const std::string& file, const std::string& pointer) {
    JsonReader reader(json, file, pointer);
    const double ior = reader.number_or("ior", 1.5, {.minimum = 0.0, .maximum = 1e6});
    if (ior > 0.0 && ior < 1.0) reader.fail("ior", fmt::format("{}", ior), "0, or a number from 1 up");
    allow_foreign(reader);
    reader.finish();
    constexpr double kInfinite = 1e6;
    return ior == 0.0 ? kInfinite : ior;
}

std::optional<FilmMaterial> film_material(const GltfIridescence& iridescence,
                                          const scene::MaterialDescription& description, const std::string& file,
                                          const std::string& pointer) {
    if (iridescence.factor == 0.0 || description.unlit) return std::nullopt;
    const bool varies = iridescence.thickness_texture.has_value();
    const double other_nm = varies ? iridescence.minimum_thickness_nm : iridescence.maximum_thickness_nm;
    const auto [thinnest_nm, thickest_nm] = std::minmax(other_nm, iridescence.maximum_thickness_nm);
    const double roughness = description.roughness;
    const double ior = dielectric_ior(description, file, pointer);
    return FilmMaterial{.film = {.layers = {{.index = iridescence.ior, .thickness_nm = thickest_nm}},
                                 .base = base_of(iridescence, description, ior)},
                        .range = {.thinnest_nm = thinnest_nm,
                                  .thickest_nm = thickest_nm,
                                  .smoothest = description.metallic_roughness_texture ? 0.0 : roughness,
                                  .roughest = roughness},
                        .illuminant = iridescence.illuminant};
}

nlohmann::ordered_json gltf_object(const nlohmann::ordered_json& material, const std::string& file) {
    const nlohmann::ordered_json& film = material.at("film");
    const auto refuse = [&](std::string found) {
        refuse_input(file, "/film", std::move(found), "one layer without \"k\"",
                     "KHR_materials_iridescence holds no other; cook the film by itself");
    };
    if (film.is_array() && film.size() != 1) refuse(fmt::format("{} layers", film.size()));
    const nlohmann::ordered_json& layer = film.is_array() ? film.front() : film;
    if (layer.value("k", 0.0) != 0.0) refuse("a layer that absorbs");
    nlohmann::ordered_json object = {{"iridescenceFactor", 1},
                                     {"iridescenceIor", layer.at("ior")},
                                     {"iridescenceThicknessMinimum", 0},
                                     {"iridescenceThicknessMaximum", layer.at("thickness_nm")}};
    for (const char* member : {"base", "metal", "illuminant"})
        if (material.contains(member)) object["extras"][member] = material[member];
    return object;
}

std::string describe(const GltfIridescence& iridescence) {
    const std::string thickness =
        iridescence.thickness_texture
            ? fmt::format("{:g} to {:g}", iridescence.minimum_thickness_nm, iridescence.maximum_thickness_nm)
            : fmt::format("{:g}", iridescence.maximum_thickness_nm);
    return fmt::format("{} nm of ior {:g}, factor {:g}", thickness, iridescence.ior, iridescence.factor);
}

}  // namespace rowland::thin_film
