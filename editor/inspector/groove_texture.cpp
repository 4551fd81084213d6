#include "editor/inspector/groove_texture.h"

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "engine/core/check.h"
#include "engine/image/byte_image.h"

namespace rowland::inspector {

namespace {

constexpr std::uint8_t kOwnPitch = 128;  ///< G where the pitch is the material's, of 255
constexpr int kSize = 512;               ///< texels of a pattern's height

double fraction(double x) {
    return x - std::floor(x);
}

/// The groove rotation / π of cell (i, j), evenly spread over [0, 1) for neighbouring cells (the R2 sequence: Roberts,
/// The Unreasonable Effectiveness of Quasirandom Sequences, 2018).
double rotation_of_cell(double i, double j) {
    return fraction(0.5 + i * 0.7548776662466927 + j * 0.5698402909980532);
}

/// Angle of a direction / 2π.
double angle_of(const glm::dvec2& direction) {
    return fraction(std::atan2(direction.y, direction.x) / (2.0 * std::numbers::pi));
}

/// Grating vectors that point away from a centre, as a rotation / π: grooves have no sense of direction, so it runs
/// from 0 to 1 twice around the centre.
double outward(const glm::dvec2& from_centre) {
    return fraction(2.0 * angle_of(from_centre));
}

// The width of a hexagon. Two rows of hexagons are √3 widths high, so eight rows fill the picture's height. The
// rotations repeat with the picture, so that it has no seam.
constexpr double kHexagon = 1.0 / (4.0 * std::numbers::sqrt3);
constexpr int kHexagonsAcross = 7;
constexpr int kHexagonRows = 8;

/// The remainder of a whole number, from 0 to `period` - 1.
double modulo(double number, int period) {
    return number - period * std::floor(number / period);
}

/// The rotation of the hexagon whose centre is nearest. Each has a corner at its top and one at its bottom.
double hexagon_rotation(const glm::dvec2& at) {
    const double row_height = kHexagon * std::sqrt(3.0) / 2.0;
    glm::dvec2 index(0.0);
    double least = std::numeric_limits<double>::max();
    for (const double row : {std::floor(at.y / row_height), std::floor(at.y / row_height) + 1.0}) {
        const double shift = fraction(row / 2.0);
        const double column = std::round(at.x / kHexagon - shift);
        const double distance = glm::length(at - glm::dvec2((column + shift) * kHexagon, row * row_height));
        if (distance >= least) continue;
        least = distance;
        index = {column, row};
    }
    return rotation_of_cell(modulo(index.x, kHexagonsAcross), modulo(index.y, kHexagonRows));
}

double tile_rotation(const glm::dvec2& at) {
    const glm::dvec2 index = glm::floor(at / 0.125);
    return rotation_of_cell(index.x, index.y);
}

/// Flowers of six rings with gaps between them; outside of them rotation 0.
double rosette_rotation(const glm::dvec2& at) {
    struct Flower {
        glm::dvec2 centre;
        double radius;  ///< out to the petals' tips
        int petals;
    };
    constexpr double kNotch = 0.3;  ///< depth between petals, as a fraction of the radius
    constexpr int kRings = 6;
    constexpr double kGap = 0.2;  ///< fraction of a ring's width
    double rotation = 0.0;
    for (const Flower& flower :
         {Flower{{0.5, 0.5}, 0.3, 8}, Flower{{0.15, 0.15}, 0.14, 5}, Flower{{0.85, 0.15}, 0.14, 5},
          Flower{{0.15, 0.85}, 0.14, 5}, Flower{{0.85, 0.85}, 0.14, 5}}) {
        const glm::dvec2 from_centre = at - flower.centre;
        const double petal_phase = 2.0 * std::numbers::pi * flower.petals * angle_of(from_centre);
        const double edge = flower.radius * (1.0 - kNotch * 0.5 * (1.0 - std::cos(petal_phase)));
        const double radius = glm::length(from_centre) / edge;
        if (radius >= 1.0 || fraction(radius * kRings) > 1.0 - kGap) continue;
        rotation = outward(from_centre);
    }
    return rotation;
}

double radial_rotation(const glm::dvec2& at) {
    return outward(at - 0.5);
}

struct FoilPattern {
    /// The rotation / π at a point from the lower left corner, in units of the picture's height.
    double (*rotation)(const glm::dvec2& at);
    int width = kSize;  ///< texels
};

FoilPattern pattern_of(std::string_view name) {
    if (name == "hexagons")
        return {hexagon_rotation, static_cast<int>(std::lround(kHexagonsAcross * kHexagon * kSize))};
    if (name == "tiles") return {tile_rotation};
    if (name == "rosettes") return {rosette_rotation};
    ROWLAND_CHECK(name == "radial", "no such foil pattern");
    return {radial_rotation};
}

}  // namespace

std::vector<std::byte> foil_pattern(std::string_view name) {
    const FoilPattern pattern = pattern_of(name);
    std::vector<std::uint8_t> rgb;
    for (int row = 0; row < kSize; ++row)
        for (int column = 0; column < pattern.width; ++column) {
            const glm::dvec2 at((column + 0.5) / kSize, 1.0 - (row + 0.5) / kSize);
            rgb.insert(rgb.end(), {static_cast<std::uint8_t>(std::lround(255.0 * pattern.rotation(at))), kOwnPitch, 0});
        }
    return image::encode_png(pattern.width, kSize, 3, rgb);
}

std::vector<std::byte> as_groove_texture(std::vector<std::byte> picture, const std::string& name) {
    image::ByteImage image = image::decode_byte_image(picture, name);
    std::vector<std::uint8_t> rgb;
    rgb.reserve(image.rgba.size() / 4 * 3);
    bool is_groove_texture = true;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        is_groove_texture = is_groove_texture && image.rgba[i + 2] == 0;
        const double luma = 0.2126 * image.rgba[i] + 0.7152 * image.rgba[i + 1] + 0.0722 * image.rgba[i + 2];
        const bool opaque = image.rgba[i + 3] >= 128;
        rgb.insert(rgb.end(), {static_cast<std::uint8_t>(std::lround(luma)), opaque ? kOwnPitch : std::uint8_t{0}, 0});
    }
    return is_groove_texture ? std::move(picture) : image::encode_png(image.width, image.height, 3, rgb);
}

}  // namespace rowland::inspector
