#include "engine/scene/gltf_index.h"

#include <fmt/format.h>

namespace rowland::scene {

namespace {

std::size_t size_of(const nlohmann::json& root, const std::string& array) {
    const auto found = root.find(array);
    return found == root.end() ? 0 : found->size();
}

}  // namespace

std::vector<JsonReader> root_objects(const nlohmann::json& root, const std::string& file, const std::string& array) {
    JsonReader reader(root, file);
    if (!reader.has(array)) return {};
    return reader.objects(array);
}

std::size_t index_into(const nlohmann::json& root, JsonReader& reader, const std::string& key,
                       const std::string& array) {
    const std::size_t size = size_of(root, array);
    if (size == 0)
        reader.fail(key, "an index", fmt::format("no index: the file has no {}", array), "the file is incomplete");
    return static_cast<std::size_t>(reader.integer(key, 0, static_cast<std::int64_t>(size) - 1));
}

std::optional<std::size_t> index_if_there(const nlohmann::json& root, JsonReader& reader, const std::string& key,
                                          const std::string& array) {
    if (!reader.has(key)) return std::nullopt;
    return index_into(root, reader, key, array);
}

std::vector<std::size_t> indices_if_there(const nlohmann::json& root, JsonReader& reader, const std::string& key,
                                          const std::string& array) {
    std::vector<std::size_t> indices;
    if (!reader.has(key)) return indices;
    const nlohmann::json& values = reader.raw(key);
    if (!values.is_array()) reader.fail(key, values.type_name(), fmt::format("an array of indices into {}", array));
    const std::size_t size = size_of(root, array);
    for (const nlohmann::json& value : values) {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= size)
            reader.fail(key, value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).substr(0, 40),
                        fmt::format("an index below {}, the number of {}", size, array));
        indices.push_back(value.get<std::size_t>());
    }
    return indices;
}

std::string text_if_there(JsonReader& reader, const std::string& key) {
    return reader.has(key) ? reader.text(key) : std::string();
}

}  // namespace rowland::scene
