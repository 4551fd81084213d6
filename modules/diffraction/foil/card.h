#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/byte_image.h"
#include "modules/diffraction/foil/pattern.h"
#include "modules/diffraction/foil/recipe.h"

namespace rowland::diffraction::foil {

/// A picture that a recipe names.
struct NamedPicture {
    std::string file;               ///< what messages call it
    std::vector<std::byte> bytes;   ///< a PNG or JPEG; empty: the caller has decoded the picture itself
    image::ByteImage decoded = {};  ///< then
};
/// By the names in the recipe.
using NamedPictures = std::map<std::string, NamedPicture>;

/// The names of the pictures that a recipe takes, each once.
std::vector<std::string> picture_names(const Recipe& recipe);

/// Called after each of kCardSteps parts of the work, from any thread.
using OnStep = std::function<void()>;
inline constexpr std::size_t kCardSteps = 6;

/// A card as a binary glTF file: front, back and edge, with their textures; the front is a grating
/// (ROWLAND_materials_diffraction). `pictures` holds what picture_names() lists. `file` is the recipe's, for messages.
/// The same recipe and pictures give the same bytes. Throws Error (input) for a picture that cannot be read or used,
/// and where no foil would be seen.
std::vector<std::byte> make_card(const Recipe& recipe, const NamedPictures& pictures, const std::string& file,
                                 const OnStep& on_step = {});

/// The groove texture of a foil alone, PNG of 16 bits: for any model. Types that need pictures are a contract
/// violation.
std::vector<std::byte> groove_texture(const Foil& foil, const Area& area);

}  // namespace rowland::diffraction::foil
