#include "engine/scene/box.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "engine/scene/surface_grid.h"

namespace rowland::scene {

namespace {

/// A point of the outline seen from above: x to the right, z towards us.
struct OutlinePoint {
    glm::dvec2 at;
    glm::dvec2 normal;
    bool joined = true;  ///< with the next one; false within a sharp corner, whose points differ only in their normals
};

/// Counter-clockwise seen from above, from the +X side of the corner at (+X, −Z); `inset` metres inside the widest.
std::vector<OutlinePoint> outline(const BoxRecipe& recipe, double inset) {
    const double outer_radius = std::max(recipe.corner_radius, inset);
    const double radius = recipe.corner_radius > 0.0 ? recipe.corner_radius - inset : 0.0;
    const glm::dvec2 centre(recipe.width / 2.0 - outer_radius, recipe.depth / 2.0 - outer_radius);
    const int steps = recipe.corner_radius > 0.0 ? recipe.corner_steps : 1;
    std::vector<OutlinePoint> points;
    for (int corner = 0; corner < 4; ++corner) {
        const bool right = corner == 0 || corner == 3;
        const bool far = corner < 2;
        const glm::dvec2 from(right ? centre.x : -centre.x, far ? -centre.y : centre.y);
        for (int step = 0; step <= steps; ++step) {
            const Angle a = angle(corner * steps + step, 4 * steps);
            const glm::dvec2 normal(a.cosine, -a.sine);
            points.push_back({from + radius * normal, normal});
        }
    }
    const double rounding = 1e-12 * (recipe.width + recipe.depth);
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i].joined = glm::distance(points[i].at, points[(i + 1) % points.size()].at) > rounding;
    return points;
}

class BoxMaking {
 public:
    explicit BoxMaking(const BoxRecipe& recipe)
        : recipe_(recipe), widest_(outline(recipe, 0.0)), inset_(outline(recipe, recipe.bevel)) {}

    Mesh make() {
        if (recipe_.sides) add_sides();
        if (recipe_.top) add_face(true);
        if (recipe_.bottom) add_face(false);
        return std::move(mesh_);
    }

 private:
    void add_sides() {
        const double b = recipe_.bevel;
        const double h = recipe_.height;
        if (b > 0.0) add_band(inset_, 0.0, widest_, b, -1.0);
        add_band(widest_, b, widest_, h - b, 0.0);
        if (b > 0.0) add_band(widest_, h - b, inset_, h, 1.0);
    }

    /// `rise`: of the normal, against its horizontal part of 1.
    void add_band(const std::vector<OutlinePoint>& lower, double low, const std::vector<OutlinePoint>& upper,
                  double high, double rise) {
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto count = static_cast<std::uint32_t>(lower.size());
        // The first point is repeated at the end with u = 1.
        for (const auto& [points, y] : {std::pair(&lower, low), std::pair(&upper, high)}) {
            double walked = 0.0;
            for (std::uint32_t i = 0; i <= count; ++i) {
                const OutlinePoint& point = (*points)[i % count];
                if (i > 0) walked += glm::distance(widest_[i % count].at, widest_[i - 1].at);
                const glm::dvec3 normal = glm::normalize(glm::dvec3(point.normal.x, rise, point.normal.y));
                add_vertex(mesh_, {point.at.x, y, point.at.y}, normal, {point.normal.y, 0.0, -point.normal.x},
                           {walked / perimeter(), y / recipe_.height});
            }
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!lower[i].joined) continue;
            const std::uint32_t a = first + i;
            const std::uint32_t b = a + count + 1;
            mesh_.indices.insert(mesh_.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }

    double perimeter() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < widest_.size(); ++i)
            sum += glm::distance(widest_[i].at, widest_[(i + 1) % widest_.size()].at);
        return sum;
    }

    void add_face(bool top) {
        const double up = top ? 1.0 : -1.0;
        const auto add = [&](const glm::dvec2& at) {
            add_vertex(mesh_, {at.x, top ? recipe_.height : 0.0, at.y}, {0.0, up, 0.0}, {1.0, 0.0, 0.0},
                       {0.5 + at.x / recipe_.width, 0.5 - up * at.y / recipe_.depth});
        };
        const auto centre = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto count = static_cast<std::uint32_t>(inset_.size());
        add({0.0, 0.0});
        for (const OutlinePoint& point : inset_) add(point.at);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!inset_[i].joined) continue;
            const std::uint32_t a = centre + 1 + i;
            const std::uint32_t b = centre + 1 + (i + 1) % count;
            mesh_.indices.insert(mesh_.indices.end(), {centre, top ? a : b, top ? b : a});
        }
    }

    const BoxRecipe& recipe_;
    std::vector<OutlinePoint> widest_;
    std::vector<OutlinePoint> inset_;
    Mesh mesh_;
};

}  // namespace

Mesh build_box(const BoxRecipe& recipe) {
    return BoxMaking(recipe).make();
}

}  // namespace rowland::scene
