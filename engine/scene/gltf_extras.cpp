#include "engine/scene/gltf_extras.h"

#include "engine/core/json_reader.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_index.h"

namespace rowland::scene {

void read_node_extras(const nlohmann::json& json, const std::string& file, std::span<GltfNode> nodes,
                      std::vector<std::string>& warnings) {
    std::size_t i = 0;
    for (JsonReader& node : root_objects(json, file, "nodes")) {
        GltfNode& to = nodes[i++];
        if (!node.has("extras")) continue;
        const nlohmann::json& extras = node.raw("extras");
        const std::size_t bytes = extras.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).size();
        if (bytes > kMostExtrasBytes) {
            warn_once(warnings, "extras of more than 64 KiB are ignored");
            continue;
        }
        to.extras = extras;
        to.extras_bytes = bytes;
    }
}

bool says_true(const nlohmann::json& extras, const std::string& key) {
    if (!extras.is_object()) return false;
    const auto found = extras.find(key);
    return found != extras.end() && found->is_boolean() && found->get<bool>();
}

}  // namespace rowland::scene
