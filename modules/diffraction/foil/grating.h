#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "modules/diffraction/foil/recipe.h"

namespace rowland::diffraction::foil {

/// Where the eye is most sensitive, about: what kinegrams and lenses are made for.
inline constexpr double kMiddleWavelength_nm = 550.0;

/// The finest grooves of a Lens over its coarsest.
inline constexpr double kFinestOfLens = 0.125;

/// What the grooves of a foil have in common.
struct FoilGrating {
    double pitch_nm = 1000.0;  ///< the pitch 1 of a Groove
    double smallest_pitch_nm = 1000.0;
    bool varies_pitch = false;  ///< light then spreads freely along the grooves
    double spread_deg = 0.0;    ///< how far light spreads along the grooves where the pitch does not vary
    int highest_order = 2;
    bool one_direction = false;  ///< the grooves are the same everywhere
    bool sparkle = false;        ///< facets are smaller than a pixel
    double rotation_deg = 0.0;   ///< of all grooves
};
FoilGrating foil_grating(const Foil& foil);

/// How a foil lies on its card.
struct FoilLayers {
    Ink ink = Ink::LetsThrough;
    Under under = Under::Paper;
    Lacquer lacquer = {};

    /// Metallised relief, of which nothing beneath is seen; else lines of metal as wide as a quarter of their distance.
    bool is_opaque() const { return ink == Ink::Covers && under == Under::Metal; }
};

/// The material of a foil as the object of ROWLAND_materials_diffraction. `texture`: index of the groove texture; none
/// for a foil that has one direction of grooves everywhere.
nlohmann::ordered_json foil_material(const Foil& foil, const FoilLayers& layers, std::optional<int> texture);

}  // namespace rowland::diffraction::foil
