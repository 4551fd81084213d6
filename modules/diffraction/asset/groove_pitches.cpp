#include "modules/diffraction/asset/groove_pitches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.h"
#include "engine/lighting/key_lights.h"

namespace rowland::diffraction {

namespace {

/// Default rank of a table over pitches, for an error of 1 % or less; with one pitch, 8 give 2 %.
constexpr int kPitchRank = 12;
/// Largest ratio of neighbouring pitches of an `arc` table, and of a `planar` map. Measured errors of a CD-like foil's
/// map midway between two pitches, under Grace, Ennis and Royal Esplanade: .5, .8 and 2.2 %. With the table's step they
/// would be 1.3, 2.1 and 4.9 %.
constexpr double kTablePitchStep = 1.045;
constexpr double kMapPitchStep = 1.03;
/// Smaller relative differences of the pitch are ignored.
constexpr double kSamePitch = 0.01;

}  // namespace

bool GroovePitches::vary() const {
    return smallest < 1.0 - kSamePitch || largest > 1.0 + kSamePitch;
}

GroovePitches groove_pitches(const image::ByteImage& texture) {
    double smallest = 2.0;
    double largest = 0.0;
    for (std::size_t i = 1; i < texture.rgba.size(); i += 4) {
        const double half_pitch = texture.value(i);
        if (half_pitch == 0.0) continue;
        smallest = std::min(smallest, 2.0 * half_pitch);
        largest = std::max(largest, 2.0 * half_pitch);
    }
    if (largest == 0.0) return {};
    return {.smallest = smallest, .largest = largest};
}

std::optional<Refusal> groove_refusal(const Material& material, const GroovePitches& pitches) {
    const std::optional<Representation>& pinned = material.quality.pinned;
    const bool map = pinned && std::holds_alternative<PlanarSettings>(*pinned);
    if (pinned && !map && !std::holds_alternative<ArcSettings>(*pinned)) {
        const auto* streak = std::get_if<StreakSurfaceSettings>(&*pinned);
        const bool narrow = streak != nullptr && !streak->incoherent;
        if (narrow || std::holds_alternative<DirectSettings>(*pinned)) return std::nullopt;
        return Refusal{"quality/representation", fmt::format("\"{}\" with a grooveTexture", info(*pinned).name),
                       "\"arc\", \"planar\", \"direct\" or, with a sigma for groove_lobe, \"streak\"",
                       "or leave quality out"};
    }
    if (!pitches.vary() || is_flat(material.grating.lobe)) return std::nullopt;
    return Refusal{"grooveTexture",
                   fmt::format("pitches of {:.3g} to {:.3g} times pitch_nm, with a groove_lobe that is not flat",
                               pitches.smallest, pitches.largest),
                   "the flat groove_lobe, or the representation \"streak\" or \"direct\"",
                   "or keep the texture's green at one half"};
}

Material suited_to_grooves(Material material, const GroovePitches& pitches) {
    Quality& quality = material.quality;
    if (!quality.pinned) {
        quality.pinned = ArcSettings{.rank = kPitchRank};
        quality.key_lights = lighting::kMaximumKeyLights;
    }
    if (!pitches.vary()) return material;
    const double largest = pitches.largest;
    const double low = std::min(pitches.smallest, largest * (1.0 - kSamePitch));
    const auto axis = [&](double step) {
        return PitchAxis{.smallest = low,
                         .largest = largest,
                         .nodes = 2 + static_cast<int>(std::log(largest / low) / std::log(step))};
    };
    if (auto* arc = std::get_if<ArcSettings>(&*quality.pinned)) arc->pitch = axis(kTablePitchStep);
    if (auto* planar = std::get_if<PlanarSettings>(&*quality.pinned)) {
        planar->size.pitch = axis(kMapPitchStep);
        planar->stand_in.pitch = axis(kTablePitchStep);
    }
    return material;
}

Material drawable_material(const GltfGrating& grating, const GroovePitches* pitches, const std::string& file,
                           const std::string& pointer) {
    const auto require = [&](const std::optional<Refusal>& refused, const std::string& parent) {
        if (refused) refuse_input(file, parent + refused->key, refused->found, refused->expected, refused->remedy);
    };
    require(baked_refusal(grating.material.grating), pointer);
    if (pitches == nullptr) return grating.material;
    require(groove_refusal(grating.material, *pitches), pointer + "/");
    return suited_to_grooves(grating.material, *pitches);
}

}  // namespace rowland::diffraction
