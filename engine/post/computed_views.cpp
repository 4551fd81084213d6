#include "engine/post/computed_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/colour/colour_space.h"
#include "engine/core/parallel.h"

namespace OCIO = OCIO_NAMESPACE;

namespace rowland::post {

namespace {

constexpr double kPivotIn = 10.0 / 16.5;
constexpr double kPivotOut = 0.5;
constexpr double kSlope = 2.0;

/// One half of the curve, measured from the pivot: slope kSlope at 0, end point (width, height).
double half_curve(double distance, double width, double height, double power) {
    const double scale =
        std::pow(std::pow(kSlope * width, -power) * (std::pow(kSlope * width / height, power) - 1.0), -1.0 / power);
    const double term = kSlope * distance / scale;
    return scale * term / std::pow(1.0 + std::pow(term, power), 1.0 / power);
}

}  // namespace

glm::dmat3 agx_inset() {
    return glm::transpose(glm::dmat3(0.842479062253094, 0.0784335999999992, 0.0792237451477643,  //
                                     0.0423282422610123, 0.878468636469772, 0.0791661274605434,  //
                                     0.0423756549057051, 0.0784336, 0.879142973793104));
}

double agx_curve(double x) {
    if (x < kPivotIn) return kPivotOut - half_curve(kPivotIn - x, kPivotIn, kPivotOut, 3.0);
    return kPivotOut + half_curve(x - kPivotIn, 1.0 - kPivotIn, 1.0 - kPivotOut, 3.25);
}

namespace {

constexpr double kContrast = 1.551;              ///< g of the tone curve
constexpr double kSemiSaturation = 0.6018;       ///< k of the tone curve: light^g of tone ½
constexpr double kChromaContrastExponent = 0.5;  ///< chroma is scaled by contrast to this power
constexpr double kCompressionThreshold = 0.65;   ///< fraction of the gamut's chroma up to which chroma is unchanged
constexpr double kCompressionPower = 1.6;
constexpr double kMaxChroma = 0.33;  ///< a little more than any colour of Rec.709 has

glm::dvec3 to_rec709(const glm::dvec3& oklab) {
    static const glm::dmat3 matrix = glm::inverse(colour::rec709_to_oklab_lms());
    return matrix * colour::oklab_to_lms(oklab);
}

bool is_inside(const glm::dvec3& rgb) {
    return std::min({rgb.r, rgb.g, rgb.b}) >= 0.0 && std::max({rgb.r, rgb.g, rgb.b}) <= 1.0;
}

/// Largest in-gamut Oklab chroma at this lightness and hue (a unit vector), by bisection.
double max_gamut_chroma(double lightness, const glm::dvec2& hue) {
    double inside = 0.0;
    double outside = kMaxChroma;
    for (int i = 0; i < 16; ++i) {
        const double chroma = 0.5 * (inside + outside);
        (is_inside(to_rec709({lightness, chroma * hue})) ? inside : outside) = chroma;
    }
    return inside;
}

/// The identity up to kCompressionThreshold, then smoothly toward 1.
double compressed(double ratio) {
    if (ratio <= kCompressionThreshold) return ratio;
    constexpr double room = 1.0 - kCompressionThreshold;
    const double x = (ratio - kCompressionThreshold) / room;
    return kCompressionThreshold + room * x / std::pow(1.0 + std::pow(x, kCompressionPower), 1.0 / kCompressionPower);
}

}  // namespace

double constant_hue_tone(double light) {
    const double power = std::pow(light, kContrast);
    return power / (power + kSemiSaturation);
}

glm::dvec3 constant_hue(const glm::dvec3& lms) {
    const glm::dvec3 oklab = colour::oklab_of_lms(glm::max(lms, 0.0));
    const double level = oklab.x * oklab.x * oklab.x;
    if (!(level > 0.0)) return glm::dvec3(0.0);
    const glm::dvec3 rgb = to_rec709(oklab);
    const double largest = std::max({rgb.r, rgb.g, rgb.b, level});
    const double light = level * std::pow(largest / level, 1.0 - constant_hue_tone(level));
    const double tone = constant_hue_tone(light);
    const double scale = std::cbrt(tone / light);
    const double lightness = scale * oklab.x;

    const glm::dvec2 a_b(oklab.y, oklab.z);
    const double length = glm::length(a_b);
    const glm::dvec2 hue = length > 0.0 ? a_b / length : glm::dvec2(1.0, 0.0);
    const double contrast = kContrast * (1.0 - tone);  // d log tone / d log light
    const double chroma = length * scale * std::pow(contrast, kChromaContrastExponent);
    const double largest_chroma = max_gamut_chroma(lightness, hue);
    const double shown = largest_chroma > 0.0 ? largest_chroma * compressed(chroma / largest_chroma) : 0.0;
    return glm::clamp(to_rec709({lightness, shown * hue}), 0.0, 1.0);
}

glm::dvec3 false_colour(double stops) {
    constexpr int kEnd = 6;
    constexpr std::array<glm::dvec3, 2 * kEnd + 1> kColours{{{0.0, 0.0, 0.0},
                                                             {0.05, 0.0, 0.12},
                                                             {0.12, 0.0, 0.4},
                                                             {0.0, 0.03, 0.7},
                                                             {0.0, 0.2, 0.6},
                                                             {0.0, 0.35, 0.4},
                                                             {0.18, 0.18, 0.18},
                                                             {0.02, 0.35, 0.05},
                                                             {0.25, 0.6, 0.02},
                                                             {0.9, 0.8, 0.02},
                                                             {1.0, 0.3, 0.0},
                                                             {0.8, 0.0, 0.0},
                                                             {1.0, 1.0, 1.0}}};
    const int stop = static_cast<int>(std::lround(std::clamp(stops, -1.0 * kEnd, 1.0 * kEnd)));
    return kColours[static_cast<std::size_t>(stop + kEnd)];
}

OCIO::TransformRcPtr builtin_transform(const char* style, OCIO::TransformDirection direction) {
    const OCIO::BuiltinTransformRcPtr transform = OCIO::BuiltinTransform::Create();
    transform->setStyle(style);
    transform->setDirection(direction);
    return transform;
}

namespace {

constexpr const char* kDisplay = "sRGB - Display";
constexpr unsigned kCurveLength = 4096;

/// The axes of the 3D LUT of cone responses (l, m, s) in stops: log2 m, from 10 stops below 0.18 to where every colour
/// is white; log2 l / m and log2 s / m, as far as spectral light reaches. Neutrals lie on grid points.
constexpr unsigned kGridSize = 37;
constexpr glm::dvec3 kMinStops(-12.5, -3.0, -2.0);
constexpr glm::dvec3 kMaxStops(7.0, 1.5, 4.0);
const double kLogOffset = std::exp2(kMinStops.x);  // added to responses, so that black has a logarithm

OCIO::TransformRcPtr matrix_transform(const glm::dmat3& matrix, const glm::dvec3& offset = glm::dvec3(0.0)) {
    std::array<double, 16> values{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            values[static_cast<std::size_t>(4 * row + column)] = glm::row(matrix, row)[column];
    values[15] = 1.0;
    const OCIO::MatrixTransformRcPtr transform = OCIO::MatrixTransform::Create();
    transform->setMatrix(values.data());
    const std::array<double, 4> offsets{offset.x, offset.y, offset.z, 0.0};
    transform->setOffset(offsets.data());
    return transform;
}

/// log2(light + offset) in `least` … `most` → 0 … 1.
OCIO::TransformRcPtr logarithm(double least, double most, double offset) {
    const double slope = 1.0 / (most - least);
    const double start = -least * slope;
    const OCIO::LogAffineTransformRcPtr transform = OCIO::LogAffineTransform::Create();
    transform->setBase(2.0);
    transform->setLogSideSlopeValue({slope, slope, slope});
    transform->setLogSideOffsetValue({start, start, start});
    transform->setLinSideOffsetValue({offset, offset, offset});
    return transform;
}

/// log2 of (l, m, s) → the 3D LUT's axes, 0 … 1.
OCIO::TransformRcPtr table_axes() {
    const glm::dvec3 scale = 1.0 / (kMaxStops - kMinStops);
    const glm::dmat3 differences = glm::transpose(glm::dmat3(0, 1, 0, 1, -1, 0, 0, -1, 1));
    const glm::dmat3 scaled(scale * differences[0], scale * differences[1], scale * differences[2]);
    return matrix_transform(scaled, -kMinStops * scale);
}

/// 1D LUT over x in 0 … 1: channel c of the input x becomes value(x)[c].
OCIO::TransformRcPtr curve_table(const std::function<glm::dvec3(double)>& value) {
    const OCIO::Lut1DTransformRcPtr table = OCIO::Lut1DTransform::Create(kCurveLength, false);
    table->setInterpolation(OCIO::INTERP_LINEAR);
    for (unsigned i = 0; i < kCurveLength; ++i) {
        const glm::vec3 colour(value(i / (kCurveLength - 1.0)));
        table->setValue(i, colour.r, colour.g, colour.b);
    }
    return table;
}

OCIO::TransformRcPtr power(double exponent) {
    const OCIO::ExponentTransformRcPtr transform = OCIO::ExponentTransform::Create();
    transform->setValue({exponent, exponent, exponent, 1.0});
    return transform;
}

/// Entry of the 3D LUT: constant_hue() as cube roots of linear Rec.709, which interpolate better.
glm::vec3 table_entry(std::size_t i, std::size_t j, std::size_t k) {
    const glm::dvec3 stops = glm::mix(kMinStops, kMaxStops, glm::dvec3(i, j, k) / (kGridSize - 1.0));
    const glm::dvec3 lms = glm::exp2(glm::dvec3(stops.x + stops.y, stops.x, stops.x + stops.z)) - kLogOffset;
    const glm::dvec3 rgb = constant_hue(lms);
    return {std::cbrt(rgb.r), std::cbrt(rgb.g), std::cbrt(rgb.b)};
}

OCIO::TransformRcPtr constant_hue_table() {
    static const std::vector<glm::vec3> values = [] {
        std::vector<glm::vec3> found(std::size_t{kGridSize} * kGridSize * kGridSize);
        parallel_for(found.size() / kGridSize, [&](std::size_t line) {
            for (std::size_t k = 0; k < kGridSize; ++k)
                found[line * kGridSize + k] = table_entry(line / kGridSize, line % kGridSize, k);
        });
        return found;
    }();
    const OCIO::Lut3DTransformRcPtr table = OCIO::Lut3DTransform::Create(kGridSize);
    table->setInterpolation(OCIO::INTERP_TETRAHEDRAL);
    std::size_t index = 0;
    for (unsigned i = 0; i < kGridSize; ++i)
        for (unsigned j = 0; j < kGridSize; ++j)
            for (unsigned k = 0; k < kGridSize; ++k, ++index)
                table->setValue(i, j, k, values[index].r, values[index].g, values[index].b);
    return table;
}

std::vector<OCIO::TransformRcPtr> constant_hue_view() {
    return {matrix_transform(colour::rec709_to_oklab_lms()), logarithm(0.0, 1.0, kLogOffset), table_axes(),
            constant_hue_table(), power(3.0)};
}

std::vector<OCIO::TransformRcPtr> agx_view() {
    const OCIO::RangeTransformRcPtr not_negative = OCIO::RangeTransform::Create();
    not_negative->setMinInValue(0.0);
    not_negative->setMinOutValue(0.0);
    return {not_negative,
            matrix_transform(agx_inset()),
            logarithm(agx_least_stop, agx_most_stop, 0.0),
            curve_table([](double x) { return glm::dvec3(agx_curve(x)); }),
            matrix_transform(glm::inverse(agx_inset())),
            power(agx_gamma)};
}

std::vector<OCIO::TransformRcPtr> false_colour_view() {
    const double grey = std::log2(0.18);
    const glm::dvec3 luminance(0.2126, 0.7152, 0.0722);
    return {matrix_transform(glm::transpose(glm::dmat3(luminance, luminance, luminance))),
            logarithm(grey - false_colour_stops, grey + false_colour_stops, 0.0),
            curve_table([](double x) { return false_colour((2.0 * x - 1.0) * false_colour_stops); })};
}

/// Adds a view that applies `steps` (scene-linear Rec.709 to display-linear Rec.709).
void add_view(OCIO::Config& config, const char* name, const std::vector<OCIO::TransformRcPtr>& steps,
              const char* looks = "") {
    const OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
    group->appendTransform(builtin_transform("ACEScg_to_ACES2065-1", OCIO::TRANSFORM_DIR_INVERSE));
    group->appendTransform(builtin_transform("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD"));
    for (const OCIO::TransformRcPtr& step : steps) group->appendTransform(step);
    group->appendTransform(builtin_transform("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", OCIO::TRANSFORM_DIR_INVERSE));
    group->appendTransform(builtin_transform("UTILITY - ACES-AP1_to_CIE-XYZ-D65_BFD"));

    const OCIO::ViewTransformRcPtr view = OCIO::ViewTransform::Create(OCIO::REFERENCE_SPACE_SCENE);
    view->setName(name);
    view->setTransform(group, OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE);
    config.addViewTransform(view);
    config.addSharedView(name, name, OCIO::OCIO_VIEW_USE_DISPLAY_NAME, looks, "", "");
    config.addDisplaySharedView(kDisplay, name);
}

}  // namespace

void add_computed_views(OCIO::Config& config) {
    add_view(config, "Constant Hue", constant_hue_view());
    add_view(config, "AgX", agx_view(), "ACES 1.3 Reference Gamut Compression");
    add_view(config, "False Colour", false_colour_view());
}

}  // namespace rowland::post
