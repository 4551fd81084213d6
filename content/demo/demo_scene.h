#pragma once

#include <memory>

#include "engine/ecs/world.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/runtime/gpu_spike_material.h"

namespace rowland::demo {

/// The camera's vertical field of view, radians.
inline constexpr float kFieldOfView = 0.36F;

/// What stands in the scene.
struct SceneSources {
    scene::Mesh grating;  ///< the iridescent object: the CD, or the user's own mesh
    bool grating_is_disc = true;
    scene::Mesh sphere;
    scene::Mesh ground;
    std::shared_ptr<const diffraction::GpuSpikeMaterial> material;
};

/// A CD (or the user's mesh), a diffuse and a metallic sphere, and a ground.
class DemoScene {
 public:
    explicit DemoScene(SceneSources sources);

    /// Turns the grating to where it is at `seconds` and brings all matrices up to date.
    void advance_to(double seconds);

    ecs::World& world() { return world_; }
    const scene::Camera& camera() const { return camera_; }

 private:
    void add_spheres(scene::Mesh sphere);
    void add_ground(scene::Mesh ground);
    void add_grating(SceneSources& sources);

    ecs::World world_;
    ecs::Entity stand_;    ///< tilts
    ecs::Entity grating_;  ///< spins on the stand
    bool disc_ = true;
    scene::Camera camera_;
};

/// Moves and scales a mesh so that it stands on the origin and fits into a box of the given size.
void fit_to_box(scene::Mesh& mesh, float size_m);

}  // namespace rowland::demo
