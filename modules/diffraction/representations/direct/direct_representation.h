#pragma once

#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// The probe's key lights and the scene's analytic lights are shaded, and nothing else.
struct DirectSettings {
    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static DirectSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant&) {}
};

/// Nothing besides the kernel, which every material has.
struct DirectTables {};

DirectTables bake(const Grating& grating, const DirectSettings& settings);
void write(const DirectTables& tables, ByteWriter& writer);
DirectTables read(ByteReader& reader, const DirectSettings& settings);
ShadingCost cost(const DirectTables& tables);
Facts facts(const DirectTables& tables);
PointShader point_shader(const DirectTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
