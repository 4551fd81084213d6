#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/options.h"
#include "content/demo/play/play.h"
#include "engine/ecs/world.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_instance.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::demo {

/// The camera's vertical field of view, radians.
inline constexpr float kFieldOfView = 0.36F;

/// A CD (or the user's mesh as a grating, or the user's scene, scaled to stand in the CD's place), a diffuse and a
/// metallic sphere, and a ground. A scene that brings a camera is shown alone, at its own size, with its own lights.
class DemoScene {
 public:
    /// `xyz_to_working` as the renderer's. Throws Error (input).
    DemoScene(const Options& options, LiveAssets& assets, render::Renderer& renderer, const glm::dmat3& xyz_to_working);

    /// Takes over what was loaded anew; true if that was a mesh, so that toys() are others now. What cannot be used
    /// stays as it was, and `failures()` says why.
    bool refresh();
    const std::vector<std::string>& failures() const { return failures_; }

    /// What can be played with, at rest. The play places it from then on.
    Toys toys();
    /// Moves what moves by itself to where it is at the play's time.
    void pose(const Play& play);
    /// Where one may walk.
    scene::Bounds room();
    /// Lights or puts out the lamp that casts shadows.
    void set_sun(bool on);
    bool sun() const { return world_.alive(sun_); }

    ecs::World& world() { return world_; }
    const scene::Camera& camera() const { return camera_; }
    /// All views that the scene brings, the opening one first; or that one alone.
    std::vector<scene::Camera> views() const;

 private:
    /// An asset and the version of it that the world shows.
    template <typename T>
    struct Shown {
        asset::Handle<T> handle;
        std::uint64_t version = 0;
    };

    ecs::Entity add_mesh_entity(const glm::vec3& place, const render::StandardMaterial& surface);
    void add_spheres();
    void show_scene();
    void fit_scene(const scene::Mesh& merged);
    void add_under_root(ecs::Entity entity);
    void add_surroundings(const Options& options, LiveAssets& assets);
    void show_grating_mesh();
    void show_grating_material();
    void show_spheres();
    void show_ground();
    void pose_stand();
    /// Runs `show` if there is a newer asset.
    template <typename T, typename F>
    void refresh(Shown<T>& shown, F&& show);

    render::Renderer& renderer_;
    glm::dmat3 xyz_to_working_;
    Shown<scene::ImportedScene> scene_;
    Shown<scene::ImportedScene> grating_mesh_;
    Shown<diffraction::CookedMaterial> material_;
    Shown<scene::ImportedScene> sphere_mesh_;
    Shown<scene::ImportedScene> ground_mesh_;
    std::string scene_file_;
    std::vector<std::string> failures_;

    ecs::World world_;
    ecs::Entity root_;     ///< above everything
    ecs::Entity stand_;    ///< tilts, or turns
    ecs::Entity grating_;  ///< on the stand
    std::vector<ecs::Entity> spheres_;
    ecs::Entity ground_;
    ecs::Entity sun_;
    std::optional<render::SceneInstance> instance_;
    bool disc_ = true;
    bool own_view_ = false;  ///< the scene brings a camera
    bool meshes_changed_ = false;
    double posed_s_ = 0.0;  ///< the play's time at the last pose
    double stand_s_ = 0.0;  ///< for which the stand has moved
    scene::Camera camera_;
};

/// Moves and scales a mesh so that it stands on the origin and fits into a box of the given size.
void fit_to_box(scene::Mesh& mesh, float size_m);

}  // namespace rowland::demo
