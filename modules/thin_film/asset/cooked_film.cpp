#include "modules/thin_film/asset/cooked_film.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "engine/asset/container.h"
#include "engine/core/byte_stream.h"
#include "engine/core/json_reader.h"

namespace rowland::thin_film {

namespace {

std::size_t node_count(const TableSize& size) {
    return static_cast<std::size_t>(size.columns) * static_cast<std::size_t>(size.rows) *
           static_cast<std::size_t>(size.layers);
}

void write_nodes(const FilmTable& table, ByteWriter& writer) {
    std::vector<std::uint32_t> stored;
    stored.reserve(3 * table.values.size());
    for (const glm::mat3& value : table.values)
        for (int c = 0; c < 3; ++c) stored.push_back(glm::packF3x9_E1x5(value[c]));
    writer.array(std::span<const std::uint32_t>(stored));
}

std::vector<glm::mat3> read_nodes(ByteReader& reader, std::size_t count) {
    const std::vector<std::uint32_t> stored = reader.array<std::uint32_t>();
    if (stored.size() != 3 * count)
        reader.fail(fmt::format("{} columns", stored.size()), fmt::format("three for each of {} nodes", count));
    std::vector<glm::mat3> values(count);
    for (std::size_t i = 0; i < stored.size(); ++i)
        values[i / 3][static_cast<int>(i % 3)] = glm::unpackF3x9_E1x5(stored[i]);
    return values;
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
    writer.value(cooked.table.error.largest);
    writer.value(cooked.table.error.rms);
    write_nodes(cooked.table, writer);
    return writer.take();
}

CookedFilm read_cooked_film(std::span<const std::byte> payload, const std::string& file) {
    ByteReader reader(payload, file);
    const FilmMaterial material = parse_film_material(parse_json(reader.text(), file), file);
    const TableSize size = table_size(material.range);
    CookedFilm cooked{.material = material, .table = empty_table(material.film, material.range, size)};
    cooked.table.error.largest = reader.value<double>();
    cooked.table.error.rms = reader.value<double>();
    if (!std::isfinite(cooked.table.error.largest) || !std::isfinite(cooked.table.error.rms))
        reader.fail("an error that is not finite", "the table's error");
    cooked.table.values = read_nodes(reader, node_count(size));
    if (reader.remaining() != 0) reader.fail(fmt::format("{} bytes too many", reader.remaining()), "the end");
    return cooked;
}

CookedFilm load_cooked_film(const std::filesystem::path& path) {
    return read_cooked_film(asset::load(path, kFilmAssetType, kFilmAssetVersion).payload, path.string());
}

std::string describe(const CookedFilm& cooked) {
    const FilmTable& table = cooked.table;
    return fmt::format(
        "layers: {}\nthickness_nm: {}\nroughness: {}\nilluminant: {}\ntable: {} x {} x {}\n"
        "table_bytes: {}\ntable_error_largest: {:.5f}\ntable_error_rms: {:.5f}\n",
        cooked.material.film.layers.size(), cooked.material.range.thickest_nm, cooked.material.range.roughest,
        cooked.material.illuminant.name, table.columns, table.rows, table.layers, table.bytes(), table.error.largest,
        table.error.rms);
}

}  // namespace rowland::thin_film
