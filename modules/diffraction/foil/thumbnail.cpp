#include "modules/diffraction/foil/thumbnail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

#include "engine/colour/colour_space.h"
#include "engine/colour/spectrum.h"
#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/foil/card_textures.h"
#include "modules/diffraction/foil/raster.h"

namespace rowland::diffraction::foil {

namespace {

constexpr int kTexelsPerPixel = 2;  ///< along each side
constexpr int kHighestOrder = 3;
constexpr float kPathStep_nm = 4.0F;

// Distances as of a card in a hand.
constexpr float kEye_m = 0.35F;
constexpr float kLamp_m = 0.6F;
/// Directions to the lamps, from the eye's axes.
constexpr std::array kLamps = {glm::vec3(-0.5F, 0.24F, 0.83F), glm::vec3(0.08F, 0.58F, 0.81F),
                               glm::vec3(0.42F, 0.44F, 0.79F), glm::vec3(-0.2F, -0.5F, 0.84F)};

constexpr float kBrightness = 0.5F;  ///< of the first order of one lamp
constexpr float kSpread = 0.8F;      ///< of light that spreads freely along the grooves
constexpr float kSilver = 0.16F;     ///< of metal in a dim room
constexpr float kPrint = 0.6F;       ///< of paper and ink

/// Light of all orders that have a path difference, per order 1/m, in linear Rec.709.
const std::vector<glm::vec3>& colours_of_paths() {
    static const std::vector<glm::vec3> colours = [] {
        std::vector<glm::vec3> made(std::size_t{1} + std::size_t{kHighestOrder} * colour::kVisibleMax / 4);
        for (std::size_t i = 0; i < made.size(); ++i)
            for (int order = 1; order <= kHighestOrder; ++order) {
                const double wavelength_nm = static_cast<double>(i) * kPathStep_nm / order;
                if (wavelength_nm < colour::kVisibleMin || wavelength_nm > colour::kVisibleMax) continue;
                const glm::vec3 rgb(colour::xyz_to_rec709() * colour::cie_xyz(wavelength_nm));
                // Toward white until it is inside the screen's gamut.
                const float beyond = std::min({0.0F, rgb.r, rgb.g, rgb.b});
                made[i] += (rgb - beyond) / static_cast<float>(order);
            }
        return made;
    }();
    return colours;
}

glm::vec3 linear(const std::uint8_t* rgb) {
    return {colour::srgb_linear(rgb[0] / 255.0), colour::srgb_linear(rgb[1] / 255.0),
            colour::srgb_linear(rgb[2] / 255.0)};
}

std::uint8_t encoded(float light) {
    const double shown = 1.0 - std::exp(-1.6 * std::max(light, 0.0F));
    return static_cast<std::uint8_t>(std::lround(255.0 * colour::srgb_encoded(shown)));
}

/// The sum of the directions to a lamp and to the eye, along the card, at a point of it.
struct Path {
    glm::vec2 middle;
    glm::vec2 per_u;  ///< change per metre
    glm::vec2 per_v;

    glm::vec2 at(const glm::vec2& position_m) const { return middle + position_m.x * per_u + position_m.y * per_v; }
};

Path path_of(const glm::vec3& lamp, const glm::mat3& tilt) {
    constexpr float kStep_m = 0.03F;
    const glm::mat3 to_card = glm::transpose(tilt);
    const auto sum = [&](const glm::vec3& point) {
        const glm::vec3 eye = to_card * glm::vec3(0.0F, 0.0F, kEye_m) - point;
        return glm::vec2(glm::normalize(to_card * (kLamp_m * lamp) - point) + glm::normalize(eye));
    };
    const glm::vec2 middle = sum(glm::vec3(0.0F));
    return {middle, (sum({kStep_m, 0.0F, 0.0F}) - middle) / kStep_m, (sum({0.0F, kStep_m, 0.0F}) - middle) / kStep_m};
}

}  // namespace

Thumbnail::Thumbnail(Recipe recipe, NamedPictures pictures, const std::string& file, int height) {
    ROWLAND_CHECK(height > 0, "a thumbnail has pixels");
    const double longer_over_height = std::max(recipe.card.width_mm / recipe.card.height_mm, 1.0);
    recipe.texture_px = static_cast<int>(std::lround(kTexelsPerPixel * height * longer_over_height));
    // The print shall come as texels, not as the artwork's file.
    for (auto& named : pictures) {
        auto& picture = named.second;
        if (!picture.bytes.empty())
            picture = {picture.file, {}, image::decode_byte_image(std::exchange(picture.bytes, {}), picture.file)};
    }
    const CardTexels card = card_texels(recipe, pictures, file);
    const FoilGrating grating = foil_grating(recipe.foil);
    width_ = card.area.width_px / kTexelsPerPixel;
    height_ = card.area.height_px / kTexelsPerPixel;
    lobe_ = grating.varies_pitch ? 0.0F : 1.6F * static_cast<float>(std::sin(glm::radians(grating.spread_deg)));
    const std::size_t row_length = static_cast<std::size_t>(card.area.width_px);
    texels_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * kTexelsPerPixel *
                    kTexelsPerPixel);
    for (int row = 0; row < kTexelsPerPixel * height_; ++row)
        for (int column = 0; column < kTexelsPerPixel * width_; ++column) {
            const std::size_t i = static_cast<std::size_t>(row) * row_length + static_cast<std::size_t>(column);
            const glm::vec3 base = linear(&card.base_colour[3 * i]);
            const float metallic = card.metallic_roughness.empty()
                                       ? static_cast<float>(card.metallic)
                                       : static_cast<float>(card.metallic_roughness[3 * i + 2]) / 255.0F;
            Texel& texel = texels_.emplace_back();
            texel.print = base * glm::mix(kPrint, kSilver, metallic);
            texel.tint = kBrightness * glm::mix(glm::vec3(1.0F), base, metallic);
            texel.position_m = 1e-3F * glm::vec2(card.area.position_mm(column, row) -
                                                 0.5 * glm::dvec2(card.area.width_mm, card.area.height_mm()));
            const bool has_texture = !card.grooves.empty();
            const double pitch = has_texture ? card.grooves[3 * i + 1] / 32767.5 : 1.0;
            const double rotation = has_texture ? std::numbers::pi * card.grooves[3 * i] / 65535.0 : 0.0;
            const double angle = rotation + glm::radians(grating.rotation_deg);
            texel.grooves = {std::cos(angle), std::sin(angle)};
            texel.pitch_nm = static_cast<float>(pitch * grating.pitch_nm);
        }
}

void Thumbnail::draw(const glm::mat3& tilt, std::span<std::uint8_t> rgba) const {
    ROWLAND_CHECK(rgba.size() == std::size_t{4} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                  "four bytes per pixel");
    std::array<Path, kLamps.size()> paths;
    for (std::size_t i = 0; i < paths.size(); ++i) paths[i] = path_of(kLamps[i], tilt);
    const std::vector<glm::vec3>& colours = colours_of_paths();
    const auto light_of = [&](const Texel& texel) {
        if (texel.pitch_nm == 0.0F) return texel.print;
        glm::vec3 light(0.0F);
        for (const Path& path : paths) {
            const glm::vec2 sum = path.at(texel.position_m);
            const float along = texel.grooves.x * sum.y - texel.grooves.y * sum.x;
            const float off = lobe_ == 0.0F ? 0.0F : along * along / (lobe_ * lobe_);
            constexpr float kDark = 18.0F;  // e⁻⁹ of the middle
            if (off > kDark) continue;
            const float lobe = lobe_ == 0.0F ? kSpread : std::exp(-0.5F * off);
            const float path_nm = texel.pitch_nm * std::abs(glm::dot(texel.grooves, sum));
            const auto at = static_cast<std::size_t>(std::lround(path_nm / kPathStep_nm));
            if (at < colours.size()) light += lobe * colours[at];
        }
        return texel.print + texel.tint * light;
    };
    const auto row_length = static_cast<std::size_t>(kTexelsPerPixel * width_);
    parallel_for(static_cast<std::size_t>(height_), [&](std::size_t row) {
        for (std::size_t column = 0; column < static_cast<std::size_t>(width_); ++column) {
            glm::vec3 light(0.0F);
            for (std::size_t y = 0; y < kTexelsPerPixel; ++y)
                for (std::size_t x = 0; x < kTexelsPerPixel; ++x)
                    light += light_of(texels_[(kTexelsPerPixel * row + y) * row_length + kTexelsPerPixel * column + x]);
            light /= static_cast<float>(kTexelsPerPixel * kTexelsPerPixel);
            std::uint8_t* pixel = &rgba[4 * (row * static_cast<std::size_t>(width_) + column)];
            for (int c = 0; c < 3; ++c) pixel[c] = encoded(light[c]);
            pixel[3] = 255;
        }
    });
}

}  // namespace rowland::diffraction::foil
