#include "modules/thin_film/asset/film_material.h"

#include <fmt/format.h>

#include <vector>

#include "engine/colour/colour_json.h"

namespace rowland::thin_film {

namespace {

constexpr NumberRange kBaseIndex{.minimum = 0.01, .maximum = 100.0};
constexpr NumberRange kExtinction{.minimum = 0.0, .maximum = 100.0};
constexpr NumberRange kUnit{.minimum = 0.0, .maximum = 1.0};

Layer parse_layer(JsonReader json) {
    const double ior = json.number("ior", kFilmIndex);
    const Layer layer{.index = {ior, json.number_or("k", 0.0, kExtinction)},
                      .thickness_nm = json.number("thickness_nm", kThickness_nm)};
    json.finish();
    return layer;
}

std::vector<Layer> parse_layers(JsonReader& json) {
    if (!json.raw("film").is_array()) return {parse_layer(json.object("film"))};
    std::vector<Layer> layers;
    for (const JsonReader& layer : json.objects("film")) layers.push_back(parse_layer(layer));
    constexpr std::size_t kMostLayers = 64;
    if (layers.empty() || layers.size() > kMostLayers)
        json.fail("film", fmt::format("{} layers", layers.size()),
                  fmt::format("a layer, or a list of 1 to {} from the outermost down", kMostLayers));
    return layers;
}

}  // namespace

Base parse_base(JsonReader& json) {
    if (json.has("metal") && json.has("base"))
        json.fail("metal", "a metal and a base", "one of them", "remove \"metal\" or \"base\"");
    if (json.has("metal")) return colour::read_metal(json);
    JsonReader base = json.object("base");
    const double ior = base.number("ior", kBaseIndex);
    const std::complex<double> index(ior, base.number_or("k", 0.0, kExtinction));
    base.finish();
    return index;
}

FilmMaterial parse_film_material(const nlohmann::json& json, const std::string& file, const std::string& pointer) {
    JsonReader reader(json, file, pointer);
    FilmMaterial material{.film = {.layers = parse_layers(reader), .base = parse_base(reader)},
                          .range = {},
                          .illuminant = colour::read_builtin_illuminant(reader)};
    const double roughness = reader.number_or("roughness", 0.0, kUnit);
    const double thickness_nm = material.film.layers.front().thickness_nm;
    material.range = {
        .thinnest_nm = thickness_nm, .thickest_nm = thickness_nm, .smoothest = roughness, .roughest = roughness};
    reader.finish();
    return material;
}

FilmTable bake_film(const FilmMaterial& material) {
    const FilmColour colour(material.film, colour::LightSpectra(material.illuminant));
    return bake_table(colour, material.range, table_size(material.range));
}

}  // namespace rowland::thin_film
