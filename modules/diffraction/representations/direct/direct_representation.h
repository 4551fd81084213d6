#pragma once

#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// Shades the probe's key lights and the scene's analytic lights alone.
struct DirectSettings {
    static const RepresentationInfo& info();
    static DirectSettings from(const SettingValues& values, const Grating& grating);
};

/// Empty: the kernel is part of every material.
struct DirectTables {};

DirectTables bake(const Grating& grating, const DirectSettings& settings);
void write(const DirectTables& tables, ByteWriter& writer);
DirectTables read(ByteReader& reader, const DirectSettings& settings);
ShadingCost cost(const DirectTables& tables);
Facts facts(const DirectTables& tables);
PointShader point_shader(const DirectTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
