#include <fmt/format.h>

#include <numbers>

#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

// Outside this range floats cannot resolve the projection.
constexpr NumberRange kFieldOfView{.minimum = 1e-4, .maximum = std::numbers::pi - 1e-4};
constexpr double kNearestPlane = 1e-9;
constexpr double kFarthestPlane = 1e12;

ImportedCamera read_perspective(JsonReader lens) {
    ImportedCamera camera;
    camera.vertical_field_of_view = static_cast<float>(lens.number("yfov", kFieldOfView));
    const double near = lens.number("znear", {.minimum = kNearestPlane, .maximum = kFarthestPlane});
    camera.near_plane = static_cast<float>(near);
    if (!lens.has("zfar")) return camera;
    camera.far_plane =
        static_cast<float>(lens.number("zfar", {.minimum = near, .maximum = kFarthestPlane, .minimum_open = true}));
    // The two may round to one float.
    if (!(*camera.far_plane > camera.near_plane))
        lens.fail("zfar", fmt::format("{}", *camera.far_plane), fmt::format("more than znear, {}", camera.near_plane));
    return camera;
}

}  // namespace

std::vector<std::optional<ImportedCamera>> read_cameras(const GltfJson& json) {
    std::vector<std::optional<ImportedCamera>> cameras;
    for (JsonReader& camera : json.objects("cameras")) {
        std::optional<ImportedCamera>& to = cameras.emplace_back();
        std::string name = camera.text_or("name", "");
        if (camera.choice("type", {"perspective", "orthographic"}) == "orthographic") {
            json.warn("orthographic cameras are ignored");
            continue;
        }
        to = read_perspective(camera.object("perspective"));
        to->name = std::move(name);
    }
    return cameras;
}

}  // namespace rowland::scene
