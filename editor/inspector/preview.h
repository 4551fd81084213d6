#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/inspector/cooked_surfaces.h"
#include "editor/inspector/light.h"
#include "editor/inspector/pick_point.h"
#include "editor/inspector/preview_object.h"
#include "engine/ecs/world.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/post/ocio_config.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/camera.h"
#include "engine/view/picture.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::inspector {

/// An overlay of groove directions on the picture of the same camera: strokes along the visible grooves. Needs a
/// current context.
class GrooveOverlay {
 public:
    GrooveOverlay();

    /// Clears the picture.
    void begin(glm::ivec2 size, const glm::mat4& world_to_clip);
    /// Adds a mesh with the grooves of `grating`; null, or a film: the mesh only hides others.
    void draw(const render::GpuMesh& mesh, const glm::mat4& object_to_world, const CookedSurface* grating);

    const gpu::Framebuffer& picture() const { return *target_; }

 private:
    gpu::Program program_;
    std::optional<gpu::Framebuffer> target_;
};

/// A point of the object in the last frame.
struct PickedSurface {
    PickedPoint point;                    ///< in the axes of the preview's world, which rotates with the object
    diffraction::ShadingPoint frame;      ///< in the probe's axes, with the grating vector of the material's grooves
    std::optional<std::size_t> material;  ///< nullopt: a mesh without one
    diffraction::GrooveLayout layout = diffraction::GrooveLayout::FlatUniform;  ///< of the mesh
    double map_rotation = 0.0;        ///< rotation by the groove texture at this point, radians
    float stage_rotation_deg = 0.0F;  ///< when it was picked
    std::string mesh;                 ///< of a scene
};

/// All inputs of the picture.
struct PreviewInputs {
    glm::ivec2 size{0};
    glm::vec3 eye{0.0F};     ///< of the user's camera, whose lens is opening_camera()'s
    glm::vec3 target{0.0F};  ///< likewise
    Stage stage;
    std::shared_ptr<const PreviewObject> object;
    std::shared_ptr<const InspectedLight> light;
    CookedSurfaces surfaces;                 ///< by material
    std::optional<CookedSurfaces> saved;     ///< drawn into a second picture; nullopt: not drawn
    std::optional<std::size_t> grooves_of;   ///< the material whose grooves are drawn as strokes; nullopt: none
    std::optional<std::size_t> glare_of;     ///< the material that is held before the camera as well; nullopt: none
    glm::quat tilt{1.0F, 0.0F, 0.0F, 0.0F};  ///< of an object that tilts

    friend bool operator==(const PreviewInputs&, const PreviewInputs&) = default;
};

/// The live picture of a material, and one of its saved version. Needs a current context.
class Preview {
 public:
    /// `still`, for captures: maps are complete in the second frame; otherwise they fill over many frames.
    Preview(const post::OcioConfig& config, bool still) : config_(config), still_(still), now_(config, still) {}

    /// Sets the inputs; call it every frame. The object and the light must exist. Uploads changed inputs. Throws Error
    /// if the GPU refuses the light or a material; the upload is not repeated, and the last one stays in the picture.
    void show(const PreviewInputs& inputs);
    /// Draws a frame, `seconds` after the last, until the picture of the inputs no longer changes.
    void draw(float seconds);
    bool drawn() const { return drawn_; }
    /// Whether maps may still fill: the next frame may differ.
    bool changes() const;

    /// Of the last frame. Display values.
    const gpu::Framebuffer& display() const { return now_.picture.encoded(); }
    /// Strokes along the grooves of PreviewInputs::grooves_of, to lay over display(); null: none.
    const gpu::Framebuffer* grooves() const { return inputs_.grooves_of && overlay_ ? &overlay_->picture() : nullptr; }
    const gpu::Framebuffer& saved_display() const { return saved_->picture.encoded(); }
    /// Scene-linear working RGB.
    const gpu::Framebuffer& linear() const { return now_.picture.linear(); }
    const glm::dmat3& xyz_to_working() const { return now_.picture.xyz_to_working(); }

    /// The surface at a point of the last frame, given from its upper left corner in [0, 1]; nullopt where the object
    /// is not.
    std::optional<PickedSurface> pick(const glm::vec2& at);
    /// Points of the last frame, as pick() takes them, where a material may be visible: the middles of its meshes.
    std::vector<glm::vec2> middles_of(std::size_t material);
    /// A sphere around the parts of a material: its centre in the axes of PreviewInputs::eye, its radius in w. nullopt:
    /// none is drawn.
    std::optional<glm::vec4> sphere_of(std::size_t material);
    /// From the preview's world to its picture, as pick() takes points.
    glm::vec2 project(const glm::vec3& position) const;
    /// From a scene's axes to those of the preview.
    glm::mat4 scene_to_world() const;
    /// A surface that was picked earlier, under the current rotation of the stage.
    PickedSurface under_current_rotation(const PickedSurface& surface) const;
    /// The ray through a point of the last frame.
    Ray ray(const glm::vec2& at) const;

 private:
    struct Drawn {
        ecs::Entity entity;
        std::size_t mesh = 0;
        std::optional<std::size_t> material;
        std::string name;
    };
    /// A world with one object, and its renderer.
    struct Side {
        Side(const post::OcioConfig& config, bool still);
        void show(const PreviewInputs& inputs, const CookedSurfaces& wanted);
        void draw(const PreviewInputs& inputs, float seconds);
        ecs::Entity add(ecs::Entity parent, const scene::Transform& local);
        void add_shape();
        void add_scene();
        void set_own_material(const Drawn& part);
        void show_surface(std::size_t material);
        void add_surface(const CookedSurface& surface, const std::vector<ecs::Entity>& parts);
        void set_glare(const std::shared_ptr<const CookedSurface>& surface);

        view::Picture picture;
        ecs::World world;
        ecs::Entity root;                                            ///< above the object
        std::vector<ecs::Entity> all;                                ///< of the object
        std::vector<std::pair<ecs::Entity, scene::Transform>> tops;  ///< nodes without a parent, at rest
        std::vector<Drawn> drawn;
        ecs::Entity lamp;
        std::shared_ptr<const PreviewObject> object;
        std::shared_ptr<const InspectedLight> light;
        CookedSurfaces surfaces;
        /// On the GPU, by what is uploaded: equal ones share their maps, which stay when the object is replaced.
        std::map<const diffraction::CookedMaterial*, std::shared_ptr<const diffraction::GpuMaterial>> uploaded;
        std::shared_ptr<const CookedSurface> sheet;  ///< before the camera; null: none
    };

    float aspect() const;
    diffraction::GrooveLayout layout_of(const Drawn& part);
    void set_grating_vector(PickedSurface& surface) const;
    void draw_grooves();

    const post::OcioConfig& config_;
    bool still_;
    Side now_;
    std::optional<Side> saved_;  ///< empty until a saved version is shown
    std::optional<GrooveOverlay> overlay_;
    PreviewInputs inputs_;
    int unchanged_ = 0;  ///< frames drawn since the inputs changed
    bool drawn_ = false;
};

/// Where the object stands, metres.
inline constexpr glm::vec3 kObjectPosition(0.0F, 0.052F, 0.0F);
/// The initial camera, that of the demo's disc.
scene::Camera opening_camera();

}  // namespace rowland::inspector
