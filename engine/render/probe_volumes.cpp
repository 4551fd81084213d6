#include "engine/render/probe_volumes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/render/renderer.h"
#include "engine/scene/transform.h"

namespace rowland::render {

float ProbeBox::volume_m3() const {
    return 8.0F * std::abs(glm::determinant(glm::mat3(box_to_world)));
}

float ProbeBox::weight(const glm::vec3& point) const {
    const glm::vec3 at(world_to_box * glm::vec4(point, 1.0F));
    const glm::vec3 nearest = glm::clamp(at, -1.0F, 1.0F);
    const float distance = glm::length(glm::mat3(box_to_world) * (at - nearest));
    if (fade_m <= 0.0F) return distance > 0.0F ? 0.0F : 1.0F;
    return std::clamp(1.0F - distance / fade_m, 0.0F, 1.0F);
}

ProbeVolumes gather_volumes(ecs::World& world) {
    ProbeVolumes volumes;
    world.view<ProbeVolume, scene::WorldMatrix>().each(
        [&](ecs::Entity, const ProbeVolume& volume, const scene::WorldMatrix& matrix) {
            const glm::mat4 box_to_world = glm::scale(matrix.matrix, volume.half);
            const glm::mat4 world_to_box = glm::inverse(box_to_world);
            if (!std::isfinite(world_to_box[0][0]) || !volume.probe) return;
            volumes.boxes.push_back({box_to_world, world_to_box, volume.fade_m});
            volumes.probes.push_back(volume.probe);
        });
    return volumes;
}

LightMix light_at(const glm::vec3& point, std::span<const ProbeBox> boxes) {
    if (boxes.empty()) return {};
    std::vector<std::pair<float, std::size_t>> by_volume;  // volume, index of the light
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].weight(point) > 0.0F) by_volume.emplace_back(boxes[i].volume_m3(), i + 1);
    std::ranges::sort(by_volume);
    std::vector<std::pair<float, std::size_t>> parts;  // of the light, index
    float left = 1.0F;
    for (const auto& [volume, light] : by_volume) {
        const float part = left * boxes[light - 1].weight(point);
        if (part > 0.0F) parts.emplace_back(part, light);
        left -= part;
    }
    if (left > 0.0F) parts.emplace_back(left, 0);
    std::ranges::sort(parts, std::greater<>());
    if (parts.size() == 1) return {.first = parts[0].second};
    const float third = parts.size() > 2 ? parts[2].first : 0.0F;
    std::array<std::pair<std::size_t, float>, 2> two;  // index, part
    for (std::size_t i = 0; i < 2; ++i) two.at(i) = {parts[i].second, parts[i].first - third};
    if (two[1].second <= 0.0F) return {.first = two[0].first};
    std::ranges::sort(two);
    return {
        .first = two[0].first, .second = two[1].first, .second_part = two[1].second / (two[0].second + two[1].second)};
}

void put_on_gpu(LitProbe& probe, const glm::dmat3& rec709_to_working) {
    probe.environment = environment_map(*probe.light.probe, rec709_to_working);
    probe.mirror = mirror_map(*probe.light.probe, rec709_to_working);
}

/// Updates the LitProbe of every volume and the frame's lights.
void Renderer::update_volumes(ecs::World& world) {
    volumes_ = gather_volumes(world);
    std::erase_if(local_probes_, [&](const auto& known) {
        return std::ranges::none_of(volumes_.probes, [&](const auto& probe) { return probe.get() == known.first; });
    });
    frame_probes_ = {&*probe_};
    for (const auto& probe : volumes_.probes) {
        LitProbe& lit = local_probes_[probe.get()];
        lit.light.probe = probe;
        frame_probes_.push_back(&lit);
    }
    const std::vector<DistantLight> distant = distant_lights(world);
    frame_lights_.clear();
    for (LitProbe* probe : frame_probes_) {
        FrameLight& light = probe->light;
        const bool changed = light.version == 0 || light.analytic_key_lights != analytic_key_lights_;
        light.analytic_key_lights = analytic_key_lights_;
        light.light_strengths = lights_.strengths;
        if (changed) update_ambient(*probe);
        if (changed || light.distant_lights != distant) light.version = ++light_version_;
        light.distant_lights = distant;
        frame_lights_.push_back(light);
    }
}

void Renderer::update_ambient(LitProbe& probe) const {
    const std::span<const lighting::KeyLight> keys = probe.light.key_lights();
    const lighting::ShLight& sh = probe.light.probe->sh;
    probe.key_irradiance.reset();
    probe.ambient = probe.light.probe->ambient;
    if (!keys.empty()) probe.ambient = lighting::ambient_coefficients(lighting::residual(sh, keys, sh.bands), keys);
}

/// Chooses the probes of each draw. Probes that light one, and the sky's, are put on the GPU.
void Renderer::choose_probes(Frame& frame) {
    frame.lit.assign(frame_probes_.size(), false);
    frame.lit[0] = true;
    bool key_lights = false;
    for (Draw& draw : frame.list.draws) {
        if ((draw.features & feature::kUnlit) != 0) continue;
        key_lights = key_lights || (draw.features & feature::kKeyLights) != 0;
        draw.light = light_at(0.5F * (draw.bounds.minimum + draw.bounds.maximum), volumes_.boxes);
        if (draw.light.is_local()) draw.features |= feature::kLocalProbe | feature::kLightPart;
        frame.lit[draw.light.first] = true;
        if (draw.light.has_second()) frame.lit[draw.light.second] = true;
    }
    for (std::size_t i = 0; i < frame_probes_.size(); ++i) {
        if (!frame.lit[i]) continue;
        LitProbe& probe = *frame_probes_[i];
        if (!probe.environment) put_on_gpu(probe, rec709_to_working_);
        // A program with KEY_LIGHTS reads the map also of a probe that has none.
        if (key_lights && !probe.key_irradiance)
            probe.key_irradiance = key_irradiance_map(probe.light.key_lights(), rec709_to_working_);
    }
}

void Renderer::bind_probe(const Frame& frame, std::size_t index) const {
    const LitProbe& probe = *frame_probes_[index];
    frame_data_.bind_uniform(kFrameBinding, frame.frame_offsets[index], sizeof(FrameBlock));
    probe.environment->map.bind(kEnvironmentUnit);
    probe.mirror.bind(kMirrorUnit);
    if (probe.key_irradiance) probe.key_irradiance->map.bind(kKeyIrradianceUnit);
}

}  // namespace rowland::render
