#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "editor/inspector/cooked_surfaces.h"
#include "editor/inspector/foil_recipe.h"
#include "editor/inspector/foil_wall.h"
#include "editor/inspector/tilt_film.h"
#include "editor/inspector/view.h"
#include "engine/core/computed.h"
#include "engine/core/log.h"

namespace rowland::inspector {

/// A card as it is drawn, made of a recipe on another thread.
struct FoilCard {
    std::vector<std::byte> glb;
    std::shared_ptr<const SceneObject> scene;
    CookedSurfaces surfaces;
    bool full = false;  ///< with the recipe's texels; else with fewer
};

/// The work on a foil card: its recipe, the card made of it in the background, the card's tilt, and films of it. Bad
/// input becomes a message at its field or in the list; the last valid card stays. Needs a current context.
class FoilStudio {
 public:
    FoilStudio(FoilRecipe recipe, Messages& messages) : recipe_(std::move(recipe)), messages_(messages) {}

    FoilRecipe& recipe() { return recipe_; }
    const FoilRecipe& recipe() const { return recipe_; }
    /// Why there is no card of the present recipe; empty: no failure.
    std::string refusal() const { return recipe_.refusal().empty() ? failure_ : recipe_.refusal(); }

    /// Call it every frame. Returns whether there is something new to see.
    bool update();
    /// Whether a card is being made, or a film.
    bool busy() const { return card_.busy() || wall_.busy() || film_ || !save_to_.empty(); }
    /// "none", "small" or "full": what is shown of the present recipe.
    const char* shown() const;

    /// With the tilt of now.
    ShownCard card() const { return {object_, surfaces_, hand_tilt(phase_)}; }
    FoilWall& wall() { return wall_; }
    bool tilting = true;   ///< the card moves as a hand tilts it
    bool editing = false;  ///< a control is held: the card stands still
    /// Whether the card moves.
    bool moves() const { return tilting && !editing && !film_ && object_; }
    void advance(float seconds);

    /// The field that a dropped picture is for: `drop_on`, else the artwork.
    const Field& dropped_field() const;
    std::string drop_on;  ///< pointer of the picture under the mouse; empty: none
    void use_picture(const Field& field, const std::filesystem::path& file);
    void save(const std::filesystem::path& path);
    /// Writes the card once it is made with all texels.
    void save_card(const std::filesystem::path& path);
    /// The film that is being made, by film_step() in each frame.
    const TiltFilm* film() const { return film_.get(); }
    void begin_film(const post::OcioConfig& config, const FilmSettings& settings, PreviewInputs inputs);
    void film_step();
    void cancel_film();

 private:
    void want_card();
    void write_card();

    FoilRecipe recipe_;
    Messages& messages_;
    SurfaceCook tables_{nullptr};  ///< shared by all cards
    std::string failure_;
    std::shared_ptr<const PreviewObject> object_;
    CookedSurfaces surfaces_;
    double phase_ = 0.0;
    std::filesystem::path save_to_;  ///< of save_card(); empty: nothing to write
    std::unique_ptr<TiltFilm> film_;
    FoilWall wall_;
    Computed<std::string, std::shared_ptr<const FoilCard>> card_;  ///< by the recipe's text
};

}  // namespace rowland::inspector
