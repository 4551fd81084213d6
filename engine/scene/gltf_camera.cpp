#include "engine/scene/gltf_camera.h"

#include <fmt/format.h>

#include <numbers>

#include "engine/core/json_reader.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_index.h"

namespace rowland::scene {

namespace {

// Wider or narrower, the projection's numbers leave what floats resolve.
constexpr NumberRange kFieldOfView{.minimum = 1e-4, .maximum = std::numbers::pi - 1e-4};
constexpr double kNearestPlane = 1e-9;
constexpr double kFarthestPlane = 1e12;

GltfCamera read_perspective(JsonReader lens) {
    GltfCamera camera;
    camera.vertical_field_of_view = static_cast<float>(lens.number("yfov", kFieldOfView));
    const double near = lens.number("znear", {.minimum = kNearestPlane, .maximum = kFarthestPlane});
    camera.near_plane = static_cast<float>(near);
    if (!lens.has("zfar")) return camera;
    camera.far_plane =
        static_cast<float>(lens.number("zfar", {.minimum = near, .maximum = kFarthestPlane, .minimum_open = true}));
    // The two may be one float.
    if (!(*camera.far_plane > camera.near_plane))
        lens.fail("zfar", fmt::format("{}", *camera.far_plane), fmt::format("more than znear, {}", camera.near_plane));
    return camera;
}

}  // namespace

std::vector<std::optional<GltfCamera>> read_cameras(const nlohmann::json& json, const std::string& file,
                                                    std::vector<std::string>& warnings) {
    std::vector<std::optional<GltfCamera>> cameras;
    for (JsonReader& reader : root_objects(json, file, "cameras")) {
        std::string name = text_if_there(reader, "name");
        cameras.emplace_back();
        if (reader.choice("type", {"perspective", "orthographic"}) == "orthographic") {
            warn_once(warnings, "orthographic cameras are ignored");
            continue;
        }
        cameras.back() = read_perspective(reader.object("perspective"));
        cameras.back()->name = std::move(name);
    }
    return cameras;
}

void read_node_cameras(const nlohmann::json& json, const std::string& file, std::span<GltfNode> nodes) {
    std::size_t i = 0;
    for (JsonReader& node : root_objects(json, file, "nodes"))
        nodes[i++].camera = index_if_there(json, node, "camera", "cameras");
}

}  // namespace rowland::scene
