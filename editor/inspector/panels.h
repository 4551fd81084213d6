#pragma once

#include <imgui.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "editor/inspector/rigorous_curves.h"
#include "editor/inspector/session.h"
#include "editor/inspector/widgets.h"
#include "engine/core/computed.h"
#include "engine/gpu/texture.h"
#include "engine/platform/input.h"
#include "engine/post/display_pass.h"
#include "engine/scene/camera.h"

namespace rowland::inspector {

/// The values of the pixel that was picked.
void draw_picked_pixel(const View& view, ControlMap& controls);

/// The physics of a film as plots: its reflectance over wavelength and angle, and its colours over thickness, by the
/// exact sum, by a table and by glTF's formula.
class FilmPanel {
 public:
    /// Call it every frame.
    void update(const OpenDocument& opened);
    /// Into the current ImGui window.
    void draw(const View& view, ControlMap& controls);
    /// Whether curves are being computed.
    bool busy() const { return curves_.busy(); }

 private:
    void draw_curves(const FilmCurves& curves, ControlMap& controls) const;

    std::shared_ptr<const thin_film::CookedFilm> film_;  ///< null: none
    double angle_deg_ = 0.0;
    Computed<FilmInputs, FilmCurves> curves_;
};

/// The fields of the material, each with its unit, tooltip and reset button. A refusal is shown below its field.
class MaterialPanel {
 public:
    /// Into the current ImGui window.
    void draw(Document& document, ControlMap& controls);

 private:
    void draw_field(Document& document, const Field& field, ControlMap& controls);
    void draw_control(Document& document, const Field& field, ControlMap& controls);
    void draw_text(Document& document, const Field& field);

    std::map<std::string, std::string> texts_;  ///< that are being typed, by the field's pointer
};

/// The materials of an open scene: which one is edited, its meshes, and its grating or film as a whole.
class ScenePanel {
 public:
    /// Into the current ImGui window. Empty unless a scene is open or being opened.
    void draw(OpenDocument& opened, View& view, ControlMap& controls);

 private:
    void draw_list(OpenDocument& opened, ControlMap& controls);

    std::size_t listed_ = 0;  ///< the chosen material in the last frame
};

/// The diffraction pattern of a lattice, through the view's exposure and display.
class PatternPane {
 public:
    /// Into the current ImGui window.
    void draw(const View& view, const std::shared_ptr<const PatternFigure>& pattern,
              const post::DisplayTransform& display, ControlMap& controls);

 private:
    void paint(const View& view, const post::DisplayTransform& display);

    std::shared_ptr<const PatternFigure> shown_;  ///< in texture_, with exposure_stops_
    float exposure_stops_ = 0.0F;
    gpu::Texture texture_;
};

/// The light of the panes that show one wavelength or one direction.
struct PaneLight {
    double wavelength_nm = 550.0;
    double incidence_deg = 20.0;
    double azimuth_deg = 0.0;  ///< from the direction across the grooves
};

/// The physics of the material as plots and numbers.
class PhysicsPanel {
 public:
    explicit PhysicsPanel(const post::OcioConfig& config) : display_(config) {}

    /// Call it every frame.
    void update(const OpenDocument& opened);
    /// Into the current ImGui window.
    void draw(const OpenDocument& opened, const View& view, const Measurement& measurement, ControlMap& controls);
    /// Whether rigorous efficiencies are being computed.
    bool busy() const { return rigorous_.busy(); }

 private:
    void draw_rigorous(const diffraction::Grating& grating, ControlMap& controls);
    void draw_point(const View& view, const Measurement& measurement, bool with_spectrum, ControlMap& controls) const;

    post::DisplayTransform display_;
    PaneLight light_;
    PatternPane pattern_;
    int polarisation_ = 0;                                           ///< of the curves: mean, TE, TM
    Computed<RigorousInputs, std::vector<RigorousOrder>> rigorous_;  ///< of gratings of rigorous theory
    std::string rigorous_failure_;
};

/// The preview with its tools: drag orbits, the wheel zooms, a click picks a point, and a line divides the saved
/// version from the present one.
class PreviewPanel {
 public:
    PreviewPanel();

    /// Into the current ImGui window. `pixels_per_unit`: of the framebuffer, per screen coordinate; `seconds`: since
    /// the last frame.
    void draw(OpenDocument& opened, LightChoice& light, View& view, const platform::InputState& input,
              float pixels_per_unit, float seconds, ControlMap& controls);
    /// The same for a foil card, which a drag stops and turns.
    void draw(FoilStudio& studio, LightChoice& light, View& view, const platform::InputState& input,
              float pixels_per_unit, float seconds, ControlMap& controls);
    scene::Camera camera() const { return camera_.camera(); }
    /// Corner and size of the picture, in screen coordinates; nullopt: the tile was too small for one.
    const std::optional<std::pair<ImVec2, ImVec2>>& picture() const { return picture_; }

    /// Moves the camera so that the meshes with the chosen material fill the picture.
    void frame(View& view);

    bool comparing = false;  ///< the saved version is shown to the left of the dividing line

 private:
    void draw_tools(bool has_scene, bool has_grating, bool has_saved, LightChoice& light, View& view,
                    ControlMap& controls);
    void draw_light_tools(LightChoice& light, View& view, ControlMap& controls);
    /// The picture's rectangle, an invisible button; nullopt: it is too small.
    const std::optional<std::pair<ImVec2, ImVec2>>& begin_picture(ControlMap& controls);
    void follow(const void* shown, const scene::Camera& camera);
    void draw_picture(const View& view, const ImVec2& corner, const ImVec2& size) const;
    void draw_saved(const View& view, const ImVec2& corner, const ImVec2& end) const;
    void draw_lamp(const Stage& stage, const ImVec2& corner, const ImVec2& size, ControlMap& controls) const;
    bool near_lamp(const Stage& stage, const glm::vec2& at, const ImVec2& size) const;
    /// `document`: whose grooves can be rotated; null: none.
    void use_mouse(Document* document, View& view, const platform::InputState& input, const ImVec2& corner,
                   const ImVec2& size);

    enum class Drag { None, Line, Lamp, Grooves, Orbit };

    scene::OrbitCamera camera_;
    std::optional<std::pair<ImVec2, ImVec2>> picture_;  ///< picture()
    const void* shown_ = nullptr;                       ///< the scene or the foil card in the last frame
    bool has_saved_ = false;                            ///< in this frame: there is a saved version
    float line_ = 0.5F;                                 ///< position of the dividing line, as a fraction of the width
    Drag drag_ = Drag::None;
    bool lamp_behind_ = false;   ///< at the start of the drag
    float moving_scale_ = 1.0F;  ///< pixels of a card that moves over those of one at rest, along a side
};

/// The cost and the error of the material, and of the other representations that a grating could have: a plot of error
/// over price, with a slider along the Pareto front.
class PricePanel {
 public:
    /// `frame_ms`: the median frame time here; 0: unknown.
    void draw(Measurement& measurement, const OpenDocument& opened, View& view, double frame_ms, ControlMap& controls);

 private:
    float budget_ = 0.05F;
};

}  // namespace rowland::inspector
