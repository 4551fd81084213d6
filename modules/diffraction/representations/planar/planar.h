#pragma once

#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/planar/planar_map.h"

namespace rowland::diffraction {

/// The map over (azimuth, v_g) that a flat object's light fills at run time, and what shades it while it fills and on
/// objects that are not flat.
struct PlanarSettings {
    PlanarMapSize size;
    ArcSettings stand_in;

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static PlanarSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant& white) { stand_in.illuminant = white; }
};

struct PlanarTables {
    PlanarMapSize size;
    ArcTable stand_in;
};

PlanarTables bake(const Grating& grating, const PlanarSettings& settings);
void write(const PlanarTables& tables, ByteWriter& writer);
/// The map's size comes from the material, where it has been checked.
PlanarTables read(ByteReader& reader, const PlanarSettings& settings);
ShadingCost cost(const PlanarTables& tables);
Facts facts(const PlanarTables& tables);
/// Keeps the map of the last plane alone, so that it is for one thread at a time and for frames of one plane after
/// another.
PointShader point_shader(const PlanarTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
