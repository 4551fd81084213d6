#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/inspector/cooked_surfaces.h"
#include "editor/inspector/foil_recipe.h"
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

/// Where the card of a type lies in the picture of all types.
struct WallCell {
    glm::vec2 minimum{0.0F};  ///< fractions of the picture, from its upper left corner
    glm::vec2 maximum{0.0F};
};

/// The twelve types of foil on one artwork, as one object of rows of cards.
class FoilWall {
 public:
    static constexpr int kColumns = 4;
    static constexpr int kRows = 3;

    /// Call it every frame. `may_begin`: whether new cards may be begun. Returns whether there is a new picture.
    bool update(const FoilRecipe& recipe, const SurfaceCook& tables, bool may_begin);
    bool busy() const { return cards_.busy(); }

    /// Null before the first card.
    const std::shared_ptr<const PreviewObject>& object() const { return object_; }
    const CookedSurfaces& surfaces() const { return surfaces_; }
    /// A camera that sees the whole wall in a picture of size().
    static scene::Camera camera();
    /// Pixels of a picture whose cards are `width` wide.
    glm::ivec2 size(float width) const;
    WallCell cell(std::size_t type) const;

 private:
    /// A type's card with few texels, and the recipe that it was made of.
    struct Made {
        std::string key;
        std::shared_ptr<const FoilCard> card;
    };
    using All = std::vector<Made>;  ///< by type

    void arrange();

    glm::vec2 card_m_{0.0F};  ///< width and height
    std::shared_ptr<const PreviewObject> object_;
    CookedSurfaces surfaces_;
    std::map<const FoilCard*, SceneUpload> uploads_;
    Computed<std::vector<std::string>, All> cards_;
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
    const FoilWall& wall() const { return wall_; }
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
