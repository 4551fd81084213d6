#pragma once

#include <glm/vec3.hpp>

namespace rowland::post {

/// A rendering for displays of Rec.709 primaries that keeps the Oklab hue of every light and clips no channel. From
/// cone responses (colour::rec709_to_oklab_lms) to linear display RGB from 0 to 1. Exact to 1e-4; responses below 0
/// count as 0.
/// - Tone: the light is scaled by tone(n) / n. For the brightest lights n is their own level, the cube of Oklab's
///   lightness; for darker ones it approaches the largest Rec.709 component, so that saturated colours stay dark
///   enough for the display to show them saturated. The two are equal for neutrals.
/// - Chroma follows the local contrast of the curve, as film's does: more in the shadows, less in the highlights.
/// - Gamut: chroma up to 65 % of what the display has at that lightness and hue stays; beyond, it is compressed to
///   below all of it. White has none, so very bright lights of any colour become white smoothly.
glm::dvec3 constant_hue(const glm::dvec3& lms);

/// The tone curve: x^g / (x^g + k) [Naka & Rushton 1966, S-potentials from colour units in the retina of fish], through
/// the values 0.1041 and 0.6243 that ACES 1.0 shows for 0.18 and 1. From light (0 or more) to 0 … 1.
double constant_hue_tone(double light);

}  // namespace rowland::post
