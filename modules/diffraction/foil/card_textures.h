#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "modules/diffraction/foil/card.h"
#include "modules/diffraction/foil/grating.h"

namespace rowland::diffraction::foil {

/// An encoded picture, or one value for the whole surface where `bytes` is empty.
struct CardTextures {
    FoilLayers layers;
    std::vector<std::byte> base_colour;         ///< PNG or JPEG
    std::vector<std::byte> metallic_roughness;  ///< PNG; empty: `metallic` and `roughness` everywhere
    double metallic = 0.0;
    double roughness = 0.0;
    std::vector<std::byte> grooves;  ///< PNG of 16 bits; empty: one direction everywhere
};

/// The textures of a card's front. Throws Error (input) as make_card() does.
CardTextures card_textures(const Recipe& recipe, const NamedPictures& pictures, const std::string& file,
                           const OnStep& on_step);

/// A picture of a card's back as it is drawn: the file's own bytes where they do, else a PNG.
std::vector<std::byte> back_texture(const Recipe& recipe, const NamedPicture& picture);

}  // namespace rowland::diffraction::foil
