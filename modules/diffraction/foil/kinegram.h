#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "modules/diffraction/foil/pattern.h"
#include "modules/diffraction/foil/recipe.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction::foil {

// A kinegram for an eye straight before the card, far away, and a lamp above it, far away as well. Where the top edge
// is tilted away from the eye by t, the card sees the eye at the angle -t and a lamp of the angle L at L - t from its
// normal, and with horizontal grooves
//   u = sin(-t) + sin(L - t).
// Grooves of the pitch d send the wavelength d u in the first order to the eye.

/// u at a tilt.
double path_over_pitch(const TwoPictures& two, double tilt_deg);

/// The pitches that send the middle wavelength to the eye: of picture A at its tilt, of B at the other.
glm::dvec2 picture_pitches_nm(const TwoPictures& two);

/// Why the tilts do not do: grooves would be too fine or too coarse, or one picture would be seen at the tilt of the
/// other, in the first or the second order.
std::optional<Refusal> tilt_refusal(const TwoPictures& two);

/// Rows of cells of A and of B alternate. The fraction of a picture's cells that shine is its brightness, by ordered
/// dither over 8 × 8 cells; the others have upright grooves.
GrooveField kinegram_field(const TwoPictures& two, double scale, const Area& area, Brightness a, Brightness b);

}  // namespace rowland::diffraction::foil
