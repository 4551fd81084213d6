#pragma once

#include <optional>

#include "engine/core/parallel.h"
#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/planar_map.h"

namespace rowland::diffraction {

/// A map over (azimuth, v_g), or with a lobe that is not flat or a lattice (azimuth, v_g, v_h), that is filled at run
/// time for a flat object. The stand-in shades objects that are not flat.
struct PlanarSettings {
    PlanarMapSize size;                      ///< flat lobe
    std::optional<LobeMapSize> lobe_size{};  ///< other lobes, and lattices
    Grating grating{};
    ArcSettings stand_in;

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static PlanarSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant& white) { stand_in.illuminant = white; }
};

/// The material's part of a map of a lattice or a lobe that is not flat.
struct PlanarLobe {
    LobeMapSize size;
    DiffractionPattern pattern;
};

struct PlanarTables {
    PlanarMapSize size;
    std::optional<PlanarLobe> lobe{};  ///< of a lobe that is not flat, or a lattice
    Lazy<ArcTable> stand_in;           ///< takes longer to bake than a map to fill, and flat objects do not read it
};

PlanarTables bake(const Grating& grating, const PlanarSettings& settings);
void write(const PlanarTables& tables, ByteWriter& writer);
/// Takes the map's size and the lobe's pattern from the settings.
PlanarTables read(ByteReader& reader, const PlanarSettings& settings);
ShadingCost cost(const PlanarTables& tables);
Facts facts(const PlanarTables& tables);
/// Keeps the map of the last plane only: call it from one thread at a time, with points sorted by plane. Tables of one
/// azimuth (one_azimuth()) fill a map for each g.
PointShader point_shader(const PlanarTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
