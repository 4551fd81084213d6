#include "modules/diffraction/representations/direct/direct_representation.h"

namespace rowland::diffraction {

const RepresentationInfo& DirectSettings::info() {
    static const RepresentationInfo info{.name = "direct",
                                         .summary = "key lights and analytic lights alone",
                                         .lattices = true,
                                         .key_lights = KeyLightUse::Always,
                                         .sweep_tier = "key_lights=16",
                                         .sweep_key_lights = {4, 16, 64},
                                         .budget = [](bool, SurfaceShape) { return std::vector<std::string>{""}; }};
    return info;
}

DirectSettings DirectSettings::from(const SettingValues&, const Grating&) {
    return {};
}

DirectTables bake(const Grating&, const DirectSettings&) {
    return {};
}

void write(const DirectTables&, ByteWriter&) {}

DirectTables read(ByteReader&, const DirectSettings&) {
    return {};
}

ShadingCost cost(const DirectTables&) {
    return {};
}

Facts facts(const DirectTables&) {
    return {};
}

PointShader point_shader(const DirectTables&, const MaterialKernel&, const EvaluationLight&) {
    return [](const ShadingPoint&) { return glm::dvec3(0.0); };
}

}  // namespace rowland::diffraction
