#pragma once

#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/planar/planar_map.h"

namespace rowland::diffraction {

/// A map over (azimuth, v_g) that is filled at run time for a flat object. The stand-in shades the object meanwhile,
/// and objects that are not flat.
struct PlanarSettings {
    PlanarMapSize size;
    ArcSettings stand_in;

    static const RepresentationInfo& info();
    static PlanarSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant& white) { stand_in.illuminant = white; }
};

struct PlanarTables {
    PlanarMapSize size;
    ArcTable stand_in;
};

PlanarTables bake(const Grating& grating, const PlanarSettings& settings);
void write(const PlanarTables& tables, ByteWriter& writer);
/// The map's size is the settings'.
PlanarTables read(ByteReader& reader, const PlanarSettings& settings);
ShadingCost cost(const PlanarTables& tables);
Facts facts(const PlanarTables& tables);
/// Keeps the map of the last plane only: for one thread at a time, and for points sorted by plane.
PointShader point_shader(const PlanarTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
