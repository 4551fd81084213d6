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
#include "modules/diffraction/runtime/vertex_light.h"
#include "modules/diffraction/shaders/shader_files.h"

namespace rowland::diffraction {

namespace {

/// Takes over what the object's program depends on, seen or not. Another material's data is dropped.
void take_surface(const DiffractionSurface& surface, bool mean_colour, const std::shared_ptr<const scene::Mesh>& mesh,
                  bool skinned, SurfaceState& state) {
    if (state.material != surface.material) {
        SurfaceState made;
        made.probe = state.probe;
        made.second = std::move(state.second);
        made.fades = state.fades;
        state = std::move(made);
        state.material = surface.material;
        if (surface.material->reflected()) state.reflected = std::make_unique<SurfaceState>();
    }
    if (std::exchange(state.mean_colour, mean_colour) != mean_colour) state.changed = true;
    if (state.mesh != mesh) {
        state.mesh = mesh;
        state.flat = skinned ? std::nullopt : flat_normal(*mesh);
        state.tangent = common_tangent(*mesh);
        if (surface.material->transmits()) {
            if (state.flat) state.flat = -*state.flat;
            if (state.tangent) state.tangent->w = -state.tangent->w;
        }
        state.changed = true;
    }
    if (state.groove_rotation != surface.groove_rotation || state.grooves != surface.grooves) state.changed = true;
    state.groove_rotation = surface.groove_rotation;
    state.grooves = surface.grooves;
    if (state.reflected)
        take_surface({surface.material->reflected(), surface.groove_rotation, surface.grooves}, mean_colour, mesh,
                     skinned, *state.reflected);
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
    if (state.mean_colour) {
        state.without_map = false;
        return;
    }
    if (!material.transmits() || !object.changed) return material.update(object, light, state);
    const scene::Mesh turned = turned_over(object.mesh);
    material.update({.mesh = turned,
                     .object_to_world = object.object_to_world,
                     .groove_rotation = object.groove_rotation,
                     .skinned = object.skinned,
                     .changed = object.changed,
                     .maps = object.maps,
                     .may_wait = object.may_wait},
                    light, state);
}

bool is_filling(const SurfaceState& state) {
    return state.map.is_filling() || (state.reflected && state.reflected->map.is_filling()) ||
           (state.second && is_filling(*state.second));
}

/// Sets the state of each slot to the surface as it is drawn in this frame.
void take(ecs::World& world, ecs::Entity entity) {
    DiffractionSurface surface = world.get<DiffractionSurface>(entity);
    const auto& mesh = world.get<render::MeshInstance>(entity).mesh;
    const bool skinned = world.find<scene::Skin>(entity) != nullptr;
    auto& state = world.get<SurfaceState>(entity);
    const DrawnRung* drawn = world.find<DrawnRung>(entity);
    const auto take_into = [&](const Rung* rung, SurfaceState& slot) {
        if (rung != nullptr) surface.material = rung->material;
        take_surface(surface, rung != nullptr && rung->mean_colour, mesh, skinned, slot);
    };
    take_into(drawn != nullptr ? &drawn->rung() : nullptr, state);
    if (state.second) take_into(drawn != nullptr ? &drawn->next_rung() : nullptr, *state.second);
}

SurfaceState& state_of(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) {
    return world.get<SurfaceState>(entity).in(slot);
}

/// Gives each slot the data that the object has for its probe, even if the other slot had it. `fades`: to another rung.
void take_probes(const render::LightMix& mix, bool fades, SurfaceState& state) {
    if (fades != std::exchange(state.fades, fades)) state.second.reset();
    if (fades) {
        state.probe = mix.first;
        if (!state.second) state.second = std::make_unique<SurfaceState>();
        state.second->probe = mix.first;
        return;
    }
    const bool of_other_slot =
        state.second ? state.second->probe == mix.first : mix.has_second() && state.probe == mix.second;
    if (of_other_slot) {
        auto second = state.second ? std::move(state.second) : std::make_unique<SurfaceState>();
        std::swap(state, *second);
        state.second = std::move(second);
    }
    state.probe = mix.first;
    if (!mix.has_second()) return state.second.reset();
    if (!state.second) state.second = std::make_unique<SurfaceState>();
    state.second->probe = mix.second;
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
    : xyz_to_working_(xyz_to_working), window_(settings.window), maps_(settings.map_pace, settings.map_wait) {}

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

gpu::ProgramDesc DiffractionSurfaceType::program(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const {
    const SurfaceState& state = state_of(world, entity, slot);
    return state.material->program(state);
}

std::uint64_t DiffractionSurfaceType::program_key(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const {
    const SurfaceState& state = state_of(world, entity, slot);
    return state.material->program_key(state);
}

std::uint64_t DiffractionSurfaceType::binding_key(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const {
    const SurfaceState& state = state_of(world, entity, slot);
    return state.material->binding_key(state);
}

void DiffractionSurfaceType::warn_illuminant_mismatch(const std::string& baked_for, const std::string& lit_by) {
    if (baked_for == lit_by || !warned_pairs_.emplace(baked_for, lit_by).second) return;
    log_warning("a grating baked for the illuminant {} is lit by {}: it shows the colours of {}", baked_for, lit_by,
                baked_for);
}

std::vector<render::LaterProgram> DiffractionSurfaceType::later_programs(ecs::World& world, ecs::Entity entity,
                                                                         render::ProbeSlot slot) const {
    std::vector<render::LaterProgram> programs;
    const auto add = [&](SurfaceState& side) {
        const bool without_map = std::exchange(side.without_map, false);
        programs.push_back({side.material->program(side), side.material->binding_key(side) != 0});
        side.without_map = without_map;
    };
    SurfaceState& state = state_of(world, entity, slot);
    for (SurfaceState* side : {&state, state.reflected.get()})
        if (side != nullptr && side->without_map && side->map.is_filling()) add(*side);
    DrawnRung* drawn = world.find<DrawnRung>(entity);
    if (drawn == nullptr || !control_->announces(*drawn, entity)) return programs;
    drawn->announced = control_->frame();
    for (const Rung& rung : *drawn->ladder) {
        SurfaceState as_rung;
        take_surface({rung.material, state.groove_rotation, state.grooves}, rung.mean_colour, state.mesh,
                     world.find<scene::Skin>(entity) != nullptr, as_rung);
        add(as_rung);
        if (as_rung.reflected) add(*as_rung.reflected);
    }
    return programs;
}

void DiffractionSurfaceType::update(ecs::World& world, std::span<const render::FrameLight> lights,
                                    std::span<const render::LitEntity> seen) {
    maps_.begin_frame();
    if (world.view<DiffractionSurface>().count() == 0) return;
    while (lights_.size() < lights.size()) lights_.push_back(std::make_unique<SurfaceLight>(window_));
    lights_.resize(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) lights_[i]->set(lights[i]);
    follow_budget(world, seen);
    world.view<DiffractionSurface, render::MeshInstance>().each(
        [&](ecs::Entity entity, const DiffractionSurface&, const render::MeshInstance&) {
            if (world.find<SurfaceState>(entity) == nullptr) world.add(entity, SurfaceState{});
            world.get<SurfaceState>(entity).seen = false;
            take(world, entity);
        });
    for (const render::LitEntity& lit : seen)
        if (owns(world, lit.entity)) update_seen(world, lit);
}

void DiffractionSurfaceType::follow_budget(ecs::World& world, std::span<const render::LitEntity> seen) {
    std::optional<ecs::Entity> holder;
    world.view<FrameBudget>().each([&](ecs::Entity entity, const FrameBudget&) { holder = entity; });
    if (!holder) {
        if (std::exchange(control_, nullptr) == nullptr) return;
        std::vector<ecs::Entity> with_rung;
        world.view<DrawnRung>().each([&](ecs::Entity entity, const DrawnRung&) { with_rung.push_back(entity); });
        for (const ecs::Entity entity : with_rung) world.remove<DrawnRung>(entity);
        return;
    }
    if (!control_) control_ = std::make_unique<RungControl>(xyz_to_working_);
    control_->choose(world, seen, world.get<FrameBudget>(*holder).gratings_ms);
    int fading = 0;
    world.view<DrawnRung, SurfaceState>().each([&](ecs::Entity, DrawnRung& drawn, SurfaceState& state) {
        control_->step_fade(drawn, state);
        if (drawn.changes()) ++fading;
    });
    FrameBudgetReport report = control_->report();
    report.fading = fading;
    world.add(*holder, report);
}

void DiffractionSurfaceType::update_seen(ecs::World& world, const render::LitEntity& lit) {
    const auto& surface = world.get<DiffractionSurface>(lit.entity);
    auto& state = world.get<SurfaceState>(lit.entity);
    const DrawnRung* drawn = world.find<DrawnRung>(lit.entity);
    take_probes(lit.light, drawn != nullptr && drawn->changes() && !lit.light.has_second(), state);
    take(world, lit.entity);
    state.seen = true;
    for (SurfaceState* slot : {&state, state.second.get()}) {
        if (slot == nullptr) continue;
        SurfaceLight& light = *lights_[slot->probe];
        warn_illuminant_mismatch(surface.material->illuminant(), light.illuminant());
        const float part = slot == &state ? 1.0F - lit.light.second_part : lit.light.second_part;
        update_lit(world, lit.entity, light, *slot, part >= 0.5F && !(slot != &state && state.fades));
    }
}

void DiffractionSurfaceType::update_lit(ecs::World& world, ecs::Entity entity, SurfaceLight& light, SurfaceState& state,
                                        bool may_wait) {
    const glm::mat4& matrix = world.get<scene::WorldMatrix>(entity).matrix;
    state.changed = state.changed || state.orientation != glm::mat3(matrix) || state.light_version != light.version();
    state.orientation = glm::mat3(matrix);
    state.light_version = light.version();
    const auto update_sides = [&](const scene::Mesh& mesh, bool skinned) {
        const SurfaceObject object{.mesh = mesh,
                                   .object_to_world = matrix,
                                   .groove_rotation = static_cast<double>(state.groove_rotation),
                                   .skinned = skinned,
                                   .changed = state.changed || skinned,
                                   .maps = maps_,
                                   .may_wait = may_wait};
        update_lit_side(*state.material, object, light, state);
        if (state.reflected) state.reflected->material->update(object, light, *state.reflected);
    };
    if (const scene::Skin* skin = world.find<scene::Skin>(entity))
        update_sides(scene::posed(*state.mesh, scene::joint_matrices(world, *skin)), true);
    else
        update_sides(*state.mesh, false);
    if (std::exchange(state.changed, false) || is_filling(state)) ++version_;
}

bool maps_are_filling(ecs::World& world) {
    bool filling = false;
    world.view<SurfaceState>().each(
        [&](ecs::Entity, const SurfaceState& state) { filling = filling || (state.seen && is_filling(state)); });
    return filling;
}

std::optional<gpu::ProgramDesc> DiffractionSurfaceType::overlay_program(ecs::World& world, ecs::Entity entity,
                                                                        render::ProbeSlot slot) const {
    const SurfaceState& state = state_of(world, entity, slot);
    if (!state.reflected) return std::nullopt;
    return state.reflected->material->program(*state.reflected);
}

void DiffractionSurfaceType::bind_overlay(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
                                          const gpu::Program& program) const {
    const SurfaceState& state = state_of(world, entity, slot);
    state.reflected->material->bind(program, light_of(state), *state.reflected);
}

void DiffractionSurfaceType::bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
                                  const gpu::Program& program) const {
    const SurfaceState& state = state_of(world, entity, slot);
    state.material->bind(program, light_of(state), state);
}

}  // namespace rowland::diffraction
