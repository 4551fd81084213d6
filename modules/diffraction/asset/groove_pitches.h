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

GroovePitches groove_pitches(const image::ByteImage& texture);

/// Why a material cannot be drawn under a groove texture: its representation supports one direction or one pitch only.
/// nullopt if it can. The key is a JSON pointer relative to the glTF extension, without its first slash.
std::optional<Refusal> groove_refusal(const Material& material, const GroovePitches& pitches);

/// The material with tables for these pitches, for which groove_refusal() is nullopt; arc, if nothing is pinned.
Material suited_to_grooves(Material material, const GroovePitches& pitches);

/// A grating of a glTF file under its texture, ready to be baked; null: it has none. Throws Error (input) if it cannot
/// be drawn. `file` and `pointer` (JSON) are for messages.
Material drawable_material(const GltfGrating& grating, const GroovePitches* pitches, const std::string& file,
                           const std::string& pointer);

}  // namespace rowland::diffraction
