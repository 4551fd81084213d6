#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/colour/illuminant.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// SH coefficients of the diffraction term with the wavelengths summed, c_i,o,c(v): exact within the light's bands and
/// the table's resolution. A 2D texture array over views (view_mapping.h); a view reads n² × 9 numbers.
///
/// Layer (c·3 + o)·L + j, L = harmonic_layers(bands), holds c_i for i = 4j … 4j+3 (0 beyond n²): light of colour c,
/// tristimulus o. XYZ_o = Σ_c Σ_j dot(layer, l_c,4j..4j+3).
struct TransferTable : PackedTexels {
    int bands = 0;
    ViewGrid grid;
};

struct TransferSettings {
    int bands = 5;                   ///< n, 1 … 32
    std::optional<ViewGrid> grid{};  ///< none: default_view_grid()
    Storage storage = Storage::Half;
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the light's white; baked in

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static TransferSettings from(const SettingValues& values, const Grating& grating);
};

/// Throws Error (input) for fewer than kManyGrooves grooves, or a one-dimensional grid for a lobe that is not flat. The
/// bytes do not depend on the number of threads.
TransferTable bake(const Grating& grating, const TransferSettings& settings);

/// XYZ of the tangent-frame view (v_g, v_h, v_n) under light in the same frame, with the table filtered as GL_LINEAR
/// does; 0 for v_n ≤ 0. Uses the bands that the table and the light have in common.
glm::dvec3 evaluate(const TransferTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view);

void write(const TransferTable& table, ByteWriter& writer);
/// Throws Error (input) for invalid bytes.
TransferTable read_transfer_table(ByteReader& reader);

/// Required by representation.h.
TransferTable read(ByteReader& reader, const TransferSettings& settings);
ShadingCost cost(const TransferTable& table);
Facts facts(const TransferTable& table);

}  // namespace rowland::diffraction
