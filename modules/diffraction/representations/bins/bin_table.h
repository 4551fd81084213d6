#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// SH coefficients of the diffraction term in wavelength bins that are the same for every view, so that their colours
/// need no look-up. A 2D texture array over views (view_mapping.h).
///
/// Layer b·L + j, L = ⌈n²/4⌉, holds entries 4j … 4j+3 of bin b's coefficients (0 beyond n²): the mean of c_i(v, λ) over
/// the bin, weighted by q = k_S S (x̄+ȳ+z̄). XYZ = Σ_b colours_b Σ_i c_b,i l_i.
struct BinTable : PackedTexels {
    int bands = 0;
    ViewGrid grid;
    std::vector<glm::mat3> colours;  ///< one per bin: ∫ cmf Eᵀ dλ over it; RGB in, XYZ out

    int bins() const { return static_cast<int>(colours.size()); }
};

struct BinSettings {
    int bands = 5;  ///< n, 1 … 32
    int bins = 16;  ///< W, 1 … 400: intervals of equal ∫q
    ViewGrid grid{};
    Storage storage = Storage::Unorm16;
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the light's white; baked in

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static BinSettings from(const SettingValues& values, const Grating& grating);
};

/// Throws Error (input) for fewer than kManyGrooves grooves, or a one-dimensional grid for a lobe that is not flat. The
/// bytes do not depend on the number of threads.
BinTable bake(const Grating& grating, const BinSettings& settings);

/// XYZ of the tangent-frame view, as evaluate(TransferTable).
glm::dvec3 evaluate(const BinTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view);

void write(const BinTable& table, ByteWriter& writer);
/// Throws Error (input) for invalid bytes.
BinTable read_bin_table(ByteReader& reader);

/// Required by representation.h.
BinTable read(ByteReader& reader, const BinSettings& settings);
ShadingCost cost(const BinTable& table);
Facts facts(const BinTable& table);

}  // namespace rowland::diffraction
