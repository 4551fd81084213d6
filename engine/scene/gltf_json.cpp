#include "engine/scene/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>

namespace rowland::scene {

void warn_once(std::vector<std::string>& warnings, std::string text) {
    if (std::find(warnings.begin(), warnings.end(), text) == warnings.end()) warnings.push_back(std::move(text));
}

std::size_t read_index(JsonReader& owner, const std::string& key, std::size_t count, const std::string& things) {
    if (count == 0)
        owner.fail(key, "an index", fmt::format("no index: the file has no {}", things), "the file is incomplete");
    return static_cast<std::size_t>(owner.integer(key, 0, static_cast<std::int64_t>(count) - 1));
}

std::optional<JsonReader> extension_of(JsonReader& owner, const std::string& name) {
    std::optional<JsonReader> extensions = owner.object_if_there("extensions");
    return extensions ? extensions->object_if_there(name) : std::nullopt;
}

std::size_t GltfJson::size_of(const std::string& array) const {
    const auto found = root.find(array);
    return found == root.end() ? 0 : found->size();
}

std::vector<JsonReader> GltfJson::objects(const std::string& array) const {
    return JsonReader(root, file).objects_if_there(array);
}

std::size_t GltfJson::index(JsonReader& owner, const std::string& key, const std::string& array) const {
    return read_index(owner, key, size_of(array), array);
}

std::optional<std::size_t> GltfJson::index_if_there(JsonReader& owner, const std::string& key,
                                                    const std::string& array) const {
    return owner.has(key) ? std::optional(index(owner, key, array)) : std::nullopt;
}

std::vector<std::size_t> GltfJson::indices_if_there(JsonReader& owner, const std::string& key,
                                                    const std::string& array) const {
    std::vector<std::size_t> indices;
    if (!owner.has(key)) return indices;
    const nlohmann::json& values = owner.raw(key);
    if (!values.is_array()) owner.fail(key, values.type_name(), fmt::format("an array of indices into {}", array));
    const std::size_t size = size_of(array);
    for (const nlohmann::json& value : values) {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= size)
            owner.fail(key, value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).substr(0, 40),
                       fmt::format("an index below {}, the number of {}", size, array));
        indices.push_back(value.get<std::size_t>());
    }
    return indices;
}

}  // namespace rowland::scene
