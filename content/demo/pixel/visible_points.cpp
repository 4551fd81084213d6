#include "content/demo/pixel/visible_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>

namespace rowland::demo {

namespace {

class Picture {
 public:
    Picture(const scene::Camera& camera, glm::ivec2 size)
        : camera_(camera),
          size_(size),
          to_clip_(camera.projection(static_cast<float>(size.x) / static_cast<float>(size.y)) * camera.view()),
          points_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)) {
        rays_.reserve(points_.size());
        for (int row = 0; row < size.y; ++row)
            for (int column = 0; column < size.x; ++column)
                rays_.push_back(ray_through(camera, {column + 0.5, row + 0.5}, size));
    }

    void draw(const PlacedMesh& placed, std::size_t index) {
        if (glm::determinant(placed.to_world) == 0.0F) return;
        const scene::Mesh& mesh = *placed.mesh;
        const glm::mat4 to_clip = to_clip_ * placed.to_world;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::array<glm::vec3, 3> corners;
            for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.indices[i + k]];
            if (const auto box = texels_of(corners, to_clip)) {
                for (glm::vec3& corner : corners) corner = glm::vec3(placed.to_world * glm::vec4(corner, 1.0F));
                draw_triangle(corners, *box, index, i / 3);
            }
        }
    }

    std::vector<std::optional<VisiblePoint>> take() { return std::move(points_); }

 private:
    struct Box {
        glm::ivec2 begin;
        glm::ivec2 end;
    };

    /// The texels whose centres a triangle may cover; nullopt if it is outside or reaches behind the near plane.
    std::optional<Box> texels_of(const std::array<glm::vec3, 3>& corners, const glm::mat4& to_clip) const {
        glm::vec2 low(1e9F);
        glm::vec2 high(-1e9F);
        for (const glm::vec3& corner : corners) {
            const glm::vec4 clip = to_clip * glm::vec4(corner, 1.0F);
            if (clip.w < camera_.near_plane) return std::nullopt;
            const glm::vec2 texel =
                glm::vec2(0.5F + 0.5F * clip.x / clip.w, 0.5F - 0.5F * clip.y / clip.w) * glm::vec2(size_);
            low = glm::min(low, texel);
            high = glm::max(high, texel);
        }
        // With a margin of a hundredth texel for rounding, clamped to the picture.
        const auto first = [](float edge, int size) {
            return static_cast<int>(std::clamp(std::ceil(edge - 0.51F), 0.0F, static_cast<float>(size)));
        };
        const auto last = [](float edge, int size) {
            return static_cast<int>(std::clamp(std::floor(edge + 0.51F), 0.0F, static_cast<float>(size)));
        };
        const Box box{{first(low.x, size_.x), first(low.y, size_.y)}, {last(high.x, size_.x), last(high.y, size_.y)}};
        if (box.begin.x >= box.end.x || box.begin.y >= box.end.y) return std::nullopt;
        return box;
    }

    void draw_triangle(const std::array<glm::vec3, 3>& corners, const Box& box, std::size_t mesh,
                       std::size_t triangle) {
        for (int row = box.begin.y; row < box.end.y; ++row)
            for (int column = box.begin.x; column < box.end.x; ++column) {
                const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.x) +
                                       static_cast<std::size_t>(column);
                std::optional<VisiblePoint>& seen = points_[at];
                auto hit = meet(rays_[at], corners[0], corners[1], corners[2]);
                if (!hit || (seen && hit->distance >= seen->hit.distance)) continue;
                hit->triangle = triangle;
                seen = VisiblePoint{mesh, *hit, rays_[at].origin + hit->distance * rays_[at].direction};
            }
    }

    const scene::Camera& camera_;
    glm::ivec2 size_;
    glm::mat4 to_clip_;
    std::vector<Ray> rays_;
    std::vector<std::optional<VisiblePoint>> points_;
};

}  // namespace

std::vector<std::optional<VisiblePoint>> visible_points(const scene::Camera& camera, glm::ivec2 size,
                                                        const std::vector<PlacedMesh>& meshes) {
    Picture picture(camera, size);
    for (std::size_t i = 0; i < meshes.size(); ++i) picture.draw(meshes[i], i);
    return picture.take();
}

}  // namespace rowland::demo
