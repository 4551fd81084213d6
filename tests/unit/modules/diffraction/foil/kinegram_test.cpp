// A small card with two pictures under a lamp, by the reference: each picture at its own tilt, and not at the other.

#include "modules/diffraction/foil/kinegram.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/foil/grating.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::diffraction::foil {
namespace {

constexpr int kPicture = 32;         ///< texels of a picture's side
constexpr int kTexelsPerPixel = 16;  ///< of the groove texture

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// A dark room with a lamp 3° wide at an angle above the horizon in front, +Z; +Y is up.
lighting::ProbeImage lamp_at(double above_deg) {
    lighting::ProbeImage room(image::make_image(720, 360), lighting::Mapping::Equirectangular);
    image::Image lit = room.image();
    const glm::dvec3 toward(0.0, std::sin(radians(above_deg)), std::cos(radians(above_deg)));
    for (int row = 0; row < lit.height; ++row)
        for (int column = 0; column < lit.width; ++column)
            if (glm::dot(room.direction(column + 0.5, row + 0.5), toward) > std::cos(radians(1.5)))
                lit.at(column, row) = glm::vec3(100.0F);
    return {lit, lighting::Mapping::Equirectangular};
}

/// Two pictures of squares of different sizes, which are not correlated.
std::array<Brightness, 2> pictures() {
    std::array<Brightness, 2> all;
    for (int row = 0; row < kPicture; ++row)
        for (int column = 0; column < kPicture; ++column) {
            all[0].push_back((column / 4 + row / 4) % 2 == 0 ? 0.9F : 0.1F);
            all[1].push_back(0.5F + 0.4F * std::sin(0.5F + 0.196350F * static_cast<float>(row)));
        }
    return all;
}

Brightness enlarged(const Brightness& picture) {
    constexpr int kSide = kPicture * kTexelsPerPixel;
    Brightness large;
    for (int row = 0; row < kSide; ++row)
        for (int column = 0; column < kSide; ++column)
            large.push_back(
                picture[static_cast<std::size_t>(row / kTexelsPerPixel * kPicture + column / kTexelsPerPixel)]);
    return large;
}

double correlation(const std::vector<double>& a, const Brightness& b) {
    double mean_a = 0.0;
    double mean_b = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        mean_a += a[i] / static_cast<double>(a.size());
        mean_b += b[i] / static_cast<double>(a.size());
    }
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
    }
    return ab / std::sqrt(aa * bb);
}

/// What a texel has.
struct Grooves {
    bool upright = false;  ///< else they run across the card
    double pitch_nm = 0.0;

    friend auto operator<=>(const Grooves&, const Grooves&) = default;
};

/// The luminance that an eye before the card sees of each.
std::map<Grooves, double> luminance_of(const Grating& grating, const std::set<Grooves>& all, double tilt_deg,
                                       const lighting::ProbeImage& room) {
    const double t = radians(tilt_deg);
    std::map<Grooves, double> luminance;
    for (const Grooves& grooves : all) {
        const ShadingPoint point{
            .view = {0.0, 0.0, 1.0},
            .normal = {0.0, std::sin(t), std::cos(t)},
            .grating = grooves.upright ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, std::cos(t), -std::sin(t))};
        Grating of_pitch = grating;
        // A slit keeps its fraction of the pitch, as the kernel of a texture's pitch does.
        if (auto* slit = std::get_if<SlitProfile>(&of_pitch.profile))
            slit->width_nm *= grooves.pitch_nm / grating.pitch_nm;
        of_pitch.pitch_nm = grooves.pitch_nm;
        luminance[grooves] = reference_radiance(of_pitch, room, colour::LightSpectra(), std::span(&point, 1))[0].y;
    }
    return luminance;
}

/// The card as it is seen at a tilt, a value per pixel of the pictures.
std::vector<double> seen_card(const Foil& foil, const FoilLayers& layers, double tilt_deg) {
    const auto& two = std::get<TwoPictures>(foil.type);
    constexpr int kSide = kPicture * kTexelsPerPixel;
    const Area area{.width_px = kSide, .height_px = kSide, .width_mm = 40.0};
    const auto [a, b] = pictures();
    const std::array<Brightness, 2> large = {enlarged(a), enlarged(b)};
    const std::vector<std::uint16_t> texels = groove_texels(area, groove_field(foil, area, large));
    const nlohmann::json json = nlohmann::json::parse(foil_material(foil, layers, 0).dump());
    const Grating grating = parse_gltf_extension(json, "card.glb", ReadNamed{}, "").material.grating;
    const auto grooves_at = [&](std::size_t texel) {
        return Grooves{.upright = texels[3 * texel] == 0,
                       .pitch_nm = 2.0 * texels[3 * texel + 1] / 65535.0 * grating.pitch_nm};
    };
    std::set<Grooves> all;
    for (std::size_t texel = 0; texel < texels.size() / 3; ++texel) all.insert(grooves_at(texel));
    EXPECT_EQ(all.size(), 3U);  // of A, of B, of neither
    const auto luminance = luminance_of(grating, all, tilt_deg, lamp_at(two.lamp_deg));
    std::vector<double> seen(static_cast<std::size_t>(kPicture * kPicture), 0.0);
    for (std::size_t texel = 0; texel < texels.size() / 3; ++texel) {
        const std::size_t row = texel / kSide / kTexelsPerPixel;
        const std::size_t column = texel % kSide / kTexelsPerPixel;
        seen[row * kPicture + column] += luminance.at(grooves_at(texel));
    }
    return seen;
}

void expect_each_at_its_tilt(const TwoPictures& two, const FoilLayers& layers) {
    const Foil foil{.type = two};
    const auto [a, b] = pictures();
    const std::vector<double> at_a = seen_card(foil, layers, two.tilts_deg.x);
    const std::vector<double> at_b = seen_card(foil, layers, two.tilts_deg.y);
    EXPECT_GE(correlation(at_a, a), 0.9);
    EXPECT_LE(std::abs(correlation(at_a, b)), 0.1);
    EXPECT_GE(correlation(at_b, b), 0.9);
    EXPECT_LE(std::abs(correlation(at_b, a)), 0.1);
}

TEST(Kinegram, ShowsEachPictureAtItsTiltUnderALamp) {
    expect_each_at_its_tilt({}, {.ink = Ink::Covers, .under = Under::Metal});
}

TEST(Kinegram, DoesSoAsAFilmOverPaper) {
    expect_each_at_its_tilt({}, {.ink = Ink::LetsThrough, .under = Under::Paper});
}

TEST(Kinegram, DoesSoAtOtherTiltsAndUnderAnotherLamp) {
    const TwoPictures two{.tilts_deg = {5.0, -28.0}, .lamp_deg = 25.0};
    ASSERT_FALSE(tilt_refusal(two)) << tilt_refusal(two)->remedy;
    expect_each_at_its_tilt(two, {.ink = Ink::Covers, .under = Under::Metal});
}

TEST(Kinegram, WhatIsRefusedWouldShowBothPictures) {
    const TwoPictures two{.tilts_deg = {-10.0, -7.0}};
    ASSERT_TRUE(tilt_refusal(two));
    const auto [a, b] = pictures();
    const std::vector<double> at_a = seen_card({.type = two}, {.ink = Ink::Covers, .under = Under::Metal}, -10.0);
    EXPECT_GT(std::abs(correlation(at_a, b)), 0.1);
}

TEST(Kinegram, PitchesSendTheMiddleWavelengthToTheEye) {
    const TwoPictures two;
    const glm::dvec2 pitches_nm = picture_pitches_nm(two);
    EXPECT_NEAR(pitches_nm.x * (std::sin(radians(10.0)) + std::sin(radians(50.0))), kMiddleWavelength_nm, 1e-9);
    EXPECT_NEAR(pitches_nm.y * (std::sin(radians(-10.0)) + std::sin(radians(30.0))), kMiddleWavelength_nm, 1e-9);
}

}  // namespace
}  // namespace rowland::diffraction::foil
