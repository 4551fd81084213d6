#include "modules/thin_film/asset/film_material.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "engine/asset/container.h"
#include "engine/colour/illuminant.h"
#include "engine/core/byte_stream.h"
#include "engine/core/json_reader.h"

namespace rowland::thin_film {

namespace {

constexpr NumberRange kBaseIndexRange{.minimum = 0.01, .maximum = 100.0};
constexpr NumberRange kExtinctionRange{.minimum = 0.0, .maximum = 100.0};

Layer parse_layer(JsonReader& json) {
    const double ior = json.number("ior", kFilmIndexRange);
    const Layer layer{.index = {ior, json.number_or("k", 0.0, kExtinctionRange)},
                      .thickness_nm = json.number("thickness_nm", kThicknessRange_nm)};
    json.finish();
    return layer;
}

/// The outermost layer first.
std::vector<Layer> parse_layers(JsonReader& json) {
    constexpr std::size_t kMostLayers = 64;
    std::vector<Layer> layers;
    for (JsonReader& layer : json.object_or_objects("film", kMostLayers)) layers.push_back(parse_layer(layer));
    return layers;
}

}  // namespace

Base parse_base(JsonReader& json) {
    Base result;
    const auto read_metal = [&](JsonReader& reader) {
        reader.refuse_if_there("base", "a metal and a base", "one of them", "remove \"metal\" or \"base\"");
        result = colour::read_metal(reader);
    };
    const auto read_index = [&](JsonReader& reader) {
        JsonReader base = reader.object("base");
        const double ior = base.number("ior", kBaseIndexRange);
        result = std::complex<double>(ior, base.number_or("k", 0.0, kExtinctionRange));
        base.finish();
    };
    json.alternatives("metal", read_metal, read_index);
    return result;
}

FilmMaterial parse_film_material(const nlohmann::json& json, const std::string& file, const std::string& pointer) {
    JsonReader reader(json, file, pointer);
    return parse_film_material(reader);
}

FilmMaterial parse_film_material(JsonReader& reader) {
    FilmMaterial material{.film = {.layers = parse_layers(reader), .base = parse_base(reader)},
                          .range = {},
                          .illuminant = colour::read_builtin_illuminant(reader)};
    const double roughness = reader.number_or("roughness", 0.0, kFraction);
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

namespace {

std::size_t node_count(const FilmTable& table) {
    return static_cast<std::size_t>(table.columns) * static_cast<std::size_t>(table.rows) *
           static_cast<std::size_t>(table.layers);
}

/// A table's error and nodes.
void write_nodes(const FilmTable& table, ByteWriter& writer) {
    writer.value(table.error.largest);
    writer.value(table.error.rms);
    std::vector<std::uint32_t> stored;
    stored.reserve(3 * table.values.size());
    for (const glm::mat3& value : table.values)
        for (int c = 0; c < 3; ++c) stored.push_back(glm::packF3x9_E1x5(value[c]));
    writer.array(std::span<const std::uint32_t>(stored));
}

/// Reads what write_nodes() writes into a table that has its size. No bytes may follow.
void read_nodes(ByteReader& reader, FilmTable& table) {
    table.error.largest = reader.value<double>();
    table.error.rms = reader.value<double>();
    if (!std::isfinite(table.error.largest) || !std::isfinite(table.error.rms))
        reader.fail("an error that is not finite", "the table's error");
    const std::size_t count = node_count(table);
    const std::vector<std::uint32_t> stored = reader.array<std::uint32_t>();
    if (stored.size() != 3 * count)
        reader.fail(fmt::format("{} columns", stored.size()), fmt::format("three for each of {} nodes", count));
    table.values.resize(count);
    for (std::size_t i = 0; i < stored.size(); ++i)
        table.values[i / 3][static_cast<int>(i % 3)] = glm::unpackF3x9_E1x5(stored[i]);
    if (reader.remaining() != 0) reader.fail(fmt::format("{} bytes too many", reader.remaining()), "the end");
}

}  // namespace

CookedFilm cook_film(const nlohmann::json& json, const std::string& file) {
    CookedFilm cooked{.material = parse_film_material(json, file), .table = {}};
    cooked.table = bake_film(cooked.material);
    return cooked;
}

std::vector<std::byte> write_cooked_film(const nlohmann::json& json, const CookedFilm& cooked) {
    ByteWriter writer;
    writer.text(json.dump());
    write_nodes(cooked.table, writer);
    return writer.take();
}

CookedFilm read_cooked_film(std::span<const std::byte> payload, const std::string& file) {
    ByteReader reader(payload, file);
    const FilmMaterial material = parse_film_material(parse_json(reader.text(), file), file);
    CookedFilm cooked{.material = material,
                      .table = empty_table(material.film, material.range, table_size(material.range))};
    read_nodes(reader, cooked.table);
    return cooked;
}

std::vector<std::byte> write_gltf_film(const FilmMaterial& material, const FilmTable& table) {
    ByteWriter writer;
    writer.value(table.index);
    const TableRange& range = material.range;
    for (const double value : {range.thinnest_nm, range.thickest_nm, range.smoothest, range.roughest})
        writer.value(value);
    write_nodes(table, writer);
    return writer.take();
}

FilmTable read_gltf_film(std::span<const std::byte> tables, const std::string& file) {
    ByteReader reader(tables, file);
    const double index = reader.value<double>();
    TableRange range;
    for (double* value : {&range.thinnest_nm, &range.thickest_nm, &range.smoothest, &range.roughest})
        *value = reader.value<double>();
    const auto within = [](double low, double value, double high) { return low <= value && value <= high; };
    if (!within(kFilmIndexRange.minimum, index, kFilmIndexRange.maximum) ||
        !within(0.0, range.thinnest_nm, range.thickest_nm) ||
        !within(0.0, range.thickest_nm, kThicknessRange_nm.maximum) || !within(0.0, range.smoothest, range.roughest) ||
        !within(0.0, range.roughest, 1.0))
        reader.fail("a film outside its limits", "those of KHR_materials_iridescence");
    FilmTable table = empty_table({.layers = {{.index = index, .thickness_nm = range.thickest_nm}}, .base = {}}, range,
                                  table_size(range));
    read_nodes(reader, table);
    return table;
}

CookedFilm load_cooked_film(const std::filesystem::path& path) {
    return read_cooked_film(asset::load(path, kFilmAssetType, kFilmAssetVersion).payload, path.string());
}

std::string describe(const FilmTable& table) {
    return fmt::format("table: {} x {} x {}\ntable_bytes: {}\ntable_error_largest: {:.5f}\ntable_error_rms: {:.5f}\n",
                       table.columns, table.rows, table.layers, table.bytes(), table.error.largest, table.error.rms);
}

std::string describe(const CookedFilm& cooked) {
    return fmt::format("layers: {}\nthickness_nm: {}\nroughness: {}\nilluminant: {}\n",
                       cooked.material.film.layers.size(), cooked.material.range.thickest_nm,
                       cooked.material.range.roughest, cooked.material.illuminant.name) +
           describe(cooked.table);
}

}  // namespace rowland::thin_film
