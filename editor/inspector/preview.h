#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/inspector/cook_grating.h"
#include "editor/inspector/groove_overlay.h"
#include "editor/inspector/inspected_light.h"
#include "editor/inspector/pick_point.h"
#include "editor/inspector/preview_shape.h"
#include "engine/ecs/world.h"
#include "engine/gpu/framebuffer.h"
#include "engine/post/ocio_config.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/camera.h"
#include "engine/view/picture.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::inspector {

/// Settings of light and exposure.
struct Stage {
    float rotation_deg = 0.0F;  ///< of the probe about the vertical axis
    float exposure_stops = 0.0F;
    bool lamp = false;  ///< a distant lamp in addition to the probe; it does not turn with the probe
    float lamp_azimuth_deg = 35.0F;
    float lamp_elevation_deg = 50.0F;
    float lamp_irradiance = 3.0F;

    friend bool operator==(const Stage&, const Stage&) = default;
};

/// Toward the lamp, of a picture whose probe is not turned.
glm::vec3 lamp_direction(const Stage& stage);

/// What is shown: a shape, which has the one material 0, or a scene with its own. Never changes, so the pointer to it
/// is its identity.
struct PreviewObject {
    PreviewShape shape = PreviewShape::Disc;
    SceneUpload parts;                         ///< a shape's: its mesh, no materials
    std::shared_ptr<const SceneObject> scene;  ///< null: a shape
};

/// What each material of the object has; null where it has no grating, or none yet.
using Gratings = std::vector<std::shared_ptr<const CookedGrating>>;

/// A point of the object in the last frame.
struct PickedSurface {
    PickedPoint point;                    ///< in the axes of the preview's world, which turns with the object
    diffraction::ShadingPoint frame;      ///< in the probe's axes, with the grating vector of the material's grooves
    std::optional<std::size_t> material;  ///< nullopt: a mesh without one
    double map_rotation = 0.0;            ///< radians by which the groove texture turns them here
    float stage_rotation_deg = 0.0F;      ///< of the frame that it was picked in
    std::string mesh;                     ///< of a scene
};

/// All that the picture depends on.
struct PreviewInputs {
    glm::ivec2 size{0};
    glm::vec3 eye{0.0F};     ///< of the user's camera, whose lens is opening_camera()'s
    glm::vec3 target{0.0F};  ///< likewise
    Stage stage;
    std::shared_ptr<const PreviewObject> object;
    std::shared_ptr<const InspectedLight> light;
    Gratings gratings;                      ///< by material
    std::optional<Gratings> saved;          ///< drawn into a second picture; nullopt: not drawn
    std::optional<std::size_t> grooves_of;  ///< the material whose grooves are drawn as strokes; nullopt: none
    std::optional<std::size_t> glare_of;    ///< the material that is held before the camera as well; nullopt: none

    friend bool operator==(const PreviewInputs&, const PreviewInputs&) = default;
};

/// The live picture of a material, and one of its saved version. Needs a current context.
class Preview {
 public:
    /// `still`, for captures: maps are complete in the second frame; otherwise they fill over many frames.
    Preview(const post::OcioConfig& config, bool still) : config_(config), still_(still), now_(config, still) {}

    /// States the inputs, once a frame; object and light must be there, and a shape's grating. Uploads what changed.
    /// Throws Error if the GPU refuses the light or a material; it is not tried again, and the last one stays in the
    /// picture.
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
    /// Points of the last frame, as pick() takes them, where a material may be seen: the middles of its meshes.
    std::vector<glm::vec2> middles_of(std::size_t material);
    /// From the preview's world to its picture, as pick() takes points.
    glm::vec2 project(const glm::vec3& position) const;
    /// The same surface where the stage's rotation has moved it since.
    PickedSurface as_placed_now(const PickedSurface& surface) const;
    /// The ray through a point of the last frame.
    Ray ray(const glm::vec2& at) const;

 private:
    struct Drawn {
        ecs::Entity entity;
        std::size_t mesh = 0;
        std::optional<std::size_t> material;
        std::string name;
    };
    /// A world with one object in it, and what draws it.
    struct Side {
        Side(const post::OcioConfig& config, bool still);
        void show(const PreviewInputs& inputs, const Gratings& wanted);
        void draw(const PreviewInputs& inputs, float seconds);
        ecs::Entity add(ecs::Entity parent, const scene::Transform& local);
        void add_shape();
        void add_scene();
        void set_own_material(const Drawn& part);
        void show_grating(std::size_t material);
        void look_through(std::shared_ptr<const CookedGrating> grating);

        view::Picture picture;
        ecs::World world;
        ecs::Entity root;              ///< above the object
        std::vector<ecs::Entity> all;  ///< the object's
        std::vector<Drawn> drawn;
        ecs::Entity lamp;
        std::shared_ptr<const PreviewObject> object;
        std::shared_ptr<const InspectedLight> light;
        Gratings gratings;
        std::shared_ptr<const CookedGrating> sheet;  ///< before the camera; null: none
    };

    float aspect() const;
    void add_grooves(PickedSurface& surface) const;
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

/// The camera at the start, as the demo sees its disc.
scene::Camera opening_camera();

}  // namespace rowland::inspector
