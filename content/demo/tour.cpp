#include "content/demo/tour.h"

#include <algorithm>
#include <cstddef>

#include "content/demo/camera_path.h"
#include "engine/core/check.h"

namespace rowland::demo {

namespace {

/// Between b and c, with the neighbours a and d [Catmull & Rom 1974].
template <typename T>
T between(const T& a, const T& b, const T& c, const T& d, float t) {
    return 0.5F * (2.0F * b + t * (c - a) + t * t * (2.0F * a - 5.0F * b + 4.0F * c - d) +
                   t * t * t * (3.0F * (b - c) + d - a));
}

}  // namespace

scene::Camera tour(const std::vector<scene::Camera>& views, double share) {
    ROWLAND_CHECK(!views.empty(), "a tour needs a view");
    if (views.size() == 1) return flight(views.front(), share);
    const auto last = static_cast<std::ptrdiff_t>(views.size()) - 1;
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(last);
    const std::ptrdiff_t leg = std::min(static_cast<std::ptrdiff_t>(at), last - 1);
    const auto t = static_cast<float>(at - static_cast<double>(leg));
    const auto view = [&](std::ptrdiff_t i) -> const scene::Camera& {
        return views[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
    };
    const scene::Camera& from = view(leg);
    const scene::Camera& to = view(leg + 1);
    const scene::Camera& before = view(leg - 1);
    const scene::Camera& after = view(leg + 2);
    scene::Camera camera = from;
    camera.eye = between(before.eye, from.eye, to.eye, after.eye, t);
    camera.target = between(before.target, from.target, to.target, after.target, t);
    camera.vertical_field_of_view += t * (to.vertical_field_of_view - from.vertical_field_of_view);
    camera.near_plane = std::min(from.near_plane, to.near_plane);
    camera.far_plane = std::max(from.far_plane, to.far_plane);
    return camera;
}

}  // namespace rowland::demo
