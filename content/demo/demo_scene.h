#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/options.h"
#include "content/demo/play/play.h"
#include "engine/ecs/world.h"
#include "engine/post/glare.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_instance.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::demo {

/// The camera's vertical field of view, radians.
inline constexpr float kFieldOfView = 0.36F;

/// A CD (or the user's mesh as a grating, or the user's scene, scaled to the CD's size), a diffuse and a metallic
/// sphere, and a ground. A scene with a camera is shown alone, unscaled, with its own lights.
class DemoScene {
 public:
    /// `xyz_to_working` as the renderer's. Throws Error (input).
    DemoScene(const Options& options, LiveAssets& assets, render::Renderer& renderer, const glm::dmat3& xyz_to_working);

    /// Shows reloaded assets. True if one was a mesh or a scene, so that toys() have changed. An asset that cannot be
    /// used changes nothing, and failures() says why.
    bool refresh();
    const std::vector<std::string>& failures() const { return failures_; }

    /// The objects that can be played with, in their rest pose. From then on the play moves them.
    Toys toys();
    /// Moves the stand and the nodes of the scene's first animation to their pose at the play's time.
    void pose(const Play& play);
    /// Where the player may walk.
    scene::Bounds room();
    /// Shows or hides the nodes that the scene's extras call a floor: `"floor": true`.
    void show_floor(bool shown);
    /// Turns the lamp that casts shadows on or off.
    void set_sun(bool on);
    bool sun() const { return world_.alive(sun_); }

    /// The sheet that the scene's first camera looks through: "glare" of its node's extras, null if there is none.
    const nlohmann::json* sheet() const;

    ecs::World& world() { return world_; }
    const scene::Camera& camera() const { return camera_; }
    /// All views of the scene, camera() first; camera() alone if it has no camera or the options set the view.
    std::vector<scene::Camera> views() const;

 private:
    /// An asset in the world.
    struct Part {
        std::function<std::uint64_t()> version;
        std::function<void()> show;
        std::uint64_t shown;  ///< the version that the world has
    };

    template <typename T, typename Show>
    void add_part(const asset::Handle<T>& handle, Show show);
    ecs::Entity add_under(ecs::Entity parent, const glm::vec3& position = glm::vec3(0.0F));
    void add_surroundings(const Options& options, LiveAssets& assets);
    void show_scene(const scene::ImportedScene& imported, const std::string& file);
    void show_grating_mesh(scene::Mesh mesh);
    void show_grating_material(const diffraction::CookedMaterial& cooked);
    void pose_stand();
    void frame_object(const std::string& name);

    render::Renderer& renderer_;
    glm::dmat3 xyz_to_working_;
    asset::Handle<scene::ImportedScene> scene_;
    std::vector<Part> parts_;
    std::vector<std::string> failures_;

    ecs::World world_;
    ecs::Entity root_;     ///< above everything
    ecs::Entity stand_;    ///< tilts, or turns
    ecs::Entity grating_;  ///< on the stand
    ecs::Entity sun_;
    std::optional<render::SceneInstance> instance_;
    std::vector<std::pair<ecs::Entity, render::MeshInstance>> hidden_floor_;
    bool disc_ = true;
    bool own_view_ = false;     ///< the scene has a camera
    bool chosen_view_ = false;  ///< the options set the first view
    bool meshes_changed_ = false;
    double posed_s_ = 0.0;  ///< the play's time at the last pose
    double stand_s_ = 0.0;  ///< time for which the stand has moved
    scene::Camera camera_;
};

/// A sheet of glasses or a screen that one may look through.
struct Sheet {
    std::string name;
    std::filesystem::path file;  ///< a material; empty: the scene's own
};

/// The sheet of the command line; without one, the scene's own, then the shipped ones.
std::vector<Sheet> sheets(const Options& options, const DemoScene& scene);

/// Reads a sheet. Throws Error (input).
post::GlareSettings glare_of(const Sheet& sheet, const DemoScene& scene, const glm::dmat3& xyz_to_working);

}  // namespace rowland::demo
