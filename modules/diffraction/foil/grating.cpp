#include "modules/diffraction/foil/grating.h"

#include <cmath>
#include <numbers>

#include "modules/diffraction/foil/kinegram.h"

namespace rowland::diffraction::foil {

namespace {

constexpr double kLacquerIndex = 1.5;  ///< acrylic and polyurethane at 589 nm

/// Widths of the light along the grooves that suit a type: narrow ones make facets flash, wide ones keep a foil bright
/// at all tilts.
double default_spread_deg(const FoilType& type) {
    if (std::holds_alternative<Radial>(type)) return 6.0;
    if (std::holds_alternative<Glitter>(type)) return 6.0;
    if (std::holds_alternative<Rainbow>(type)) return 12.0;
    return 8.0;
}

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// Sinusoidal relief as deep as is bright in the first order. A kinegram's is flatter: little light of the second and
/// third order, in which one picture would be seen at the tilt of the other.
nlohmann::ordered_json relief_profile(const Foil& foil) {
    const bool kinegram = std::holds_alternative<TwoPictures>(foil.type);
    return {{"type", "sinusoidal"}, {"depth_nm", kinegram ? 70.0 : 120.0}};
}

/// Lines of metal, so narrow that the print is seen and the first order is nearly as bright as the mirrored one.
nlohmann::ordered_json line_profile(double pitch_nm) {
    return {{"type", "slit"}, {"width_nm", pitch_nm / 4.0}};
}

}  // namespace

FoilGrating foil_grating(const Foil& foil) {
    FoilGrating grating;
    grating.pitch_nm = grating.smallest_pitch_nm = 1000.0 * foil.groove_um;
    grating.spread_deg = foil.spread_deg.value_or(default_spread_deg(foil.type));
    grating.one_direction = std::holds_alternative<Rainbow>(foil.type);
    grating.sparkle = std::holds_alternative<Glitter>(foil.type);
    grating.rotation_deg = foil.direction_deg;
    grating.varies_pitch = std::holds_alternative<Pillars>(foil.type);
    if (std::holds_alternative<Lens>(foil.type)) {
        grating.varies_pitch = true;
        // A texture holds pitches up to twice this one.
        grating.pitch_nm = grating.smallest_pitch_nm / (2.0 * kFinestOfLens);
    }
    if (const auto* two = std::get_if<TwoPictures>(&foil.type)) {
        const glm::dvec2 pitches_nm = picture_pitches_nm(*two);
        grating.varies_pitch = true;
        grating.pitch_nm = std::fmax(pitches_nm.x, pitches_nm.y);
        grating.smallest_pitch_nm = std::fmin(pitches_nm.x, pitches_nm.y);
        grating.highest_order = 3;
    }
    return grating;
}

nlohmann::ordered_json foil_material(const Foil& foil, const FoilLayers& layers, std::optional<int> texture) {
    const FoilGrating grating = foil_grating(foil);
    nlohmann::ordered_json grooves{{"pitch_nm", grating.pitch_nm}};
    grooves["profile"] = layers.is_opaque() ? relief_profile(foil) : line_profile(grating.pitch_nm);
    // Rigorous efficiencies are those of one pitch.
    if (layers.is_opaque() && grating.varies_pitch) grooves["theory"] = "scalar";
    grooves["orders"] = nlohmann::ordered_json::array();
    for (int order = -grating.highest_order; order <= grating.highest_order; ++order)
        if (order != 0) grooves["orders"].push_back(order);
    if (!grating.varies_pitch) grooves["groove_lobe"] = {{"sigma", std::sin(radians(grating.spread_deg))}};

    nlohmann::ordered_json material{{"grating", std::move(grooves)}, {"metal", "Al"}};
    if (layers.lacquer.gloss) {
        material["cover"] = {{"ior", kLacquerIndex}};
        const glm::dvec3& tint = layers.lacquer.tint;
        if (tint != glm::dvec3(1.0)) material["cover"]["tint"] = {tint.x, tint.y, tint.z};
    }
    if (grating.rotation_deg != 0.0) material["grooveRotation"] = radians(grating.rotation_deg);
    if (texture) {
        material["grooveTexture"] = {{"index", *texture}};
        if (grating.sparkle) material["grooveTexture"]["sparkle"] = true;
    }
    // Each part of a pixel would sum over all key lights. Without them lobes as wide as a foil's are within 4 % of the
    // reference under five captures, with 16 of them within 5 %.
    material["quality"] = {{"representation", "planar"}, {"key_lights", 0}};
    return material;
}

}  // namespace rowland::diffraction::foil
