#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "editor/inspector/light.h"
#include "editor/inspector/open_document.h"
#include "editor/inspector/preview.h"
#include "engine/core/log.h"
#include "engine/scene/camera.h"

namespace rowland::inspector {

/// What draws the chosen material on the object in view.
struct DrawnAs {
    std::string representation;     ///< "arc"; "arc and planar" where its meshes differ
    diffraction::ShadingCost cost;  ///< of the first
};

/// An object that is shown in place of the document.
struct ShownCard {
    std::shared_ptr<const PreviewObject> object;
    CookedSurfaces surfaces;
    glm::quat tilt{1.0F, 0.0F, 0.0F, 0.0F};
};

struct PickedPixel {
    glm::vec2 position{0.5F};  ///< from the picture's upper left corner, in [0, 1]
    glm::vec3 working{0.0F};   ///< scene-linear
    glm::ivec3 display{0};     ///< 8-bit values
};

/// The preview of the document under the light, on a shape or in its scene, and the point that the user picked in it.
/// Needs a current context.
class View {
 public:
    /// `document`, `light` and `messages` must outlive it. `still`: as for Preview.
    View(const post::OcioConfig& config, bool still, OpenDocument& document, const LightChoice& light,
         Messages& messages);

    Stage stage;
    bool looks_through = false;     ///< the chosen material is held before the camera as well
    bool shows_grooves = false;     ///< strokes along the grooves of the chosen material
    std::optional<ShownCard> card;  ///< nullopt: the document is shown

    /// PreviewShape::Scene shows the document's scene; it is ignored if there is none.
    void choose_shape(PreviewShape shape);
    PreviewShape shape() const { return object_->shape; }
    /// Picks the surface at a point of the last picture; does nothing where there is none. In a scene, this also
    /// chooses the surface's material.
    void pick(const glm::vec2& at);

    /// Follows the document: another scene is shown as a whole, and another chosen material ends the pick. Call it
    /// every frame, after the document's update().
    void update();
    /// Whether there are a light and a material, or a scene, to draw.
    bool ready() const {
        return light_.current() &&
               (card ? card->object != nullptr : document_.surface(false) || document_.document().is_scene());
    }
    /// Draws the preview if it is ready and the picture may have changed. `with_saved`: also the saved version.
    void draw(glm::ivec2 size, const scene::Camera& camera, bool with_saved, float seconds);
    /// Null before the first.
    LightChoice::Light light() const { return light_.current(); }
    /// The inputs of a picture of `card`, which must be there.
    PreviewInputs card_inputs(glm::ivec2 size, const scene::Camera& camera) const;
    /// Whether the next picture may differ from the last for the same inputs.
    bool changes() const { return ready() && preview_.changes(); }

    const Preview& preview() const { return preview_; }
    const std::optional<PickedPixel>& picked() const { return picked_; }
    /// The surface that was picked or, in a scene without a pick, a visible point of the chosen material; else nullopt.
    const std::optional<PickedSurface>& surface() const { return surface_; }
    /// The shading point of surface(), in the probe's axes; a new pointer whenever it changes. Null: no such surface.
    const std::shared_ptr<const diffraction::ShadingPoint>& point() const { return point_; }
    /// A shading point, and how the grooves lie around it.
    struct ViewedPoint {
        diffraction::ShadingPoint frame{};
        diffraction::GrooveLayout layout = diffraction::GrooveLayout::FlatUniform;
    };
    /// point() or, if it is null, a visible point near the middle of the picture; the defaults if there is none.
    ViewedPoint point_or_middle();
    /// A sphere around the object's parts of the chosen material, its radius in w, in the axes of the user's camera;
    /// nullopt before they are drawn.
    std::optional<glm::vec4> chosen_sphere() {
        return preview_.sphere_of(object_->scene ? document_.document().chosen() : 0);
    }
    /// Curved if one of the meshes with the chosen material is.
    diffraction::SurfaceShape surface_shape();
    /// Null without a cooked grating.
    const DrawnAs* drawn_as();

 private:
    using PixelInputs = std::tuple<std::shared_ptr<const CookedSurface>, LightChoice::Light,
                                   std::shared_ptr<const diffraction::ShadingPoint>, Stage>;

    using DrawnInputs =
        std::tuple<std::shared_ptr<const PreviewObject>, std::size_t, std::shared_ptr<const CookedSurface>>;

    void forget_point();
    std::set<diffraction::GrooveLayout> layouts(bool has_groove_texture) const;
    std::optional<PickedSurface> find_surface();
    void update_point();
    void read_picked_pixel();

    OpenDocument& document_;
    const LightChoice& light_;
    Messages& messages_;
    Preview preview_;
    std::shared_ptr<const PreviewObject> object_;
    std::size_t last_replacements_ = 0;  ///< document_.replacements() in the last update()
    std::size_t last_chosen_ = 0;        ///< material in the last update()
    std::optional<PickedPixel> picked_;
    std::optional<PickedSurface> surface_;
    std::shared_ptr<const diffraction::ShadingPoint> point_;
    bool searched_ = false;                                                ///< for a surface of the chosen material
    PixelInputs pixel_inputs_;                                             ///< of the colours in picked_
    std::pair<std::shared_ptr<const PreviewObject>, std::size_t> shaped_;  ///< object and material of shape_
    diffraction::SurfaceShape shape_ = diffraction::SurfaceShape::Flat;
    DrawnInputs drawn_inputs_;  ///< of drawn_as_
    DrawnAs drawn_as_;
};

}  // namespace rowland::inspector
