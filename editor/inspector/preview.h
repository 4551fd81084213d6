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
#include "modules/diffraction/model/frame.h"

namespace rowland::inspector {

/// How the material is lit and seen.
struct Stage {
    float rotation_deg = 0.0F;  ///< of the surroundings about the vertical
    float exposure_stops = 0.0F;
    bool lamp = false;  ///< a distant lamp beside the probe, fixed to the user
    float lamp_azimuth_deg = 35.0F;
    float lamp_elevation_deg = 50.0F;
    float lamp_irradiance = 3.0F;

    friend bool operator==(const Stage&, const Stage&) = default;
};

/// The live picture of a material, and of its saved version beside it. Needs a current context.
class Preview {
 public:
    /// `still`: maps are full in the second frame, for pictures; else they fill by and by.
    Preview(const post::OcioConfig& config, bool still);

    /// `model`: the mesh of PreviewShape::Model, fitted.
    void set_shape(PreviewShape shape, const std::optional<scene::Mesh>& model);
    void set_light(std::shared_ptr<const InspectedLight> light);
    void set_material(std::shared_ptr<const diffraction::CookedMaterial> cooked);
    /// Null: there is no saved version to compare with.
    void set_saved(std::shared_ptr<const diffraction::CookedMaterial> cooked);

    /// Whether there are a light and a material to draw.
    bool ready() const { return light_ && material_; }
    bool has_saved() const { return saved_material_ != nullptr; }
    /// Draws the material, and the saved one if `with_saved`; ready() must hold. `camera` is the user's: surroundings
    /// that are turned turn beneath it.
    void draw(glm::ivec2 size, const scene::Camera& camera, const Stage& stage, bool with_saved, float seconds);

    /// Of the last draw. Display values.
    const gpu::Framebuffer& display() const { return now_->picture.encoded(); }
    const gpu::Framebuffer& saved_display() const { return saved_->picture.encoded(); }
    /// Scene-linear working RGB.
    const gpu::Framebuffer& linear() const { return now_->picture.linear(); }
    const glm::dmat3& xyz_to_working() const { return now_->picture.xyz_to_working(); }

    /// The surface seen at a point of the last picture, from its upper left corner in [0, 1], in the probe's axes.
    std::optional<diffraction::Frame> pick(const glm::vec2& at) const;

 private:
    /// A world with one object in it, and what draws it.
    struct Side {
        Side(const post::OcioConfig& config, bool still);
        void show(const diffraction::CookedMaterial& cooked);
        void place(const glm::mat4& object_to_world, const Stage& stage, const glm::mat4& turn);

        view::Picture picture;
        ecs::World world;
        ecs::Entity object;
        ecs::Entity lamp;
    };
    Side& saved_side();

    const post::OcioConfig& config_;
    bool still_;
    std::unique_ptr<Side> now_;
    std::unique_ptr<Side> saved_;  ///< made when it is first looked at
    PreviewShape shape_ = PreviewShape::Disc;
    render::MeshInstance mesh_;
    std::shared_ptr<const InspectedLight> light_;
    std::shared_ptr<const diffraction::CookedMaterial> material_;
    std::shared_ptr<const diffraction::CookedMaterial> saved_material_;
    scene::Camera camera_;
    glm::mat4 object_to_world_{1.0F};
    float aspect_ = 1.0F;
};

/// Where the user first stands: the demo's place before its disc.
scene::Camera opening_camera();

}  // namespace rowland::inspector
