#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace rowland::post {

/// AgX, a filmic rendering whose channels mix toward white [Sobotka 2022, AgX]: linear Rec.709 → agx_inset() → the
/// base-2 logarithm, agx_least_stop to agx_most_stop as 0 to 1 → agx_curve() → the inverse of agx_inset() → display
/// values of a gamma of 2.2.
glm::dmat3 agx_inset();

constexpr double agx_least_stop = -12.47393;  ///< log2: 10 stops below 0.18
constexpr double agx_most_stop = 4.026069;    ///< 6.5 stops above
constexpr double agx_gamma = 2.2;

/// The sigmoid of slope 2 through (10 / 16.5, 0.5) with a toe of power 3 and a shoulder of power 3.25, from 0 … 1 to 0
/// … 1.
double agx_curve(double x);

/// A rendering for displays of Rec.709 primaries that keeps the Oklab hue of every light and clips no channel. From
/// cone responses (colour::rec709_to_oklab_lms) to linear display RGB from 0 to 1. Exact to 1e-4; responses below 0
/// count as 0.
/// - Tone: the light is scaled by tone(n) / n. For the brightest lights n is their own level, the cube of Oklab's
///   lightness; for darker ones it approaches the largest Rec.709 component, so that saturated colours stay dark
///   enough for the display to show them saturated. The two are equal for neutrals.
/// - Chroma follows the local contrast of the curve, as film's does: more in the shadows, less in the highlights.
/// - Gamut: chroma up to 65 % of the display's largest at that lightness and hue is kept; larger chroma is compressed
/// to
///   less than that largest one. At white the latter is 0, so very bright lights of any colour become white smoothly.
glm::dvec3 constant_hue(const glm::dvec3& lms);

/// The tone curve: x^g / (x^g + k) [Naka & Rushton 1966, S-potentials from colour units in the retina of fish], through
/// the values 0.1041 and 0.6243 that ACES 1.0 shows for 0.18 and 1. From light (0 or more) to 0 … 1.
double constant_hue_tone(double light);

constexpr double false_colour_stops = 6.5;  ///< the scale ends this far below and above 0.18

/// A colour for each whole stop of luminance from 0.18: linear Rec.709. Grey: 0.18; blues to black: darker; greens,
/// yellow, orange, red, white: brighter. Beyond the scale as at its ends.
glm::dvec3 false_colour(double stops);

/// OpenColorIO's built-in transform of this style.
OCIO_NAMESPACE::TransformRcPtr builtin_transform(
    const char* style, OCIO_NAMESPACE::TransformDirection direction = OCIO_NAMESPACE::TRANSFORM_DIR_FORWARD);

/// Adds to the shipped configuration the views whose curves and tables no configuration file can hold: "Constant Hue",
/// which becomes the default, "AgX" and "False Colour". All are OpenColorIO's own transforms, run by its CPU and GPU
/// code.
void add_computed_views(OCIO_NAMESPACE::Config& config);

}  // namespace rowland::post
