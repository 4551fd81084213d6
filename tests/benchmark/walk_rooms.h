#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/framebuffer.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_instance.h"
#include "engine/render/scene_lights.h"
#include "engine/scene/camera.h"

namespace rowland::benchmark {

/// Where rooms.glb has its doors, along x in metres, and the path through them.
inline constexpr std::array kDoors_m = {6.1F, 12.3F};
inline constexpr float kBegin_m = 0.6F;
inline constexpr float kEnd_m = 17.8F;
inline constexpr float kEyeHeight_m = 1.6F;

struct WalkOptions {
    std::filesystem::path scene;
    glm::ivec2 size{320, 180};
    int frames = 200;  ///< through a door
    int stops = 64;
    int face_size = 64;  ///< of the captured light
};

/// At eye height, so far along the path.
scene::Camera camera_at(float x_m, const glm::vec3& forward);
/// At a stop of `stops`, evenly along the path; the views of four stops turn once about.
scene::Camera camera_at_stop(int stop, int stops);

/// The radiance that is shown as white where the mean of a picture is shown as .18.
double white_of(std::span<const glm::vec4> pixels);
/// 0 to 255.
double display_value(float radiance, double white);

/// The rooms, under a probe for each box or, as if there was no box, under one.
class Rooms {
 public:
    Rooms(const WalkOptions& options, std::optional<std::size_t> one_probe);

    void remove_boxes();
    /// A disc and a sphere of gratings of the scene, carried before the camera.
    void carry_gratings();
    void carry_at(const scene::Camera& camera);
    /// Until the picture is there.
    double draw_ms(const scene::Camera& camera, const gpu::Framebuffer& target);

    render::Renderer& renderer() { return renderer_; }
    ecs::World& world() { return world_; }
    const render::ProbeVolumes& volumes() const { return volumes_; }

 private:
    render::Renderer renderer_;
    ecs::World world_;
    render::SceneInstance instance_;
    render::ProbeVolumes volumes_;
    std::vector<ecs::Entity> carried_;
};

}  // namespace rowland::benchmark
