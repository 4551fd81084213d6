#pragma once

#include <optional>
#include <string>

#include "engine/image/byte_image.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// The range of a groove texture's pitches above 0, as factors of pitch_nm; 1 if there are none.
struct GroovePitches {
    double smallest = 1.0;
    double largest = 1.0;

    bool vary() const;
};

/// From the green channel of a GrooveTexture.
GroovePitches groove_pitches(const image::ByteImage& texture);

/// Why a material cannot be drawn under a groove texture: its representation supports only one direction of grooves, or
/// its representation and lobe only one pitch. nullopt if it can. The key is a JSON pointer relative to the glTF
/// extension, without its first slash.
std::optional<Refusal> groove_refusal(const Material& material, const GroovePitches& pitches);

/// The material with its table settings extended to these pitches; `arc` is pinned if nothing is. groove_refusal() must
/// be nullopt.
Material suited_to_grooves(Material material, const GroovePitches& pitches);

/// The material of a glTF file's grating with the settings for its groove texture, of these pitches; null: it has no
/// texture. Throws Error (input) if it cannot be drawn. `file` and `pointer` (JSON) are for messages.
Material drawable_material(const GltfGrating& grating, const GroovePitches* pitches, const std::string& file,
                           const std::string& pointer);

}  // namespace rowland::diffraction
