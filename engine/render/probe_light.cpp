#include "engine/render/probe_light.h"

#include "engine/core/check.h"
#include "engine/lighting/ambient.h"

namespace rowland::render {

static_assert(ROWLAND_MAXIMUM_KEY_LIGHTS == lighting::kMaximumKeyLights);

ProbeLight::ProbeLight(const lighting::LightProbe& probe)
    : sh_(probe.sh), packed_(probe.light), fitted_(probe.key_lights), whole_ambient_(probe.ambient.coefficients) {}

void ProbeLight::divide(bool with_keys) {
    const bool split = with_keys && !fitted_.empty();
    key_lights_ = split ? fitted_ : std::vector<lighting::KeyLight>();
    residual_ = split ? lighting::residual(sh_, key_lights_, sh_.bands) : sh_;
    ambient_ = split ? lighting::ambient_coefficients(residual_, key_lights_).coefficients : whole_ambient_;
    texels_ = std::make_shared<const lighting::LightTexels>(lighting::unpack(packed_, key_lights_));
}

KeyLightBlock key_light_block(std::span<const lighting::KeyLight> keys, const glm::dmat3& rec709_to_working) {
    ROWLAND_CHECK_OP(keys.size(), <=, std::size_t{ROWLAND_MAXIMUM_KEY_LIGHTS});
    KeyLightBlock block = {};
    block.key_light_count.x = static_cast<float>(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const lighting::KeyLight& key = keys[i];
        const lighting::LobeMoments moments = lighting::lobe_moments(key.concentration);
        KeyLightEntry& entry = block.key_lights[i];
        entry.direction = glm::vec4(glm::vec3(key.direction), static_cast<float>(moments.mean));
        entry.flux = glm::vec4(glm::vec3(key.flux), static_cast<float>(key.concentration));
        entry.irradiance =
            glm::vec4(glm::vec3(rec709_to_working * key.flux), static_cast<float>(moments.variance_along));
        entry.spread = glm::vec4(static_cast<float>(moments.variance_across), 0.0F, 0.0F, 0.0F);
    }
    return block;
}

}  // namespace rowland::render
