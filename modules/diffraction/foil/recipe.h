#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/core/json_reader.h"

namespace rowland::diffraction::foil {

/// The name of the asset type whose sources are foil recipes.
inline constexpr const char* kFoilAssetType = "foil";

// The types of foil, each an arrangement of gratings on the card. Lengths are millimetres on the card and are
// multiplied by Foil::scale; angles are degrees, counter-clockwise from the direction in which u grows.

/// Vertical bands. Grooves are horizontal, and their pitch grows from one edge of a band to the other, so that on tilt
/// a colour slides sideways. Foil::direction_deg turns the bands.
struct Pillars {
    double band_mm = 9.0;
    double pitch_range = 1.5;  ///< largest pitch of a band over its smallest
};

/// One direction of grooves everywhere.
struct Rainbow {};

/// Grooves about a centre: rays, or circles as on a disc.
struct Radial {
    bool circles = false;
    glm::dvec2 centre{0.5};  ///< from the lower left corner, in fractions of the card
};

/// Squares, or hexagons, of one direction each, evenly spread over `directions` directions.
struct Tiles {
    double size_mm = 5.0;
    int directions = 12;
};
struct Hexagons {
    double size_mm = 5.0;  ///< width
    int directions = 12;
};

/// Dots and rings of many sizes, with circular grooves, on a ground of one direction.
struct Cosmos {
    double size_mm = 12.0;  ///< of the largest
};

/// Irregular facets of random directions: the cells of a Voronoi diagram.
struct CrackedIce {
    double size_mm = 7.0;  ///< mean distance of their centres
};

/// Square facets of random directions, smaller than a pixel of the picture of the card.
struct Glitter {
    double size_um = 120.0;
};

/// Fine strokes, whose grooves run along them but for a random angle of each stroke.
struct Brushed {
    double stroke_mm = 0.15;  ///< width
    double length_mm = 12.0;
    double spread_deg = 8.0;  ///< standard deviation of the angle
};

/// A kinegram: picture A is seen at one tilt of the card, picture B at another (kinegram.h).
struct TwoPictures {
    std::vector<std::string> pictures = {};  ///< the files of A and B
    glm::dvec2 tilts_deg{-10.0, 10.0};       ///< for A and B, about the horizontal axis; positive: the top edge away
    double lamp_deg = 40.0;                  ///< the angle of the lamp above the eye, as the card sees them
    double cell_mm = 0.09;                   ///< of the cells of A and B, which alternate
};

/// Circular grooves of a zone plate, which mirrors a lamp to a coloured focus that floats before the card.
struct Lens {
    double focal_mm = 60.0;
    glm::dvec2 centre{0.5};  ///< from the lower left corner, in fractions of the card
};

/// Grooves that run along the strokes of a drawing.
struct Own {
    std::string drawing = {};  ///< its file
    double smooth_mm = 0.6;    ///< width over which directions are averaged
};

using FoilType = std::variant<Pillars, Rainbow, Radial, Tiles, Hexagons, Cosmos, CrackedIce, Glitter, Brushed,
                              TwoPictures, Lens, Own>;

/// The name of a type in a recipe, in the order of FoilType.
std::vector<std::string_view> foil_type_names();
/// A type with its default numbers, and without pictures; nullopt: no type has this name.
std::optional<FoilType> foil_type(std::string_view name);

struct Foil {
    FoilType type = CrackedIce{};
    double direction_deg = 0.0;
    double scale = 1.0;
    double groove_um = 1.0;                 ///< distance of neighbouring grooves; the smallest where it varies
    std::optional<double> spread_deg = {};  ///< how far light spreads along the grooves; none: the type's own
    std::uint32_t seed = 1;                 ///< of what is random
};

/// What the artwork's ink does to the foil.
enum class Ink {
    Covers,      ///< it hides the foil; this shows where the artwork is transparent
    LetsThrough  ///< the foil is a clear film over the print: picture and colours are seen together
};

/// What lies under ink and foil.
enum class Under { Metal, Paper };

/// A clear coat over the card.
struct Lacquer {
    bool gloss = true;     ///< false: none, the grooves lie in air
    glm::dvec3 tint{1.0};  ///< linear Rec.709, of the foil's light: a yellow one makes silver gold
};

struct CardShape {
    double width_mm = 63.0;
    double height_mm = 88.0;
    double thickness_mm = 0.32;
    double corner_mm = 3.0;  ///< radius
    std::string back = {};   ///< the back's artwork; empty: plain paper
};

/// A foil recipe: what lies on a card, in the words of a printer.
struct Recipe {
    std::string artwork;  ///< file; names are relative to the recipe's folder
    std::string mask;     ///< file, white = foil; empty: everywhere
    Foil foil = {};
    std::optional<Ink> ink = {};      ///< none: Covers if the artwork has transparent parts, else LetsThrough
    std::optional<Under> under = {};  ///< none: Metal if the ink covers, else Paper
    Lacquer lacquer = {};
    CardShape card = {};
    int texture_px = 2048;  ///< texels along the card's longer side
};

/// Whether a JSON document is a foil recipe: an object with the key "artwork".
bool is_foil_recipe(const nlohmann::json& document);

/// Reads `{"artwork": "a.png", "foil": {"type": "tiles", …}, …}`. Throws Error (input).
Recipe parse_foil_recipe(const nlohmann::json& document, const std::string& file);
Recipe parse_foil_recipe(JsonReader& root);

}  // namespace rowland::diffraction::foil
