#include "editor/inspector/groove_picture.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/core/check.h"
#include "engine/image/byte_image.h"
#include "engine/image/png.h"
#include "engine/scene/texture_recipe.h"

namespace rowland::inspector {

namespace {

using scene::ChannelRecipe;
using scene::LayerRecipe;

constexpr std::uint8_t kOwnPitch = 128;  ///< G where the pitch is the material's, of 255
constexpr int kSize = 512;               ///< texels

/// Paints R; G is the material's own pitch.
LayerRecipe layer_of(LayerRecipe::Pattern pattern, const ChannelRecipe& rotation) {
    LayerRecipe layer;
    layer.pattern = pattern;
    layer.channels[0] = rotation;
    layer.channels[1] = ChannelRecipe{.from = kOwnPitch / 255.0, .to = kOwnPitch / 255.0};
    return layer;
}

constexpr ChannelRecipe kOfCell{.from = 0.0, .to = 1.0, .by = ChannelRecipe::By::Cell};
/// Grooves have no sense of direction, so the rotation runs from 0 to π twice around the middle.
constexpr ChannelRecipe kOutward{.from = 0.0, .to = 1.0, .by = ChannelRecipe::By::Angle, .repeat = 2.0};

scene::TextureRecipe hexagons() {
    // Two rows of hexagons are √3 widths high, so the picture repeats without a seam if it is that often as high.
    constexpr double kWidth = 1.0 / (4.0 * std::numbers::sqrt3);
    constexpr int kAcross = 7;
    LayerRecipe layer = layer_of(LayerRecipe::Pattern::Hexagons, kOfCell);
    layer.size = glm::dvec2(kWidth, 0.0);
    return {.width = static_cast<int>(std::lround(kAcross * kWidth * kSize)), .height = kSize, .layers = {layer}};
}

scene::TextureRecipe tiles() {
    LayerRecipe layer = layer_of(LayerRecipe::Pattern::Tiles, kOfCell);
    layer.size = glm::dvec2(0.125);
    return {.width = kSize, .height = kSize, .layers = {layer}};
}

LayerRecipe rosette(const glm::dvec2& centre, double radius, int petals) {
    LayerRecipe layer = layer_of(LayerRecipe::Pattern::Rosette, kOutward);
    layer.centre = centre;
    layer.radius = radius;
    layer.petals = petals;
    layer.rings = 6;
    layer.gap = 0.2;
    return layer;
}

scene::TextureRecipe rosettes() {
    return {
        .width = kSize,
        .height = kSize,
        .layers = {layer_of(LayerRecipe::Pattern::All, {}), rosette({0.5, 0.5}, 0.3, 8), rosette({0.15, 0.15}, 0.14, 5),
                   rosette({0.85, 0.15}, 0.14, 5), rosette({0.15, 0.85}, 0.14, 5), rosette({0.85, 0.85}, 0.14, 5)}};
}

scene::TextureRecipe radial() {
    return {.width = kSize, .height = kSize, .layers = {layer_of(LayerRecipe::Pattern::All, kOutward)}};
}

scene::TextureRecipe recipe_of(std::string_view name) {
    if (name == "hexagons") return hexagons();
    if (name == "tiles") return tiles();
    if (name == "rosettes") return rosettes();
    ROWLAND_CHECK(name == "radial", "no such foil pattern");
    return radial();
}

}  // namespace

std::vector<std::byte> foil_pattern(std::string_view name) {
    const scene::TextureRecipe recipe = recipe_of(name);
    const scene::PaintedTexture painted = scene::paint(recipe);
    return image::encode_png(recipe.width, recipe.height, painted.channels, painted.texels);
}

std::vector<std::byte> as_groove_picture(std::vector<std::byte> picture, const std::string& name) {
    image::ByteImage image = image::decode_byte_image(picture, name);
    std::vector<std::uint8_t> rgb;
    rgb.reserve(image.rgba.size() / 4 * 3);
    bool grooves = true;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        grooves = grooves && image.rgba[i + 2] == 0;
        const double luma = 0.2126 * image.rgba[i] + 0.7152 * image.rgba[i + 1] + 0.0722 * image.rgba[i + 2];
        const bool opaque = image.rgba[i + 3] >= 128;
        rgb.insert(rgb.end(), {static_cast<std::uint8_t>(std::lround(luma)), opaque ? kOwnPitch : std::uint8_t{0}, 0});
    }
    return grooves ? std::move(picture) : image::encode_png(image.width, image.height, 3, rgb);
}

}  // namespace rowland::inspector
