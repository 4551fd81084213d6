#pragma once

#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// The map over (g, v_g) that the probe fills at run time.
struct CircleSettings {
    CircleMapSize size;

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static CircleSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant&) {}
};

struct CircleTables {
    CircleMapSize size;
};

CircleTables bake(const Grating& grating, const CircleSettings& settings);
void write(const CircleTables& tables, ByteWriter& writer);
CircleTables read(ByteReader& reader, const CircleSettings& settings);
ShadingCost cost(const CircleTables& tables);
Facts facts(const CircleTables& tables);
PointShader point_shader(const CircleTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
