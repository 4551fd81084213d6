#include "engine/scene/texture_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/json_vector.h"
#include "engine/core/parallel.h"

namespace rowland::scene {

namespace {

constexpr int kLargestSide = 8192;
constexpr std::size_t kMostLayers = 32;
constexpr NumberRange kTextureLength{.minimum = 1e-4, .maximum = 1e4};
constexpr NumberRange kBelowOne{.minimum = 0.0, .maximum = 1.0, .maximum_open = true};

double fraction(double x) {
    return x - std::floor(x);
}

/// A point within a cell of a layer's pattern; each 0 … 1.
struct CellPoint {
    double cell;
    double radius;
    double angle;
};

/// Evenly spread over [0, 1) for neighbouring cells (the R2 sequence: Roberts, The Unreasonable Effectiveness of
/// Quasirandom Sequences, 2018).
double spread(double i, double j) {
    return fraction(0.5 + i * 0.7548776662466927 + j * 0.5698402909980532);
}

double turn_of(const glm::dvec2& from_centre) {
    return fraction(std::atan2(from_centre.y, from_centre.x) / (2.0 * std::numbers::pi));
}

std::optional<CellPoint> in_tiles(const LayerRecipe& layer, const glm::dvec2& at) {
    const glm::dvec2 index = glm::floor(at / layer.size);
    const glm::dvec2 offset = at / layer.size - index - 0.5;
    // The same gap on all sides, whatever the tile's proportions.
    const glm::dvec2 free = layer.gap * std::min(layer.size.x, layer.size.y) / layer.size;
    if (std::abs(offset.x) > 0.5 * (1.0 - free.x) || std::abs(offset.y) > 0.5 * (1.0 - free.y)) return std::nullopt;
    const glm::dvec2 from_centre = offset * layer.size;
    return CellPoint{spread(index.x, index.y),
                     std::min(1.0, glm::length(from_centre) / (0.5 * glm::length(layer.size))), turn_of(from_centre)};
}

std::optional<CellPoint> in_hexagons(const LayerRecipe& layer, const glm::dvec2& at) {
    const double width = layer.size.x;
    const double row_height = width * std::sqrt(3.0) / 2.0;
    // The nearest of the centres of the two rows around the point.
    glm::dvec2 nearest(0.0);
    glm::dvec2 index(0.0);
    double least = std::numeric_limits<double>::max();
    for (const double row : {std::floor(at.y / row_height), std::floor(at.y / row_height) + 1.0}) {
        const double shift = fraction(row / 2.0);
        const double column = std::round(at.x / width - shift);
        const glm::dvec2 from_centre = at - glm::dvec2((column + shift) * width, row * row_height);
        if (glm::length(from_centre) >= least) continue;
        least = glm::length(from_centre);
        nearest = from_centre;
        index = {column, row};
    }
    const glm::dvec2 across = glm::abs(nearest);
    const double to_flat = std::max(across.x, 0.5 * across.x + std::sqrt(0.75) * across.y);
    if (to_flat > 0.5 * width * (1.0 - layer.gap)) return std::nullopt;
    return CellPoint{spread(index.x, index.y), std::min(1.0, least * std::sqrt(3.0) / width), turn_of(nearest)};
}

std::optional<CellPoint> in_rosette(const LayerRecipe& layer, const glm::dvec2& at) {
    const glm::dvec2 from_centre = at - layer.centre;
    const double turn = turn_of(from_centre);
    double edge = layer.radius;
    if (layer.petals > 0)
        edge *= 1.0 - layer.petal_depth * 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * layer.petals * turn));
    const double radius = glm::length(from_centre) / edge;
    if (radius >= 1.0) return std::nullopt;
    const double ring = std::floor(radius * layer.rings);
    if (radius * layer.rings - ring > 1.0 - layer.gap) return std::nullopt;
    return CellPoint{spread(ring, 0.0), radius, turn};
}

std::optional<CellPoint> point_in(const LayerRecipe& layer, const glm::dvec2& at, double aspect) {
    switch (layer.pattern) {
        case LayerRecipe::Pattern::Tiles:
            return in_tiles(layer, at);
        case LayerRecipe::Pattern::Hexagons:
            return in_hexagons(layer, at);
        case LayerRecipe::Pattern::Rosette:
            return in_rosette(layer, at);
        case LayerRecipe::Pattern::All:
            break;
    }
    const glm::dvec2 middle(0.5 * aspect, 0.5);
    return CellPoint{0.5, std::min(1.0, glm::length(at - middle) / glm::length(middle)), turn_of(at - middle)};
}

double value(const ChannelRecipe& channel, const CellPoint& point, const glm::dvec2& at) {
    // In the order of By.
    const std::array<double, 5> coordinates = {point.cell, point.radius, point.angle, at.x, at.y};
    const double t = std::clamp(
        (coordinates[static_cast<std::size_t>(channel.by)] - channel.begin) / (channel.end - channel.begin), 0.0, 1.0);
    return std::lerp(channel.from, channel.to, channel.repeat == 1.0 ? t : fraction(t * channel.repeat));
}

std::array<std::uint8_t, 4> texel(const TextureRecipe& recipe, int column, int row) {
    const double aspect = static_cast<double>(recipe.width) / recipe.height;
    const glm::dvec2 at((column + 0.5) / recipe.width, 1.0 - (row + 0.5) / recipe.height);
    std::array<double, 4> painted = {0.0, 0.0, 0.0, 1.0};
    for (const LayerRecipe& layer : recipe.layers) {
        const std::optional<CellPoint> point = point_in(layer, {at.x * aspect, at.y}, aspect);
        if (!point) continue;
        for (std::size_t c = 0; c < painted.size(); ++c)
            if (layer.channels[c]) painted[c] = value(*layer.channels[c], *point, at);
    }
    std::array<std::uint8_t, 4> bytes;
    for (std::size_t c = 0; c < painted.size(); ++c)
        bytes[c] = static_cast<std::uint8_t>(std::lround(255.0 * painted[c]));
    return bytes;
}

ChannelRecipe parse_channel(JsonReader& layer, const std::string& key) {
    ChannelRecipe channel;
    if (!layer.raw(key).is_object()) {
        channel.from = channel.to = layer.number(key, kFraction);
        return channel;
    }
    JsonReader reader = layer.object(key);
    channel.from = reader.number("from", kFraction);
    channel.to = reader.number("to", kFraction);
    using By = ChannelRecipe::By;
    channel.by = reader.choice<By>(
        "by", {{"cell", By::Cell}, {"radius", By::Radius}, {"angle", By::Angle}, {"x", By::X}, {"y", By::Y}});
    const std::vector<double> over = reader.numbers_or("over", {0.0, 1.0}, kFraction);
    channel.begin = over[0];
    channel.end = over[1];
    if (!(channel.begin < channel.end))
        reader.fail("over/1", fmt::format("{}", over[1]), fmt::format("more than {}", over[0]));
    channel.repeat = reader.number_or("repeat", 1.0, {.minimum = 1e-3, .maximum = 1e4});
    reader.finish();
    return channel;
}

LayerRecipe parse_layer(JsonReader& reader) {
    using Pattern = LayerRecipe::Pattern;
    LayerRecipe layer;
    layer.pattern = reader.choice<Pattern>("pattern", {{"all", Pattern::All},
                                                       {"tiles", Pattern::Tiles},
                                                       {"hexagons", Pattern::Hexagons},
                                                       {"rosette", Pattern::Rosette}});
    if (layer.pattern == Pattern::Tiles) layer.size = read_vector<glm::dvec2>(reader, "size", kTextureLength);
    if (layer.pattern == Pattern::Hexagons) layer.size = glm::dvec2(reader.number("size", kTextureLength));
    if (layer.pattern == Pattern::Rosette) {
        layer.centre = read_vector<glm::dvec2>(reader, "centre", {.minimum = -1e4, .maximum = 1e4});
        layer.radius = reader.number("radius", kTextureLength);
        layer.petals = static_cast<int>(reader.integer_or("petals", 0, 0, 64));
        layer.petal_depth = reader.number_or("petal_depth", layer.petal_depth, kBelowOne);
        layer.rings = static_cast<int>(reader.integer_or("rings", 1, 1, 256));
    }
    if (layer.pattern != Pattern::All) layer.gap = reader.number_or("gap", 0.0, kBelowOne);
    constexpr std::array<const char*, 4> kKeys = {"r", "g", "b", "a"};
    for (std::size_t c = 0; c < kKeys.size(); ++c)
        if (reader.has(kKeys[c])) layer.channels[c] = parse_channel(reader, kKeys[c]);
    reader.finish();
    return layer;
}

}  // namespace

TextureRecipe parse_texture(JsonReader& reader) {
    TextureRecipe recipe;
    if (reader.has("picture")) {
        recipe.picture = reader.text("picture");
        if (recipe.picture.empty()) reader.fail("picture", "no name", "a PNG file");
        return recipe;
    }
    const std::vector<double> size = reader.numbers("size", 2, {.minimum = 1.0, .maximum = kLargestSide});
    for (std::size_t i = 0; i < 2; ++i)
        if (size[i] != std::floor(size[i]))
            reader.fail(fmt::format("size/{}", i), fmt::format("{}", size[i]), "a whole number of texels");
    recipe.width = static_cast<int>(size[0]);
    recipe.height = static_cast<int>(size[1]);
    std::vector<JsonReader> layers = reader.objects("layers");
    if (layers.size() > kMostLayers)
        reader.fail("layers", fmt::format("{} layers", layers.size()), fmt::format("at most {}", kMostLayers));
    for (JsonReader& layer : layers) recipe.layers.push_back(parse_layer(layer));
    return recipe;
}

PaintedTexture paint(const TextureRecipe& recipe) {
    PaintedTexture painted;
    const auto has_alpha = [](const LayerRecipe& layer) { return layer.channels[3].has_value(); };
    if (std::any_of(recipe.layers.begin(), recipe.layers.end(), has_alpha)) painted.channels = 4;
    const auto channels = static_cast<std::size_t>(painted.channels);
    const auto width = static_cast<std::size_t>(recipe.width);
    painted.texels.resize(width * static_cast<std::size_t>(recipe.height) * channels);
    parallel_for(static_cast<std::size_t>(recipe.height), [&](std::size_t row) {
        for (std::size_t column = 0; column < width; ++column) {
            const auto bytes = texel(recipe, static_cast<int>(column), static_cast<int>(row));
            std::copy_n(bytes.begin(), channels,
                        painted.texels.begin() + static_cast<std::ptrdiff_t>((row * width + column) * channels));
        }
    });
    return painted;
}

}  // namespace rowland::scene
