#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "modules/diffraction/foil/card.h"

namespace rowland::diffraction::foil {

/// A small picture of a card that can be tilted, for choosing among foils: print and grooves under four lamps by the
/// grating equation alone, without efficiencies, shadows or the room. A frame takes 20 ns per texel on two cores.
class Thumbnail {
 public:
    /// A picture of `height` pixels, of a card with four texels per pixel. Throws Error (input) as make_card() does.
    Thumbnail(Recipe recipe, NamedPictures pictures, const std::string& file, int height);

    int width() const { return width_; }
    int height() const { return height_; }

    /// RGBA, sRGB, row by row from the top: 4 × width() × height() bytes. `tilt`: from the card's axes (u, up, out of
    /// the card) to those of the eye.
    void draw(const glm::mat3& tilt, std::span<std::uint8_t> rgba) const;

 private:
    struct Texel {
        glm::vec3 print{0.0F};       ///< linear, what is reflected without grooves
        glm::vec3 tint{0.0F};        ///< of what the grooves diffract
        glm::vec2 grooves{0.0F};     ///< direction of g
        float pitch_nm = 0.0F;       ///< 0: no grooves
        glm::vec2 position_m{0.0F};  ///< from the card's middle
    };

    int width_ = 0;
    int height_ = 0;
    float lobe_ = 0.0F;  ///< standard deviation of sin θ along the grooves; 0: light spreads freely
    std::vector<Texel> texels_;
};

}  // namespace rowland::diffraction::foil
