#pragma once

#include <functional>
#include <string>

#include "editor/inspector/foil_studio.h"
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

/// Draws the types of foil as thumbnails of the user's card, which tilt with it, into the current ImGui window; a click
/// chooses one.
void draw_foil_wall(FoilStudio& studio, ControlMap& controls);

}  // namespace rowland::inspector
