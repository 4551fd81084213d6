#include "engine/post/computed_views.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "engine/colour/oklab.h"
#include "engine/core/parallel.h"
#include "engine/post/agx.h"
#include "engine/post/constant_hue.h"
#include "engine/post/false_colour.h"

namespace OCIO = OCIO_NAMESPACE;

namespace rowland::post {

namespace {

constexpr const char* kDisplay = "sRGB - Display";
constexpr unsigned kCurveLength = 4096;

/// The axes of the table of cone responses (l, m, s) in stops: log2 m, from 10 stops below 0.18 to where all is white;
/// log2 l / m and log2 s / m, as far as spectral light reaches. Neutrals lie on the table's entries.
constexpr unsigned kTableEdge = 37;
constexpr glm::dvec3 kLeastStops(-12.5, -3.0, -2.0);
constexpr glm::dvec3 kMostStops(7.0, 1.5, 4.0);
const double kDarkest = std::exp2(kLeastStops.x);  // added to responses, so that black has a logarithm

OCIO::TransformRcPtr known(const char* style, OCIO::TransformDirection direction = OCIO::TRANSFORM_DIR_FORWARD) {
    const OCIO::BuiltinTransformRcPtr transform = OCIO::BuiltinTransform::Create();
    transform->setStyle(style);
    transform->setDirection(direction);
    return transform;
}

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

/// log2 of (l, m, s) → the table's axes, 0 … 1.
OCIO::TransformRcPtr table_axes() {
    const glm::dvec3 scale = 1.0 / (kMostStops - kLeastStops);
    const glm::dmat3 differences = glm::transpose(glm::dmat3(0, 1, 0, 1, -1, 0, 0, -1, 1));
    const glm::dmat3 scaled(scale * differences[0], scale * differences[1], scale * differences[2]);
    return matrix_transform(scaled, -kLeastStops * scale);
}

/// A table of `value` over 0 … 1; its components are those of three equal inputs.
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

/// What constant_hue() shows at a point of the table, as cube roots of linear Rec.709, which are smoother.
glm::vec3 table_entry(std::size_t i, std::size_t j, std::size_t k) {
    const glm::dvec3 stops = glm::mix(kLeastStops, kMostStops, glm::dvec3(i, j, k) / (kTableEdge - 1.0));
    const glm::dvec3 lms = glm::exp2(glm::dvec3(stops.x + stops.y, stops.x, stops.x + stops.z)) - kDarkest;
    const glm::dvec3 rgb = constant_hue(lms);
    return {std::cbrt(rgb.r), std::cbrt(rgb.g), std::cbrt(rgb.b)};
}

OCIO::TransformRcPtr constant_hue_table() {
    static const std::vector<glm::vec3> values = [] {
        std::vector<glm::vec3> found(std::size_t{kTableEdge} * kTableEdge * kTableEdge);
        parallel_for(found.size() / kTableEdge, [&](std::size_t line) {
            for (std::size_t k = 0; k < kTableEdge; ++k)
                found[line * kTableEdge + k] = table_entry(line / kTableEdge, line % kTableEdge, k);
        });
        return found;
    }();
    const OCIO::Lut3DTransformRcPtr table = OCIO::Lut3DTransform::Create(kTableEdge);
    table->setInterpolation(OCIO::INTERP_TETRAHEDRAL);
    std::size_t index = 0;
    for (unsigned i = 0; i < kTableEdge; ++i)
        for (unsigned j = 0; j < kTableEdge; ++j)
            for (unsigned k = 0; k < kTableEdge; ++k, ++index)
                table->setValue(i, j, k, values[index].r, values[index].g, values[index].b);
    return table;
}

std::vector<OCIO::TransformRcPtr> constant_hue_view() {
    return {matrix_transform(colour::rec709_to_oklab_lms()), logarithm(0.0, 1.0, kDarkest), table_axes(),
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

/// Adds a view of the steps from linear Rec.709 in the scene to linear Rec.709 on the display.
void add_view(OCIO::Config& config, const char* name, const std::vector<OCIO::TransformRcPtr>& steps,
              const char* looks = "") {
    const OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
    group->appendTransform(known("ACEScg_to_ACES2065-1", OCIO::TRANSFORM_DIR_INVERSE));
    group->appendTransform(known("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD"));
    for (const OCIO::TransformRcPtr& step : steps) group->appendTransform(step);
    group->appendTransform(known("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", OCIO::TRANSFORM_DIR_INVERSE));
    group->appendTransform(known("UTILITY - ACES-AP1_to_CIE-XYZ-D65_BFD"));

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
