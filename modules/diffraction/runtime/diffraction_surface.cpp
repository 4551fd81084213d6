#include "modules/diffraction/runtime/diffraction_surface.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/animation.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/shaders/shader_files.h"

namespace rowland::diffraction {

namespace {

/// Updates the cache key in `state`; true if it changes. Another material's data is dropped.
bool update_key(const DiffractionSurface& surface, const render::MeshInstance& instance, const glm::mat3& orientation,
                std::uint64_t light_version, SurfaceState& state) {
    const bool same = state.material == surface.material && state.mesh == instance.mesh &&
                      state.orientation == orientation && state.groove_rotation == surface.groove_rotation &&
                      state.grooves == surface.grooves && state.light_version == light_version;
    if (state.material != surface.material) state = {};
    state.material = surface.material;
    state.mesh = instance.mesh;
    state.orientation = orientation;
    state.groove_rotation = surface.groove_rotation;
    state.grooves = surface.grooves;
    state.light_version = light_version;
    return !same;
}

/// The same surface seen from its other side.
scene::Mesh turned_over(const scene::Mesh& mesh) {
    scene::Mesh turned = mesh;
    for (glm::vec3& normal : turned.normals) normal = -normal;
    for (glm::vec4& tangent : turned.tangents) tangent.w = -tangent.w;  // the bitangent stays
    return turned;
}

/// A sheet that transmits is lit on its other side (PHYSICS §12). Only a changed object's mesh is read.
void update_lit_side(const GpuMaterial& material, const SurfaceObject& object, SurfaceLight& light,
                     SurfaceState& state) {
    if (!material.transmits() || !object.changed) return material.update(object, light, state);
    const scene::Mesh turned = turned_over(object.mesh);
    material.update({.mesh = turned,
                     .object_to_world = object.object_to_world,
                     .groove_rotation = object.groove_rotation,
                     .skinned = object.skinned,
                     .changed = object.changed,
                     .map_pace = object.map_pace},
                    light, state);
}

void update_sides(const DiffractionSurface& surface, const SurfaceObject& object, SurfaceLight& light,
                  SurfaceState& state) {
    update_lit_side(*surface.material, object, light, state);
    const std::shared_ptr<const GpuMaterial>& reflecting = surface.material->reflected();
    if (!reflecting) return;
    if (!state.reflected) state.reflected = std::make_unique<SurfaceState>();
    SurfaceState& reflected = *state.reflected;
    reflected.material = reflecting;
    reflected.mesh = state.mesh;
    reflected.groove_rotation = state.groove_rotation;
    reflected.grooves = state.grooves;
    reflecting->update(object, light, reflected);
}

bool is_filling(const GpuMaterial& material, const SurfaceState& state) {
    return material.filling(state) || (state.reflected && material.reflected()->filling(*state.reflected));
}

}  // namespace

void add_surface(ecs::World& world, ecs::Entity entity, DiffractionSurface surface, bool has_base) {
    const render::StandardMaterial base = surface.material->base();
    world.add(entity, std::move(surface));
    auto& material = world.get<render::StandardMaterial>(entity);
    material.clear_coat = 0.0F;
    material.passes_light = base.passes_light;
    if (has_base) world.add(entity, render::StandardMaterial(base));
}

DiffractionSurfaceType::DiffractionSurfaceType(const glm::dmat3& xyz_to_working, const DiffractionSettings& settings)
    : xyz_to_working_(xyz_to_working), map_pace_(settings.map_pace), light_(settings.window) {}

std::string DiffractionSurfaceType::gltf_extension() const {
    return kGltfExtension;
}

void DiffractionSurfaceType::attach(ecs::World& world, ecs::Entity entity, const render::MaterialExtension& extension,
                                    render::SurfaceTextures& textures) {
    const auto& [object, description, file, pointer] = extension;
    const GroovePlacement placement = parse_groove_placement(object, file, pointer);
    DiffractionSurface surface{.groove_rotation = static_cast<float>(placement.groove_rotation)};
    if (placement.groove_texture) surface.grooves = groove_map(*placement.groove_texture, extension, textures);
    if (world.get<render::StandardMaterial>(entity).clear_coat > 0.0F)
        log_warning("{}: {}: KHR_materials_clearcoat beside a grating is not drawn: a grating's gloss is its cover's",
                    file, pointer);
    surface.material = uploaded(extension.tables(kGltfExtension), file + ": " + pointer);
    add_surface(world, entity, std::move(surface), placement.has_base);
}

std::shared_ptr<const GrooveMap> DiffractionSurfaceType::groove_map(const GrooveTexture& use,
                                                                    const render::MaterialExtension& extension,
                                                                    render::SurfaceTextures& textures) {
    auto made = std::make_shared<const GrooveMap>(use, textures, extension.file, extension.pointer + "/grooveTexture");
    std::weak_ptr<const GrooveMap>& kept = groove_maps_[{made->image(), extension.object["grooveTexture"].dump()}];
    if (auto present = kept.lock()) return present;
    kept = made;
    return made;
}

std::shared_ptr<const GpuMaterial> DiffractionSurfaceType::uploaded(const std::vector<std::byte>& tables,
                                                                    const std::string& file) {
    std::weak_ptr<const GpuMaterial>& kept = uploaded_[Hasher().bytes(tables).digest().hex()];
    if (auto present = kept.lock()) return present;
    auto made = make_gpu_material(read_gltf_tables(tables, file), xyz_to_working_);
    kept = made;
    return made;
}

void DiffractionSurfaceType::add_shaders(gpu::ShaderLibrary& library) const {
    library.add_embedded(shader_files());
}

bool DiffractionSurfaceType::owns(ecs::World& world, ecs::Entity entity) const {
    return world.find<DiffractionSurface>(entity) != nullptr;
}

gpu::ProgramDesc DiffractionSurfaceType::program(ecs::World& world, ecs::Entity entity) const {
    return world.get<DiffractionSurface>(entity).material->program(world.get<SurfaceState>(entity));
}

void DiffractionSurfaceType::warn_illuminant_mismatch(const std::string& baked_for, const std::string& lit_by) {
    if (baked_for == lit_by || !warned_pairs_.emplace(baked_for, lit_by).second) return;
    log_warning("a grating baked for the illuminant {} is lit by {}: it shows the colours of {}", baked_for, lit_by,
                baked_for);
}

void DiffractionSurfaceType::update(ecs::World& world, const render::FrameLight& light) {
    if (world.view<DiffractionSurface>().count() == 0) return;
    light_.set(light);
    world.view<DiffractionSurface, render::MeshInstance, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const DiffractionSurface& surface, const render::MeshInstance& instance,
            const scene::WorldMatrix& world_matrix) {
            if (world.find<SurfaceState>(entity) == nullptr) world.add(entity, SurfaceState{});
            SurfaceState& state = world.get<SurfaceState>(entity);
            warn_illuminant_mismatch(surface.material->illuminant(), light_.illuminant());
            const bool changed = update_key(surface, instance, glm::mat3(world_matrix.matrix), light_.version(), state);
            const auto update_surface = [&](const scene::Mesh& mesh, bool skinned) {
                update_sides(surface,
                             {.mesh = mesh,
                              .object_to_world = world_matrix.matrix,
                              .groove_rotation = static_cast<double>(surface.groove_rotation),
                              .skinned = skinned,
                              .changed = changed || skinned,
                              .map_pace = map_pace_},
                             light_, state);
            };
            if (const scene::Skin* skin = world.find<scene::Skin>(entity))
                update_surface(scene::posed(*instance.mesh, scene::joint_matrices(world, *skin)), true);
            else
                update_surface(*instance.mesh, false);
            if (changed || is_filling(*surface.material, state)) ++version_;
        });
}

bool maps_are_filling(ecs::World& world) {
    bool filling = false;
    world.view<DiffractionSurface, SurfaceState>().each(
        [&](ecs::Entity, const DiffractionSurface& surface, const SurfaceState& state) {
            filling = filling || is_filling(*surface.material, state);
        });
    return filling;
}

std::optional<gpu::ProgramDesc> DiffractionSurfaceType::overlay_program(ecs::World& world, ecs::Entity entity) const {
    const SurfaceState& state = world.get<SurfaceState>(entity);
    if (!state.reflected) return std::nullopt;
    return state.reflected->material->program(*state.reflected);
}

void DiffractionSurfaceType::bind_overlay(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const {
    const SurfaceState& reflected = *world.get<SurfaceState>(entity).reflected;
    reflected.material->bind(program, light_, reflected);
}

void DiffractionSurfaceType::bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const {
    world.get<DiffractionSurface>(entity).material->bind(program, light_, world.get<SurfaceState>(entity));
}

}  // namespace rowland::diffraction
