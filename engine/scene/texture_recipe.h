#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/json_reader.h"

namespace rowland::scene {

/// What a layer paints into one channel: from + (to − from) · t. t runs from 0 to 1 `repeat` times while the coordinate
/// `by` runs from `begin` to `end`; outside t is clamped.
struct ChannelRecipe {
    enum class By {
        Cell,    ///< a constant per cell, evenly distributed over the cells
        Radius,  ///< from the cell's centre to its edge
        Angle,   ///< around the centre, counter-clockwise from the right
        X,       ///< across the picture, from the left
        Y,       ///< from the bottom
    };

    double from = 0.0;  ///< 0 … 1
    double to = 0.0;
    By by = By::X;
    double begin = 0.0;  ///< 0 … 1, below `end`
    double end = 1.0;
    double repeat = 1.0;  ///< > 0

    bool operator==(const ChannelRecipe&) const = default;
};

/// Lengths are in heights of the picture, positions from its lower left corner.
struct LayerRecipe {
    enum class Pattern {
        All,       ///< everywhere; one cell
        Tiles,     ///< rectangles
        Hexagons,  ///< regular, two corners up and down
        Rosette,   ///< a flower of concentric rings; with petals = 0 a disc
    };

    Pattern pattern = Pattern::All;
    glm::dvec2 size{0.0};      ///< of tiles; of hexagons x, across their flats; > 0
    double gap = 0.0;          ///< fraction of a tile's, hexagon's or ring's width that is not painted, 0 … < 1
    glm::dvec2 centre{0.0};    ///< of a rosette
    double radius = 0.0;       ///< of a rosette, out to the petals' tips, > 0
    int petals = 0;            ///< 0 … 64
    double petal_depth = 0.3;  ///< of the notches between petals, as a fraction of the radius, 0 … < 1
    int rings = 1;             ///< 1 … 256; each is a cell
    std::array<std::optional<ChannelRecipe>, 4> channels;  ///< R, G, B, A; nullopt: not painted

    bool operator==(const LayerRecipe&) const = default;
};

/// A picture painted in layers, each over those before it, on opaque black; or the picture of a PNG file. Plain
/// numbers: the user of the texture decides whether they mean colours.
struct TextureRecipe {
    std::string picture{};  ///< a file beside the recipe's; empty: painted
    int width = 1;          ///< texels, 1 … 8192
    int height = 1;
    std::vector<LayerRecipe> layers;  ///< at most 32

    bool operator==(const TextureRecipe&) const = default;
};

/// Reads "picture", or "size" and "layers", of an object that may hold more; the format is in scene_recipe.schema.json.
/// The caller calls `finish()`. Throws Error (input).
TextureRecipe parse_texture(JsonReader& reader);

struct PaintedTexture {
    int channels = 3;                  ///< 4 if a layer paints A
    std::vector<std::uint8_t> texels;  ///< width·height·channels, row by row from the top
};

/// Of layers. The same recipe gives the same bytes with any number of threads.
PaintedTexture paint(const TextureRecipe& recipe);

}  // namespace rowland::scene
