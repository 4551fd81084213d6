#include "modules/diffraction/runtime/surface_light.h"

#include <algorithm>
#include <cmath>

#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/light_window.h"
#include "modules/diffraction/shaders/key_lobe_block.h"

namespace rowland::diffraction {

static_assert(lighting::kMaximumKeyLights <= ROWLAND_MAXIMUM_KEY_LOBES);

namespace {

/// The share of a lobe's variance in ψ that lies between its three nodes, as in bake/direct.cpp.
constexpr double kBetween = 0.3;

KeyLobe key_lobe(const lighting::KeyLight& light) {
    const lighting::LobeMoments moments = lighting::lobe_moments(light.concentration);
    const double step = std::sqrt(3.0 * kBetween / light.concentration);
    const double variance = (1.0 - kBetween) / light.concentration;
    return {.direction = glm::vec4(glm::dvec4(light.direction, light.concentration)),
            .flux = glm::vec4(glm::dvec4(light.flux, 0.0)),
            .moments = glm::vec4(glm::dvec4(moments.mean, moments.variance_along, moments.variance_across, 0.0)),
            .nodes = glm::vec4(glm::dvec4(std::cos(step), std::sin(step), variance, std::exp(-0.5 * variance)))};
}

}  // namespace

SurfaceLight::SurfaceLight(std::optional<math::SphericalWindow> window) : window_(window) {}

void SurfaceLight::set(const render::FrameLight& light) {
    if (key_lights_.size() != 0 && light_.version == light.version) return;
    light_ = light;
    windowed_.clear();
    KeyLobeBlock block = {};
    const std::size_t count = std::min<std::size_t>(light.key_lights.size(), ROWLAND_MAXIMUM_KEY_LOBES);
    block.key_lobe_count.x = static_cast<float>(count);
    std::transform(light.key_lights.begin(), light.key_lights.begin() + static_cast<std::ptrdiff_t>(count),
                   block.key_lobes, key_lobe);
    key_lights_ = gpu::Buffer::of(std::span<const KeyLobeBlock>(&block, 1));
}

const lighting::ShLight& SurfaceLight::harmonics(int bands, LightShare share) {
    const auto found = windowed_.find({bands, share});
    if (found != windowed_.end()) return found->second;
    const lighting::ShLight& light = share == LightShare::Whole ? light_.sh : light_.residual;
    const math::SphericalWindow window = window_ ? *window_ : mildest_window(light, bands);
    return windowed_.emplace(std::pair(bands, share), lighting::limit_bands(light, bands, window)).first->second;
}

void SurfaceLight::bind_key_lights() const {
    key_lights_.bind_uniform(kKeyLobeBinding);
}

}  // namespace rowland::diffraction
