#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "editor/inspector/inspected_light.h"
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

/// What the material is shown on. Never changes, so the pointer to it is its identity.
struct PreviewObject {
    PreviewShape shape = PreviewShape::Disc;
    render::MeshInstance mesh;
};

/// All that the picture depends on.
struct PreviewInputs {
    glm::ivec2 size{0};
    glm::vec3 eye{0.0F};     ///< of the user's camera, whose lens is opening_camera()'s
    glm::vec3 target{0.0F};  ///< likewise
    Stage stage;
    std::shared_ptr<const PreviewObject> object;
    std::shared_ptr<const InspectedLight> light;
    std::shared_ptr<const diffraction::CookedMaterial> material;
    std::shared_ptr<const diffraction::CookedMaterial> saved;  ///< drawn into a second picture; null: not drawn

    friend bool operator==(const PreviewInputs&, const PreviewInputs&) = default;
};

/// The live picture of a material, and one of its saved version. Needs a current context.
class Preview {
 public:
    /// `still`, for captures: maps are complete in the second frame; otherwise they fill over many frames.
    Preview(const post::OcioConfig& config, bool still) : config_(config), still_(still), now_(config, still) {}

    /// States the inputs, once a frame; all but `saved` must be there. Uploads what changed. Throws Error if the GPU
    /// refuses the light or a material; it is not tried again, and the last one stays in the picture.
    void show(const PreviewInputs& inputs);
    /// Draws a frame, `seconds` after the last, until the picture of the inputs no longer changes.
    void draw(float seconds);
    bool drawn() const { return drawn_; }
    /// Whether maps may still fill: the next frame may differ.
    bool changes() const;

    /// Of the last frame. Display values.
    const gpu::Framebuffer& display() const { return now_.picture.encoded(); }
    const gpu::Framebuffer& saved_display() const { return saved_->picture.encoded(); }
    /// Scene-linear working RGB.
    const gpu::Framebuffer& linear() const { return now_.picture.linear(); }
    const glm::dmat3& xyz_to_working() const { return now_.picture.xyz_to_working(); }

    /// The surface at a point of the last frame, given from its upper left corner in [0, 1], in the probe's axes;
    /// nullopt where the object is not.
    std::optional<diffraction::ShadingPoint> pick(const glm::vec2& at) const;

 private:
    /// A world with one object in it, and what draws it.
    struct Side {
        Side(const post::OcioConfig& config, bool still);
        void show(const PreviewInputs& inputs, const std::shared_ptr<const diffraction::CookedMaterial>& cooked);
        void draw(const PreviewInputs& inputs, float seconds);

        view::Picture picture;
        ecs::World world;
        ecs::Entity entity;
        ecs::Entity lamp;
        std::shared_ptr<const PreviewObject> object;
        std::shared_ptr<const InspectedLight> light;
        std::shared_ptr<const diffraction::CookedMaterial> material;
    };

    const post::OcioConfig& config_;
    bool still_;
    Side now_;
    std::optional<Side> saved_;  ///< empty until a saved version is shown
    PreviewInputs inputs_;
    int unchanged_ = 0;  ///< frames drawn since the inputs changed
    bool drawn_ = false;
};

/// The camera at the start, as the demo sees its disc.
scene::Camera opening_camera();

}  // namespace rowland::inspector
