#pragma once

#include <functional>
#include <string>

#include "editor/inspector/foil_studio.h"
#include "editor/inspector/preview.h"
#include "editor/inspector/view.h"
#include "editor/inspector/widgets.h"

namespace rowland::inspector {

/// What the buttons of a foil card's panel ask for.
struct FoilActions {
    std::function<void(const Field&)> choose_picture;
    std::function<void()> save_card;
    std::function<void(FilmSettings)> save_film;  ///< all but the path
};

/// The fields of a foil card, with the names that printers use. A refusal is shown below its field.
class FoilPanel {
 public:
    /// Into the current ImGui window.
    void draw(FoilStudio& studio, const FoilActions& actions, ControlMap& controls);

 private:
    void draw_actions(FoilStudio& studio, const FoilActions& actions, ControlMap& controls);
    void draw_film_settings(const FoilActions& actions, ControlMap& controls);
    void draw_field(FoilStudio& studio, const Field& field, const FoilActions& actions, ControlMap& controls);
    void draw_control(FoilStudio& studio, const Field& field, const FoilActions& actions, ControlMap& controls);

    FilmSettings film_;
    std::string hovered_;  ///< pointer of the picture under the mouse in this frame
};

/// The types of foil as pictures of the user's card, which tilt with it; a click chooses one.
class FoilWallPanel {
 public:
    /// Into the current ImGui window. `still`: as for Preview.
    void draw(FoilStudio& studio, const View& view, const post::OcioConfig& config, bool still, float pixels_per_unit,
              float seconds, ControlMap& controls);

 private:
    std::optional<Preview> preview_;
    PreviewInputs drawn_;    ///< in the last picture
    bool fast_ = false;      ///< the last picture took little time
    float pause_s_ = 0.0F;  ///< until the next picture
    int frames_ = 0;        ///< that were drawn
};

}  // namespace rowland::inspector
