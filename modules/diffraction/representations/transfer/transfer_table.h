#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/colour/light_spectra.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// The SH coefficients of the diffraction term with the wavelengths already summed, c_i,o,c(v): exact but for the
/// light's bands and the table's nodes. A 2D texture array over views (view_mapping.h); a view reads n² × 9 numbers.
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
    void set_illuminant(const colour::Illuminant& white) { illuminant = white; }
};

/// Throws Error (input) for fewer than kManyGrooves grooves, or a one-dimensional grid for a lobe that is not flat. The
/// bytes do not depend on the number of threads.
TransferTable bake(const Grating& grating, const TransferSettings& settings);

/// XYZ of the tangent-frame view (v_g, v_h, v_n) under light in the same frame, with the table filtered as GL_LINEAR
/// does; 0 for v_n ≤ 0. The bands that both have are used.
glm::dvec3 evaluate(const TransferTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view);

void write(const TransferTable& table, ByteWriter& writer);
/// Throws Error (input) if the bytes are not such a table.
TransferTable read_transfer_table(ByteReader& reader);

/// What representation.h asks of every representation's tables.
TransferTable read(ByteReader& reader, const TransferSettings& settings);
ShadingCost cost(const TransferTable& table);
Facts facts(const TransferTable& table);
PointShader point_shader(const TransferTable& table, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
