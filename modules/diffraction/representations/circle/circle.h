#pragma once

#include <optional>

#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// A map over (g, v_g) that is filled from the probe at run time.
struct CircleSettings {
    CircleMapSize size;
    int charts = 2;  ///< of the map: 1 if orders m and −m are equally bright
    bool covered = false;

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static CircleSettings from(const SettingValues& values, const Grating& grating);
};

struct CircleTables {
    CircleMapSize size;
    int charts = 2;
    bool covered = false;
};

CircleTables bake(const Grating& grating, const CircleSettings& settings);
void write(const CircleTables& tables, ByteWriter& writer);
CircleTables read(ByteReader& reader, const CircleSettings& settings);
ShadingCost cost(const CircleTables& tables);
Facts facts(const CircleTables& tables);
PointShader point_shader(const CircleTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
