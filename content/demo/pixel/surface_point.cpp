#include "content/demo/pixel/surface_point.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>

#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

std::optional<PlacedGrating> placed_grating(ecs::World& world, ecs::Entity grating) {
    const auto* surface = world.find<diffraction::DiffractionSurface>(grating);
    const auto* instance = world.find<render::MeshInstance>(grating);
    const auto* matrix = world.find<scene::WorldMatrix>(grating);
    if (surface == nullptr || instance == nullptr || matrix == nullptr) return std::nullopt;
    return PlacedGrating{instance->mesh, matrix->matrix, surface->groove_rotation};
}

std::optional<diffraction::ShadingPoint> frame_at(const PlacedGrating& grating, const TriangleHit& hit,
                                                  const glm::vec3& point, const glm::vec3& eye) {
    const scene::Mesh& mesh = *grating.mesh;
    const glm::mat3 linear(grating.to_world);
    const glm::vec3 normal = glm::inverseTranspose(linear) * interpolated(mesh.normals, mesh, hit);
    const glm::vec4 tangent = interpolated(mesh.tangents, mesh, hit);
    const glm::dvec3 n = glm::normalize(glm::dvec3(normal));
    glm::dvec3 t(linear * glm::vec3(tangent));
    t = glm::normalize(t - glm::dot(t, n) * n);
    // A mirroring transform inverts the handedness of the tangent frame, as in the shaders.
    const double side = static_cast<double>(tangent.w) * (glm::determinant(linear) < 0.0F ? -1.0 : 1.0);
    const glm::dvec3 b = glm::cross(n, t) * (side < 0.0 ? -1.0 : 1.0);
    const double turn = static_cast<double>(grating.groove_rotation);
    const diffraction::ShadingPoint frame{.view = glm::normalize(glm::dvec3(eye) - glm::dvec3(point)),
                                          .normal = n,
                                          .grating = std::cos(turn) * t + std::sin(turn) * b};
    if (!diffraction::is_valid(frame) || glm::dot(frame.view, frame.normal) <= 0.0) return std::nullopt;
    return frame;
}

std::string frames_csv(const diffraction::ShadingPoint& frame) {
    const auto three = [](const glm::dvec3& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z); };
    return fmt::format("vx,vy,vz,nx,ny,nz,gx,gy,gz\n{},{},{}\n", three(frame.view), three(frame.normal),
                       three(frame.grating));
}

namespace {

/// The nearest hit of the ray through each texel's centre.
class HitBuffer {
 public:
    HitBuffer(const scene::Camera& camera, glm::ivec2 size)
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
    HitBuffer hits(camera, size);
    for (std::size_t i = 0; i < meshes.size(); ++i) hits.draw(meshes[i], i);
    return hits.take();
}

}  // namespace rowland::demo
