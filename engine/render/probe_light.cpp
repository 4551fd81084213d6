#include "engine/render/probe_light.h"

#include "engine/lighting/ambient.h"

namespace rowland::render {

ProbeLight::ProbeLight(const lighting::LightProbe& probe)
    : sh_(probe.sh),
      packed_(probe.light),
      fitted_(probe.key_lights),
      radiance_(std::make_shared<const lighting::PackedEnvironmentMap>(lighting::finest_level(probe.environment))),
      whole_ambient_(probe.ambient.coefficients) {}

void ProbeLight::divide(bool with_keys) {
    const bool split = with_keys && !fitted_.empty();
    key_lights_ = split ? fitted_ : std::vector<lighting::KeyLight>();
    residual_ = split ? lighting::residual(sh_, key_lights_, sh_.bands) : sh_;
    ambient_ = split ? lighting::ambient_coefficients(residual_, key_lights_).coefficients : whole_ambient_;
    if (!whole_texels_) whole_texels_ = std::make_shared<const lighting::LightTexels>(lighting::unpack(packed_, {}));
    texels_ =
        split ? std::make_shared<const lighting::LightTexels>(lighting::unpack(packed_, key_lights_)) : whole_texels_;
}

}  // namespace rowland::render
