#include "editor/inspector/groove_texture.h"

#include <cmath>
#include <cstdint>

#include "engine/core/check.h"
#include "engine/image/byte_image.h"
#include "modules/diffraction/foil/card.h"

namespace rowland::inspector {

namespace foil = diffraction::foil;

std::vector<std::byte> foil_pattern(std::string_view name) {
    // Eight tiles of the default size across, for a surface of any size.
    constexpr foil::Area kArea{.width_px = 512, .height_px = 512, .width_mm = 40.0, .repeats = true};
    foil::Foil drawn;
    const std::optional<foil::FoilType> type = foil::foil_type(name);
    ROWLAND_CHECK(type.has_value(), "no such foil pattern");
    drawn.type = *type;
    if (auto* radial = std::get_if<foil::Radial>(&drawn.type)) radial->circles = true;
    return foil::groove_texture(drawn, kArea);
}

std::vector<std::byte> as_groove_texture(std::vector<std::byte> picture, const std::string& name) {
    constexpr std::uint16_t kOwnPitch = 32768;  // G where the pitch is the material's, of 65535
    image::ByteImage image = image::decode_byte_image(picture, name, image::Depth::OfFile);
    std::vector<std::uint16_t> rgb;
    rgb.reserve(image.rgba.size() / 4 * 3);
    bool is_groove_texture = true;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        is_groove_texture = is_groove_texture && image.rgba[i + 2] == 0;
        const double luma = 0.2126 * image.value(i) + 0.7152 * image.value(i + 1) + 0.0722 * image.value(i + 2);
        const bool opaque = image.rgba[i + 3] >= 128;
        rgb.insert(rgb.end(),
                   {static_cast<std::uint16_t>(std::lround(65535.0 * luma)), opaque ? kOwnPitch : std::uint16_t{0}, 0});
    }
    return is_groove_texture ? std::move(picture) : image::encode_png(image.width, image.height, 3, rgb);
}

}  // namespace rowland::inspector
