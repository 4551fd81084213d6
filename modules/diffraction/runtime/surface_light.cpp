#include "modules/diffraction/runtime/surface_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/key_lobe.h"
#include "modules/diffraction/runtime/light_window.h"
#include "modules/diffraction/shaders/key_lobe_block.h"

namespace rowland::diffraction {

static_assert(lighting::kMaximumKeyLights <= ROWLAND_MAXIMUM_KEY_LOBES);
static_assert(kLobeTableOctaves == ROWLAND_LOBE_TABLE_OCTAVES && kLobeTableStart == ROWLAND_LOBE_TABLE_START);

SurfaceLight::SurfaceLight(std::optional<math::SphericalWindow> window) : window_(window) {}

void SurfaceLight::set_light_colours(std::span<const glm::vec3> strengths) {
    constexpr float kSameColour = 1e-4F;
    light_colours_.clear();
    colour_block_ = {};
    colours_changed_ = true;
    for (std::size_t i = 0; i < strengths.size(); ++i) {
        const float largest = std::max({strengths[i].r, strengths[i].g, strengths[i].b});
        const glm::vec3 colour = largest > 0.0F ? strengths[i] / largest : glm::vec3(1.0F);
        const auto same = std::find_if(light_colours_.begin(), light_colours_.end(), [&](const glm::vec3& other) {
            return glm::all(glm::lessThan(glm::abs(other - colour), glm::vec3(kSameColour)));
        });
        colour_block_.light_colours[i] =
            glm::vec4(static_cast<float>(kFirstColourLayer + (same - light_colours_.begin())), largest, 0.0F, 0.0F);
        if (same == light_colours_.end()) light_colours_.push_back(colour);
    }
}

void SurfaceLight::set(const LightParts& light) {
    if (light_.light_strengths != light.light_strengths) set_light_colours(light.light_strengths);
    light_.light_strengths = light.light_strengths;
    if (lit_ && light_.version == light.version) return;
    if (light_.texels != light.texels) texels_.clear();
    light_ = light;
    lit_ = true;
    windowed_.clear();
    for (auto& [count, lights] : key_lights_) lights.changed = true;
}

const lighting::ShLight& SurfaceLight::harmonics(int bands, LightPart part) {
    const std::span<const lighting::KeyLight> keys = key_lights(part.key_lights);
    const std::tuple key(bands, part.kind, keys.size());
    const auto found = windowed_.find(key);
    if (found != windowed_.end()) return found->second;
    const auto unwindowed = [&] {
        if (part.kind == LightPart::Whole) return light_.sh;
        if (part.kind == LightPart::Probe) return light_.probe_sh;
        if (keys.size() == light_.key_lights.size()) return light_.residual;
        return lighting::residual(light_.probe_sh, keys, light_.probe_sh.bands);
    };
    const lighting::ShLight light = unwindowed();
    const math::SphericalWindow window = window_ ? *window_ : weakest_window(light, bands);
    return windowed_.emplace(key, lighting::limit_bands(light, bands, window)).first->second;
}

const std::shared_ptr<const lighting::LightSamples>& SurfaceLight::texels(LightPart part) const {
    if (part.kind != LightPart::Rest) return light_.probe_texels;
    const std::span<const lighting::KeyLight> keys = key_lights(part.key_lights);
    if (keys.size() == light_.key_lights.size()) return light_.texels;
    std::shared_ptr<const lighting::LightSamples>& texels = texels_[keys.size()];
    if (!texels) texels = std::make_shared<const lighting::LightSamples>(lighting::unpack(*light_.packed, keys));
    return texels;
}

std::span<const lighting::KeyLight> SurfaceLight::key_lights(int most) const {
    return std::span(light_.key_lights).first(std::min(light_.key_lights.size(), static_cast<std::size_t>(most)));
}

void SurfaceLight::bind_light_colours() const {
    if (std::exchange(colours_changed_, false))
        colour_buffer_.write_values(std::span<const LightColourBlock>(&colour_block_, 1));
    colour_buffer_.bind_uniform(kLightColourBinding);
}

void SurfaceLight::bind_key_lights(int most) const {
    const std::span<const lighting::KeyLight> lights = key_lights(most);
    KeyLightBuffer& bound = key_lights_[lights.size()];
    if (std::exchange(bound.changed, false)) {
        KeyLobeBlock block = {};
        block.key_lobe_count.x = static_cast<float>(lights.size());
        std::transform(lights.begin(), lights.end(), block.key_lobes, key_lobe);
        bound.buffer.write_values(std::span<const KeyLobeBlock>(&block, 1));
    }
    bound.buffer.bind_uniform(kKeyLobeBinding);
}

}  // namespace rowland::diffraction
