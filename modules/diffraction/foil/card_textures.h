#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "modules/diffraction/foil/card.h"
#include "modules/diffraction/foil/grating.h"

namespace rowland::diffraction::foil {

/// The pictures of a card before they are encoded: three values per texel of `area`, row by row from the top.
struct CardTexels {
    Area area = {};
    FoilLayers layers = {};
    std::vector<std::uint8_t> base_colour = {};         ///< sRGB; empty: the artwork's own file does
    std::vector<std::uint8_t> metallic_roughness = {};  ///< empty: `metallic` and `roughness` everywhere
    double metallic = 0.0;
    double roughness = 0.0;
    std::vector<std::uint16_t> grooves = {};  ///< empty: one direction everywhere
    std::vector<std::uint8_t> back = {};      ///< sRGB; empty: there is none, or its own file does
};

/// The texels of a card. Throws Error (input) as make_card() does.
CardTexels card_texels(const Recipe& recipe, const NamedPictures& pictures, const std::string& file,
                       const OnStep& on_step = {});

/// The pictures of CardTexels, each a PNG or JPEG; empty where there is none.
struct CardTextures {
    std::vector<std::byte> base_colour;
    std::vector<std::byte> metallic_roughness;
    std::vector<std::byte> grooves;  ///< PNG of 16 bits
    std::vector<std::byte> back;
};

CardTextures card_textures(const CardTexels& texels, const Recipe& recipe, const NamedPictures& pictures,
                           const OnStep& on_step);

/// The binary glTF file of make_card().
std::vector<std::byte> card_file(const Recipe& recipe, const CardTexels& texels, CardTextures textures,
                                 const std::string& file);

}  // namespace rowland::diffraction::foil
