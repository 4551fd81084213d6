#include "engine/post/constant_hue.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "engine/colour/oklab.h"

namespace rowland::post {

namespace {

constexpr double kContrast = 1.551;        ///< g of the tone curve
constexpr double kHalfLight = 0.6018;      ///< k of the tone curve: light^g that is shown as one half
constexpr double kChromaOfContrast = 0.5;  ///< power
constexpr double kUncompressed = 0.65;     ///< fraction of the gamut's chroma up to which chroma stays
constexpr double kCompressionPower = 1.6;
constexpr double kMostChroma = 0.33;  ///< a little more than any colour of Rec.709 has

glm::dvec3 to_rec709(const glm::dvec3& oklab) {
    static const glm::dmat3 matrix = glm::inverse(colour::rec709_to_oklab_lms());
    return matrix * colour::oklab_to_lms(oklab);
}

bool is_inside(const glm::dvec3& rgb) {
    return std::min({rgb.r, rgb.g, rgb.b}) >= 0.0 && std::max({rgb.r, rgb.g, rgb.b}) <= 1.0;
}

/// The most chroma that the display has of a hue (a unit vector), by bisection.
double chroma_of_gamut(double lightness, const glm::dvec2& hue) {
    double inside = 0.0;
    double outside = kMostChroma;
    for (int i = 0; i < 16; ++i) {
        const double chroma = 0.5 * (inside + outside);
        (is_inside(to_rec709({lightness, chroma * hue})) ? inside : outside) = chroma;
    }
    return inside;
}

/// The identity up to kUncompressed, then smoothly toward 1.
double compressed(double ratio) {
    if (ratio <= kUncompressed) return ratio;
    constexpr double room = 1.0 - kUncompressed;
    const double over = (ratio - kUncompressed) / room;
    return kUncompressed + room * over / std::pow(1.0 + std::pow(over, kCompressionPower), 1.0 / kCompressionPower);
}

}  // namespace

double constant_hue_tone(double light) {
    const double power = std::pow(light, kContrast);
    return power / (power + kHalfLight);
}

glm::dvec3 constant_hue(const glm::dvec3& lms) {
    const glm::dvec3 scene = colour::oklab_of_lms(glm::max(lms, 0.0));
    const double level = scene.x * scene.x * scene.x;
    if (!(level > 0.0)) return glm::dvec3(0.0);
    const glm::dvec3 rgb = to_rec709(scene);
    const double largest = std::max({rgb.r, rgb.g, rgb.b, level});
    const double light = level * std::pow(largest / level, 1.0 - constant_hue_tone(level));
    const double tone = constant_hue_tone(light);
    const double scale = std::cbrt(tone / light);
    const double lightness = scale * scene.x;

    const glm::dvec2 scene_chroma(scene.y, scene.z);
    const double length = glm::length(scene_chroma);
    const glm::dvec2 hue = length > 0.0 ? scene_chroma / length : glm::dvec2(1.0, 0.0);
    const double contrast = kContrast * (1.0 - tone);  // d log tone / d log light
    const double chroma = length * scale * std::pow(contrast, kChromaOfContrast);
    const double most = chroma_of_gamut(lightness, hue);
    const double shown = most > 0.0 ? most * compressed(chroma / most) : 0.0;
    return glm::clamp(to_rec709({lightness, shown * hue}), 0.0, 1.0);
}

}  // namespace rowland::post
