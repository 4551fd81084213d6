// Foil cards: modules/diffraction/foil, for pictures that the page has decoded and encodes.
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "content/web/bake/exports.h"
#include "engine/core/error.h"
#include "modules/diffraction/foil/card_textures.h"
#include "modules/diffraction/foil/thumbnail.h"

namespace rowland {

// These are never called: pictures come decoded, and leave as texels.
namespace image {

ByteImageSize byte_image_size(std::span<const std::byte>, const std::string&) {
    return {};
}

ByteImage decode_byte_image(std::span<const std::byte>, const std::string&, Depth) {
    return {};
}

bool is_jpeg(std::span<const std::byte>) {
    return false;
}

}  // namespace image

namespace web {

using namespace diffraction;

/// A card in the making.
struct Card {
    foil::NamedPictures pictures;
    foil::Recipe recipe;
    foil::CardTexels texels;
    foil::CardTextures textures;
    std::vector<std::byte> file;
    std::vector<std::uint8_t> thumbnail;
};

ROWLAND_EXPORT(make_room) Card* make_room() {
    return new Card;
}

/// A picture for recipes that name it: straight RGBA, row 0 at the top. `rgba` was got from room() and is released.
ROWLAND_EXPORT(set_picture)
void set_picture(Card* card, const char* name, std::size_t size, int width, int height, std::uint8_t* rgba) {
    const std::string key(name, size);
    const std::span<const std::uint8_t> texels(rgba, 4 * static_cast<std::size_t>(width * height));
    card->pictures[key] = {key, {}, {width, height, {texels.begin(), texels.end()}}};
    std::free(rgba);
}

namespace {

constexpr const char* kName = "recipe";

/// Throws Error for a picture that the card lacks.
foil::Recipe recipe_of(const Card& card, const char* json, std::size_t size) {
    foil::Recipe recipe = foil::parse_foil_recipe(nlohmann::json::parse(std::string_view(json, size)), kName);
    for (const std::string& picture : foil::picture_names(recipe))
        if (!card.pictures.contains(picture))
            refuse_input(picture, "", "no such picture", "one that the page has", "choose it again");
    return recipe;
}

Numbers* size_of(int width, int height) {
    return new Numbers{static_cast<float>(width), static_cast<float>(height)};
}

}  // namespace

/// Draws the card of a recipe's JSON: width and height of its texels.
ROWLAND_EXPORT(draw_card) Numbers* draw_card(Card* card, const char* json, std::size_t size) {
    card->recipe = recipe_of(*card, json, size);
    card->textures = {};
    card->texels = foil::card_texels(card->recipe, card->pictures, kName);
    return size_of(card->texels.area.width_px, card->texels.area.height_px);
}

/// Draws the thumbnail of a recipe's JSON: its width and height.
ROWLAND_EXPORT(draw_thumbnail)
Numbers* draw_thumbnail(Card* card, const char* json, std::size_t size, int height) {
    const foil::Thumbnail thumbnail(recipe_of(*card, json, size), card->pictures, kName, height);
    card->thumbnail.resize(std::size_t{4} * static_cast<std::size_t>(thumbnail.width()) *
                           static_cast<std::size_t>(thumbnail.height()));
    thumbnail.draw(glm::mat3(1.0F), card->thumbnail);
    return size_of(thumbnail.width(), thumbnail.height());
}

namespace {

/// The texels of a texture: base colour, metallic and roughness, grooves, back; after these the file and the thumbnail.
std::span<const std::byte> part_of(const Card& card, int part) {
    const std::array<std::span<const std::byte>, 6> parts = {
        std::as_bytes(std::span(card.texels.base_colour)), std::as_bytes(std::span(card.texels.metallic_roughness)),
        std::as_bytes(std::span(card.texels.grooves)), std::as_bytes(std::span(card.texels.back)),
        std::span<const std::byte>(card.file), std::as_bytes(std::span(card.thumbnail))};
    return parts.at(static_cast<std::size_t>(part));
}

}  // namespace

ROWLAND_EXPORT(part_begin) const std::byte* part_begin(const Card* card, int part) {
    return part_of(*card, part).data();
}

ROWLAND_EXPORT(part_size) std::size_t part_size(const Card* card, int part) {
    return part_of(*card, part).size();
}

/// The PNG of a texture, by its number in part_of().
ROWLAND_EXPORT(set_texture) void set_texture(Card* card, int part, std::byte* png, std::size_t size) {
    foil::CardTextures& to = card->textures;
    const std::array<std::vector<std::byte>*, 4> textures = {&to.base_colour, &to.metallic_roughness, &to.grooves,
                                                             &to.back};
    textures.at(static_cast<std::size_t>(part))->assign(png, png + size);
    std::free(png);
}

/// Makes the file of the card that was drawn last, of the textures given since.
ROWLAND_EXPORT(finish_card) void finish_card(Card* card) {
    card->file = foil::card_file(card->recipe, card->texels, std::move(card->textures), kName);
    card->textures = {};
}

}  // namespace web

}  // namespace rowland
