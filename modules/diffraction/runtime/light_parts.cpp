#include "modules/diffraction/runtime/light_parts.h"

#include "engine/math/sh_basis.h"

namespace rowland::diffraction {

const LightParts& LightDivision::of(const render::FrameLight& light) {
    parts_.light_strengths = light.light_strengths;
    if (probe_ && parts_.version == light.version) return parts_;
    const lighting::LightProbe& probe = *light.probe;
    const bool other_probe = probe_ != light.probe;
    if (other_probe) {
        parts_.probe_sh = probe.sh;
        parts_.probe_texels = std::make_shared<const lighting::LightSamples>(lighting::unpack(probe.light));
        parts_.packed = {light.probe, &probe.light};
        parts_.illuminant = probe.illuminant.name;
    }
    if (other_probe || key_lights_apart_ != light.key_lights_apart) {
        const std::span<const lighting::KeyLight> keys = light.key_lights();
        parts_.key_lights.assign(keys.begin(), keys.end());
        parts_.residual = keys.empty() ? probe.sh : lighting::residual(probe.sh, keys, probe.sh.bands);
        parts_.texels = keys.empty()
                            ? parts_.probe_texels
                            : std::make_shared<const lighting::LightSamples>(lighting::unpack(probe.light, keys));
    }
    probe_ = light.probe;
    key_lights_apart_ = light.key_lights_apart;
    parts_.sh = probe.sh;
    add_distant_lights(light.distant_lights, parts_.sh);
    parts_.version = light.version;
    return parts_;
}

void add_distant_lights(std::span<const render::DistantLight> lights, lighting::ShLight& sh) {
    std::vector<double> basis(sh.coefficients.size());
    for (const render::DistantLight& light : lights) {
        math::evaluate_sh(glm::dvec3(light.direction), sh.bands, basis);
        for (std::size_t i = 0; i < basis.size(); ++i) sh.coefficients[i] += basis[i] * glm::dvec3(light.irradiance);
    }
}

}  // namespace rowland::diffraction
