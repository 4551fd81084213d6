#include "content/demo/looks/comparison.h"

#include <algorithm>

#include "engine/render/draw_list.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/scene/animation.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::demo {

using diffraction::DiffractionSurface;

/// Component of a grating: its looks, and the materials that show them.
struct Comparison::Looks {
    Look left;
    Look right;
    GpuMaterialPointer own{};               ///< the object's own material
    GpuMaterialPointer assigned{};          ///< by the last update(); if the surface has another, that is its new `own`
    GpuMaterialPointer right_material{};    ///< shown by the copy
    GpuMaterialPointer picture_material{};  ///< shows `picture` in place of `picture_own`
    std::shared_ptr<const gpu::Texture> picture{};
    GpuMaterialPointer picture_own{};
    std::shared_ptr<const scene::Mesh> mesh{};
    std::shared_ptr<const diffraction::GrooveMap> grooves{};
    diffraction::GrooveLayout layout{};  ///< of `mesh` with `grooves`

    bool flat() const { return layout != diffraction::GrooveLayout::Curved; }
    std::optional<ecs::Entity> copy{};
};

/// Component of the copy of a grating that shows its right look.
struct Comparison::CopyOf {
    ecs::Entity grating;
};

Comparison::Comparison(ecs::World& world, const glm::dmat3& xyz_to_working)
    : world_(world), variants_(xyz_to_working) {}

void Comparison::set_line(float position) {
    line_ = std::clamp(position, 0.0F, 1.0F);
}

std::vector<ecs::Entity> Comparison::gratings() {
    std::vector<ecs::Entity> found;
    world_.view<DiffractionSurface, render::MeshInstance>(ecs::Exclude<CopyOf>{})
        .each([&](ecs::Entity entity, const DiffractionSurface&, const render::MeshInstance&) {
            found.push_back(entity);
        });
    // A wipe reorders the world's components.
    std::ranges::sort(found, {}, [](ecs::Entity entity) { return entity.index; });
    return found;
}

bool Comparison::is_grating(ecs::Entity entity) {
    return world_.find<DiffractionSurface>(entity) != nullptr && world_.find<CopyOf>(entity) == nullptr;
}

bool Comparison::is_copy(ecs::Entity entity) {
    return world_.find<CopyOf>(entity) != nullptr;
}

GpuMaterialPointer Comparison::own(ecs::Entity grating) {
    return looks_of_grating(grating).own;
}

Comparison::Looks& Comparison::looks_of_grating(ecs::Entity grating) {
    if (world_.find<Looks>(grating) == nullptr)
        world_.add(grating, Looks{.left = left_of_all_, .right = right_of_all_});
    Looks& looks = world_.get<Looks>(grating);
    const DiffractionSurface& surface = world_.get<DiffractionSurface>(grating);
    if (surface.material != looks.assigned) looks.own = surface.material;
    looks.assigned = surface.material;
    const render::MeshInstance& instance = world_.get<render::MeshInstance>(grating);
    if (looks.mesh != instance.mesh || looks.grooves != surface.grooves) {
        looks.mesh = instance.mesh;
        looks.grooves = surface.grooves;
        const bool skinned = world_.find<scene::Skin>(grating) != nullptr;
        looks.layout = diffraction::groove_layout(*looks.mesh, skinned, looks.grooves != nullptr);
    }
    return looks;
}

const Look& Comparison::look(ecs::Entity grating, Side side) {
    Looks& looks = looks_of_grating(grating);
    return side == Side::Left ? looks.left : looks.right;
}

void Comparison::set_look(ecs::Entity grating, Side side, const Look& look) {
    const bool suits = apply_look(subject(grating), look).has_value();
    Looks& looks = looks_of_grating(grating);
    (side == Side::Left ? looks.left : looks.right) = suits ? look : Look{.representation = {}, .detail = look.detail};
}

void Comparison::set_look_of_all(Side side, const Look& look) {
    (side == Side::Left ? left_of_all_ : right_of_all_) = look;
    for (const ecs::Entity grating : gratings()) set_look(grating, side, look);
}

LookSubject Comparison::subject(ecs::Entity grating) {
    const Looks& looks = looks_of_grating(grating);
    return {.material = looks.own->cooked()->material, .flat = looks.flat(), .grooves = looks.grooves};
}

GpuMaterialPointer Comparison::shown(ecs::Entity grating, Side side) {
    const Looks& looks = looks_of_grating(grating);
    return side == Side::Right && looks.right_material ? looks.right_material : looks.assigned;
}

diffraction::GrooveLayout Comparison::layout(ecs::Entity grating) {
    return looks_of_grating(grating).layout;
}

std::string Comparison::title(ecs::Entity grating, Side side) {
    const diffraction::BakedTables& tables = shown(grating, side)->cooked()->tables;
    const Look& chosen = look(grating, side);
    const std::string drawn = drawn_info(tables, layout(grating)).name;
    if (drawn != info(tables).name) return drawn + " in place of " + info(tables).name;
    return chosen.own() ? drawn + " (cooked)" : look_name(chosen);
}

void Comparison::update() {
    variants_.poll();
    remove_orphans();
    for (const ecs::Entity grating : gratings()) {
        show(grating);
        wiping_ ? show_copy(grating) : remove_copy(grating);
    }
}

void Comparison::show(ecs::Entity grating) {
    Looks& looks = looks_of_grating(grating);
    DiffractionSurface& surface = world_.get<DiffractionSurface>(grating);
    if (const auto wanted = variants_.find_or_bake(looks.own, surface.grooves, looks.flat(), looks.left)) {
        surface.material = wanted;
        looks.assigned = wanted;
    }
}

GpuMaterialPointer Comparison::material_of_copy(ecs::Entity grating) {
    Looks& looks = looks_of_grating(grating);
    const auto& grooves = world_.get<DiffractionSurface>(grating).grooves;
    if (!looks.right_material) looks.right_material = looks.own;
    if (const auto wanted = variants_.find_or_bake(looks.own, grooves, looks.flat(), looks.right))
        looks.right_material = wanted;
    if (!reference_picture_ || grooves) return looks.right_material;
    if (looks.picture != reference_picture_ || looks.picture_own != looks.own) {
        looks.picture = reference_picture_;
        looks.picture_own = looks.own;
        looks.picture_material = std::make_shared<const diffraction::GpuPicture>(
            *looks.own->cooked(), reference_picture_, variants_.xyz_to_working());
    }
    return looks.picture_material;
}

void Comparison::show_copy(ecs::Entity grating) {
    if (!looks_of_grating(grating).copy) {
        const ecs::Entity made = world_.create();
        world_.add(made, CopyOf{grating});
        looks_of_grating(grating).copy = made;
    }
    Looks& looks = looks_of_grating(grating);
    const ecs::Entity copy = *looks.copy;
    DiffractionSurface surface = world_.get<DiffractionSurface>(grating);
    surface.material = material_of_copy(grating);
    world_.add(copy, surface);
    world_.add(copy, render::MeshInstance(world_.get<render::MeshInstance>(grating)));
    world_.add(copy, render::StandardMaterial(world_.get<render::StandardMaterial>(grating)));
    if (const auto* matrix = world_.find<scene::WorldMatrix>(grating)) world_.add(copy, scene::WorldMatrix(*matrix));
    if (const auto* skin = world_.find<scene::Skin>(grating)) world_.add(copy, scene::Skin(*skin));
    world_.add(grating, render::PictureColumns{.begin = 0.0F, .end = line_});
    world_.add(copy, render::PictureColumns{.begin = line_, .end = 1.0F});
}

void Comparison::remove_copy(ecs::Entity grating) {
    Looks& looks = looks_of_grating(grating);
    if (!looks.copy) return;
    const ecs::Entity copy = *looks.copy;
    looks.copy.reset();
    looks.right_material.reset();
    if (world_.alive(copy)) world_.destroy(copy);
    if (world_.find<render::PictureColumns>(grating) != nullptr) world_.remove<render::PictureColumns>(grating);
}

void Comparison::remove_orphans() {
    std::vector<ecs::Entity> orphans;
    world_.view<CopyOf>().each([&](ecs::Entity copy, const CopyOf& of) {
        if (!world_.alive(of.grating) || world_.find<DiffractionSurface>(of.grating) == nullptr)
            orphans.push_back(copy);
    });
    for (const ecs::Entity copy : orphans) world_.destroy(copy);
}

}  // namespace rowland::demo
