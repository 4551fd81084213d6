#include "modules/diffraction/foil/card_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/foil/raster.h"

namespace rowland::diffraction::foil {

namespace {

constexpr int kLeastSide_px = 16;
constexpr int kMostSide_px = 8192;

constexpr double kInkRoughness = 0.5;
constexpr double kPaperRoughness = 0.6;
constexpr double kMetalRoughness = 0.28;
constexpr std::array<double, 3> kPaper = {244.0, 243.0, 239.0};  ///< sRGB
constexpr std::array<double, 3> kMetal = {245.0, 245.0, 246.0};  ///< of aluminium's reflectance

image::ByteImage decoded(const NamedPicture& picture) {
    const bool is_file = !picture.bytes.empty();
    const image::ByteImageSize size = is_file ? image::byte_image_size(picture.bytes, picture.file)
                                              : image::ByteImageSize{picture.decoded.width, picture.decoded.height};
    const std::string found = fmt::format("{} x {} texels", size.width, size.height);
    if (std::min(size.width, size.height) < kLeastSide_px)
        refuse_input(picture.file, "", found, fmt::format("at least {0} x {0}", kLeastSide_px),
                     "take a larger picture");
    if (std::max(size.width, size.height) > kMostSide_px)
        refuse_input(picture.file, "", found, fmt::format("at most {0} x {0}", kMostSide_px), "scale the picture down");
    return is_file ? image::decode_byte_image(picture.bytes, picture.file) : picture.decoded;
}

Area card_area(const Recipe& recipe) {
    const double longer = std::max(recipe.card.width_mm, recipe.card.height_mm);
    const auto texels = [&](double side_mm) {
        return std::max(1, static_cast<int>(std::lround(recipe.texture_px * side_mm / longer)));
    };
    return {.width_px = texels(recipe.card.width_mm),
            .height_px = texels(recipe.card.height_mm),
            .width_mm = recipe.card.width_mm};
}

constexpr std::uint8_t kCovers = 128;  ///< the least alpha of ink that covers the foil
constexpr std::uint8_t kOpaque = 255;

bool has_alpha_below(std::uint8_t limit, const image::ByteImage& picture) {
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
        if (picture.rgba[i] < limit) return true;
    return false;
}

FoilLayers layers_of(const Recipe& recipe, const image::ByteImage& artwork) {
    FoilLayers layers;
    layers.ink = recipe.ink.value_or(has_alpha_below(kCovers, artwork) ? Ink::Covers : Ink::LetsThrough);
    layers.under = recipe.under.value_or(layers.ink == Ink::Covers ? Under::Metal : Under::Paper);
    layers.lacquer = recipe.lacquer;
    return layers;
}

/// The artwork, and how much of each texel is foil, 0 to 255, before ink.
struct Fronts {
    image::ByteImage artwork;
    std::vector<std::uint8_t> mask;  ///< empty: everywhere
};

std::vector<std::uint8_t> mask_of(const Recipe& recipe, const NamedPictures& pictures,
                                  const image::ByteImageSize& artwork, const Area& area) {
    if (recipe.mask.empty()) return {};
    const NamedPicture& named = pictures.at(recipe.mask);
    const image::ByteImage mask = decoded(named);
    // A mask of another size is scaled; one of other proportions would lie beside what it is for.
    const double ratio =
        static_cast<double>(mask.width) * artwork.height / (static_cast<double>(mask.height) * artwork.width);
    if (std::abs(std::log(ratio)) > 0.02)
        refuse_input(named.file, "", fmt::format("a mask of {} x {} texels", mask.width, mask.height),
                     fmt::format("the proportions of the artwork, which has {} x {}", artwork.width, artwork.height),
                     "export both from the same page");
    const image::ByteImage filled = fill_card(mask, area.width_px, area.height_px);
    std::vector<std::uint8_t> values(filled.rgba.size() / 4);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::uint8_t* texel = &filled.rgba[4 * i];
        values[i] =
            static_cast<std::uint8_t>((54U * texel[0] + 183U * texel[1] + 19U * texel[2]) * texel[3] / (256U * 255U));
    }
    return values;
}

/// The layer under the grooves at a texel.
struct LayerTexel {
    std::array<double, 3> colour{};  ///< sRGB, 0 to 255
    double metallic = 0.0;
    double roughness = 0.0;
};

double mixed(double a, double b, double fraction) {
    return a + (b - a) * fraction;
}

class Composition {
 public:
    Composition(const FoilLayers& layers, const Fronts& fronts) : layers_(layers), fronts_(fronts) {
        for (std::size_t c = 0; c < 3; ++c) {
            // Light passes the dye twice.
            const double passed = std::pow(layers.lacquer.tint[static_cast<int>(c)], 2.0 / 2.2);
            metal_[c] = kMetal[c] * passed;
        }
    }

    double foil(std::size_t texel) const { return fronts_.mask.empty() ? 1.0 : fronts_.mask[texel] / 255.0; }

    bool is_covered(std::size_t texel) const {
        return layers_.ink == Ink::Covers && fronts_.artwork.rgba[4 * texel + 3] >= kCovers;
    }
    bool shows_foil(std::size_t texel) const { return !is_covered(texel) && foil(texel) >= 0.5; }

    LayerTexel layer(std::size_t texel) const {
        const std::uint8_t* art = &fronts_.artwork.rgba[4 * texel];
        // A texel has grooves or none: metal without them would shine along the edges of the ink.
        const double opacity = is_covered(texel) ? 1.0 : art[3] / 255.0;
        const double metal = layers_.under == Under::Metal ? foil(texel) : 0.0;
        LayerTexel result;
        for (std::size_t c = 0; c < 3; ++c)
            result.colour[c] = mixed(mixed(kPaper[c], metal_[c], metal), art[c], opacity);
        // Ink that lets light through takes the gloss of what it lies on.
        const double inked = layers_.ink == Ink::Covers ? opacity : opacity * (1.0 - metal);
        result.metallic = metal * (layers_.ink == Ink::Covers ? 1.0 - opacity : 1.0);
        result.roughness = mixed(mixed(kPaperRoughness, kMetalRoughness, metal), kInkRoughness, inked);
        return result;
    }

 private:
    FoilLayers layers_;
    const Fronts& fronts_;
    std::array<double, 3> metal_{};
};

std::uint8_t byte_of(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

struct FrontTexels {
    std::vector<std::uint8_t> colour;              ///< RGB
    std::vector<std::uint8_t> metallic_roughness;  ///< RGB: none, roughness, metallic
    std::vector<std::uint8_t> has_foil;            ///< 0 or 1
};

FrontTexels front_texels(const Composition& composition, const Area& area) {
    const auto width = static_cast<std::size_t>(area.width_px);
    const std::size_t count = width * static_cast<std::size_t>(area.height_px);
    FrontTexels texels{std::vector<std::uint8_t>(3 * count), std::vector<std::uint8_t>(3 * count),
                       std::vector<std::uint8_t>(count)};
    parallel_for(static_cast<std::size_t>(area.height_px), [&](std::size_t row) {
        for (std::size_t texel = row * width; texel < (row + 1) * width; ++texel) {
            const LayerTexel layer = composition.layer(texel);
            for (std::size_t c = 0; c < 3; ++c) texels.colour[3 * texel + c] = byte_of(layer.colour[c]);
            texels.metallic_roughness[3 * texel + 1] = byte_of(255.0 * layer.roughness);
            texels.metallic_roughness[3 * texel + 2] = byte_of(255.0 * layer.metallic);
            texels.has_foil[texel] = composition.shows_foil(texel) ? 1 : 0;
        }
    });
    return texels;
}

bool are_equal_texels(const std::vector<std::uint8_t>& rgb) {
    return std::equal(rgb.begin() + 3, rgb.end(), rgb.begin());
}

void check_foil_is_seen(const Recipe& recipe, const NamedPictures& pictures, const FoilLayers& layers,
                        const std::vector<std::uint8_t>& has_foil) {
    if (std::find(has_foil.begin(), has_foil.end(), 1) != has_foil.end()) return;
    if (layers.ink == Ink::Covers)
        refuse_input(pictures.at(recipe.artwork).file, "", "ink over all of the foil",
                     "an artwork with transparent parts, where the foil shows",
                     "erase the artwork there, or say \"ink\": \"lets_through\"");
    refuse_input(pictures.at(recipe.mask).file, "", "a mask that is black everywhere", "white where there is foil",
                 "leave \"mask\" out for foil everywhere");
}

std::vector<Brightness> foil_pictures(const Recipe& recipe, const NamedPictures& pictures, const Area& area) {
    std::vector<std::string> names;
    if (const auto* two = std::get_if<TwoPictures>(&recipe.foil.type)) names = two->pictures;
    if (const auto* own = std::get_if<Own>(&recipe.foil.type)) names = {own->drawing};
    std::vector<Brightness> all;
    for (const std::string& name : names)
        all.push_back(brightness_of(fill_card(decoded(pictures.at(name)), area.width_px, area.height_px)));
    return all;
}

/// Whether the file's own bytes do as the texture of a card.
bool serves_as_it_is(const Recipe& recipe, const NamedPicture& named, const image::ByteImage& picture,
                     const Area& area) {
    return !named.bytes.empty() && !has_alpha_below(kOpaque, picture) &&
           std::max(picture.width, picture.height) <= recipe.texture_px &&
           has_proportions({picture.width, picture.height}, area.width_px, area.height_px);
}

std::vector<std::uint8_t> back_texels(const Recipe& recipe, const NamedPicture& named, const Area& area) {
    const image::ByteImage back = decoded(named);
    if (serves_as_it_is(recipe, named, back, area)) return {};
    const image::ByteImage filled = fill_card(back, area.width_px, area.height_px);
    std::vector<std::uint8_t> rgb(filled.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const std::uint8_t* texel = &filled.rgba[i / 3 * 4];
        rgb[i] = byte_of(mixed(kPaper[i % 3], texel[i % 3], texel[3] / 255.0));
    }
    return rgb;
}

}  // namespace

CardTexels card_texels(const Recipe& recipe, const NamedPictures& pictures, const std::string& file,
                       const OnStep& on_step) {
    const auto step = [&] {
        if (on_step) on_step();
    };
    const Area area = card_area(recipe);
    const NamedPicture& named = pictures.at(recipe.artwork);
    const image::ByteImage artwork = decoded(named);
    CardTexels result{.area = area, .layers = layers_of(recipe, artwork)};
    if (!result.layers.lacquer.gloss && result.layers.lacquer.tint != glm::dvec3(1.0))
        refuse_input(file, "/lacquer/tint", "a tint without a lacquer", "\"gloss\": true", "or leave the tint out");
    Fronts fronts;
    fronts.mask = mask_of(recipe, pictures, {artwork.width, artwork.height}, area);
    const bool as_it_is = serves_as_it_is(recipe, named, artwork, area);
    fronts.artwork = fill_card(artwork, area.width_px, area.height_px);
    step();
    const std::vector<Brightness> drawings = foil_pictures(recipe, pictures, area);
    FrontTexels texels = front_texels(Composition(result.layers, fronts), area);
    check_foil_is_seen(recipe, pictures, result.layers, texels.has_foil);
    step();
    const bool everywhere = std::find(texels.has_foil.begin(), texels.has_foil.end(), 0) == texels.has_foil.end();
    const bool needs_grooves = !everywhere || !foil_grating(recipe.foil).one_direction;
    const bool is_even = are_equal_texels(texels.metallic_roughness);
    result.roughness = is_even ? texels.metallic_roughness[1] / 255.0 : 1.0;
    result.metallic = is_even ? texels.metallic_roughness[2] / 255.0 : 1.0;
    if (needs_grooves) result.grooves = groove_texels(area, groove_field(recipe.foil, area, drawings), texels.has_foil);
    if (!as_it_is) result.base_colour = std::move(texels.colour);
    if (!is_even) result.metallic_roughness = std::move(texels.metallic_roughness);
    if (!recipe.card.back.empty()) result.back = back_texels(recipe, pictures.at(recipe.card.back), area);
    step();
    return result;
}

CardTextures card_textures(const CardTexels& texels, const Recipe& recipe, const NamedPictures& pictures,
                           const OnStep& on_step) {
    const auto png_of = [&](const auto& values) {
        if (values.empty()) return std::vector<std::byte>{};
        return image::encode_png(texels.area.width_px, texels.area.height_px, 3, std::span(values),
                                 image::PngEffort::Fast);
    };
    CardTextures textures;
    const std::array<std::function<void()>, 3> encodings = {
        [&] { textures.grooves = png_of(texels.grooves); },
        [&] {
            textures.base_colour =
                texels.base_colour.empty() ? pictures.at(recipe.artwork).bytes : png_of(texels.base_colour);
        },
        [&] { textures.metallic_roughness = png_of(texels.metallic_roughness); }};
    parallel_for(encodings.size(), [&](std::size_t i) {
        encodings.at(i)();
        if (on_step) on_step();
    });
    if (!recipe.card.back.empty())
        textures.back = texels.back.empty() ? pictures.at(recipe.card.back).bytes : png_of(texels.back);
    return textures;
}

}  // namespace rowland::diffraction::foil
