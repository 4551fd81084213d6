#include "tests/demo/shimmer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <limits>

#include "content/demo/pixel/visible_points.h"
#include "content/demo/play/hierarchy.h"
#include "engine/gpu/framebuffer.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::test {

namespace {

constexpr double kJump = 0.1;
constexpr int kSide = 4;  ///< samples along a pixel's side
constexpr double kWhite = 1.0;
constexpr double kNoWhite = std::numeric_limits<double>::infinity();

/// The camera half a pixel aside, so turned that a point stays where it is in the picture.
scene::Camera moved(const scene::Camera& camera, int rows, const glm::vec3& point) {
    const float pixel = 2.0F * std::tan(0.5F * camera.vertical_field_of_view) / static_cast<float>(rows);
    const glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
    const float distance = glm::dot(point - camera.eye, ahead);
    const glm::vec3 step = 0.5F * pixel * distance * glm::vec3(glm::row(camera.view(), 0));
    scene::Camera result = camera;
    result.eye += step;
    result.target += step * (1.0F - glm::distance(camera.target, camera.eye) / distance);
    return result;
}

double relative_rms(const std::vector<std::size_t>& at, const std::vector<glm::vec4>& picture,
                    const std::vector<glm::vec4>& reference, double white) {
    double difference = 0.0;
    double whole = 0.0;
    for (const std::size_t i : at) {
        const glm::dvec3 wanted = glm::min(glm::dvec3(reference[i]), white);
        const glm::dvec3 off = glm::min(glm::dvec3(picture[i]), white) - wanted;
        difference += glm::dot(off, off);
        whole += glm::dot(wanted, wanted);
    }
    return std::sqrt(difference / whole);
}

double fraction_jumping(const std::vector<std::size_t>& at, const std::vector<glm::vec4>& picture,
                        const std::vector<glm::vec4>& next) {
    const auto jumps = [&](std::size_t i) {
        const glm::vec3 a(picture[i]);
        const glm::vec3 b(next[i]);
        return glm::length(a - b) > kJump * std::max(glm::length(a), glm::length(b));
    };
    return static_cast<double>(std::ranges::count_if(at, jumps)) / static_cast<double>(at.size());
}

}  // namespace

Shimmer::Shimmer(const demo::Options& options, glm::ivec2 size)
    : size_(size), session_(options, post::OcioConfig::choose(std::nullopt), size, size, demo::Pace::Still) {}

Shimmer::Pixels Shimmer::draw(const scene::Camera& camera) {
    // A map is full in the second frame at rest.
    for (int frame = 0; frame < 2 || diffraction::maps_are_filling(session_.play().world()); ++frame)
        session_.draw_from(camera, 0.0F);
    return session_.picture().linear().read_rgba_float();
}

Shimmer::Pixels Shimmer::draw_supersampled(const scene::Camera& camera) {
    const glm::ivec2 fine = kSide * size_;
    const gpu::Framebuffer target({.width = fine.x, .height = fine.y, .depth = true});
    session_.picture().renderer().render(session_.play().world(), camera, target);
    const Pixels samples = target.read_rgba_float();
    Pixels mean(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y), glm::vec4(0.0F));
    for (int row = 0; row < fine.y; ++row)
        for (int column = 0; column < fine.x; ++column)
            mean[static_cast<std::size_t>(row / kSide) * static_cast<std::size_t>(size_.x) +
                 static_cast<std::size_t>(column / kSide)] +=
                samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(fine.x) +
                        static_cast<std::size_t>(column)] /
                static_cast<float>(kSide * kSide);
    return mean;
}

std::map<std::string, Shimmer::Seen> Shimmer::see(const scene::Camera& camera) {
    ecs::World& world = session_.play().world();
    std::vector<demo::PlacedMesh> meshes;
    std::vector<std::string> gratings;  // of each mesh; empty if it has none
    world.view<render::MeshInstance, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const render::MeshInstance& instance, const scene::WorldMatrix& matrix) {
            meshes.push_back({instance.mesh, matrix.matrix});
            const bool grating = world.find<diffraction::DiffractionSurface>(entity) != nullptr;
            gratings.push_back(grating ? demo::name_of_object(world, entity) : "");
        });
    const auto points = demo::visible_points(camera, size_, meshes);
    const auto at = [&](int row, int column) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(column);
    };
    std::map<std::string, Seen> result;
    for (int row = 1; row + 1 < size_.y; ++row)
        for (int column = 1; column + 1 < size_.x; ++column) {
            const auto& here = points[at(row, column)];
            if (!here || gratings[here->mesh].empty()) continue;
            bool inner = true;
            for (int i = 0; i < 9; ++i) {
                const auto& beside = points[at(row + i / 3 - 1, column + i % 3 - 1)];
                inner = inner && beside && beside->mesh == here->mesh;
            }
            if (!inner) continue;
            Seen& seen = result[gratings[here->mesh]];
            seen.pixels.push_back(at(row, column));
            seen.sum += here->point;
        }
    return result;
}

std::map<std::string, PixelAverage> Shimmer::measure(const scene::Camera& camera, bool with_error) {
    const Pixels picture = draw(camera);
    const Pixels reference = with_error ? draw_supersampled(camera) : picture;
    std::map<std::string, PixelAverage> result;
    for (const auto& [object, seen] : see(camera)) {
        const glm::vec3 middle = seen.sum / static_cast<float>(seen.pixels.size());
        const scene::Camera aside = moved(camera, size_.y, middle);
        const Pixels next = draw(aside);
        const double jumping = fraction_jumping(seen.pixels, picture, next);
        double content_jumping = 0.0;
        if (with_error && jumping > kCalm)
            content_jumping = fraction_jumping(seen.pixels, reference, draw_supersampled(aside));
        result[object] = {.pixels = seen.pixels.size(),
                          .jumping = jumping,
                          .change = relative_rms(seen.pixels, next, picture, kWhite),
                          .content_jumping = content_jumping,
                          .error = relative_rms(seen.pixels, picture, reference, kNoWhite),
                          .displayed = relative_rms(seen.pixels, picture, reference, kWhite)};
    }
    return result;
}

}  // namespace rowland::test
