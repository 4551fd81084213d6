#include "modules/diffraction/runtime/spike_surface.h"

#include <glm/mat3x3.hpp>
#include <span>
#include <string>

#include "engine/gpu/buffer.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/light_window.h"
#include "modules/diffraction/runtime/tangent_light.h"
#include "modules/diffraction/shaders/shader_files.h"

namespace rowland::diffraction {

namespace {

/// Component: the light in an object's vertex frames, and what it was computed for.
struct TangentLight {
    gpu::Buffer buffer;
    std::uint64_t light_version = 0;
    glm::mat3 orientation{0.0F};
    std::shared_ptr<const scene::Mesh> mesh;
    int bands = 0;
};

}  // namespace

void SpikeSurfaceType::add_shaders(gpu::ShaderLibrary& library) const {
    library.add_embedded(shader_files());
}

bool SpikeSurfaceType::owns(ecs::World& world, ecs::Entity entity) const {
    return world.find<SpikeSurface>(entity) != nullptr;
}

gpu::ProgramDesc SpikeSurfaceType::program(ecs::World& world, ecs::Entity entity) const {
    const GpuSpikeMaterial& material = *world.get<SpikeSurface>(entity).material;
    gpu::ProgramDesc desc;
    desc.vertex = "modules/diffraction/shaders/spikes.vert.glsl";
    desc.fragment = "modules/diffraction/shaders/spikes.frag.glsl";
    desc.defines = {{"BANDS", std::to_string(material.bands())}, {"SPIKES", std::to_string(material.spikes())}};
    return desc;
}

void SpikeSurfaceType::update(ecs::World& world, const render::FrameLight& light) {
    world.view<SpikeSurface, render::MeshInstance, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const SpikeSurface& surface, const render::MeshInstance& instance,
            const scene::WorldMatrix& world_matrix) {
            const glm::mat3 orientation(world_matrix.matrix);
            const int bands = surface.material->bands();
            if (const TangentLight* present = world.find<TangentLight>(entity);
                present && present->light_version == light.version && present->orientation == orientation &&
                present->mesh == instance.mesh && present->bands == bands)
                return;
            const std::vector<float> rotated =
                rotate_to_vertices(windowed(light, bands), *instance.mesh, world_matrix.matrix);
            world.add(entity, TangentLight{gpu::Buffer::of(std::span<const float>(rotated)), light.version, orientation,
                                           instance.mesh, bands});
        });
}

const lighting::ShLight& SpikeSurfaceType::windowed(const render::FrameLight& light, int bands) {
    if (light_version_ != light.version) windowed_.clear();
    light_version_ = light.version;
    const auto found = windowed_.find(bands);
    if (found != windowed_.end()) return found->second;
    const math::SphericalWindow window = window_ ? *window_ : mildest_window(light.sh, bands);
    return windowed_.emplace(bands, lighting::limit_bands(light.sh, bands, window)).first->second;
}

void SpikeSurfaceType::bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const {
    world.get<TangentLight>(entity).buffer.bind_storage(kTangentLightBinding);
    world.get<SpikeSurface>(entity).material->bind(program);
}

}  // namespace rowland::diffraction
