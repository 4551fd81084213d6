#include "content/demo/looks/comparison.h"

#include <algorithm>

#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/render/picture_columns.h"
#include "engine/scene/skin.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/diffraction/runtime/flatness.h"
#include "modules/diffraction/runtime/gpu_still.h"

namespace rowland::demo {

using diffraction::DiffractionSurface;

/// Component of a grating.
struct Comparison::Looks {
    Look left;
    Look right;
    GpuMaterialPointer own{};                     ///< the object's own material
    GpuMaterialPointer assigned{};                ///< what we gave it last: another one now is a new own
    GpuMaterialPointer of_right{};                ///< what its twin shows
    std::shared_ptr<const gpu::Texture> still{};  ///< that still_material shows
    GpuMaterialPointer still_of{};
    GpuMaterialPointer still_material{};
    std::shared_ptr<const scene::Mesh> mesh{};
    bool flat = false;  ///< that mesh
    std::optional<ecs::Entity> twin{};
};

/// Component of what stands in a grating's place to show its other look.
struct Comparison::TwinOf {
    ecs::Entity grating;
};

Comparison::Comparison(ecs::World& world, const glm::dmat3& xyz_to_working)
    : world_(world), variants_(xyz_to_working) {}

void Comparison::set_line(float share) {
    line_ = std::clamp(share, 0.0F, 1.0F);
}

std::vector<ecs::Entity> Comparison::gratings() {
    std::vector<ecs::Entity> found;
    world_.view<DiffractionSurface, render::MeshInstance>(ecs::Exclude<TwinOf>{})
        .each([&](ecs::Entity entity, const DiffractionSurface&, const render::MeshInstance&) {
            found.push_back(entity);
        });
    return found;
}

bool Comparison::is_grating(ecs::Entity entity) {
    return world_.find<DiffractionSurface>(entity) != nullptr && world_.find<TwinOf>(entity) == nullptr;
}

bool Comparison::is_twin(ecs::Entity entity) {
    return world_.find<TwinOf>(entity) != nullptr;
}

GpuMaterialPointer Comparison::own(ecs::Entity grating) {
    return looks_of_grating(grating).own;
}

Comparison::Looks& Comparison::looks_of_grating(ecs::Entity grating) {
    if (world_.find<Looks>(grating) == nullptr)
        world_.add(grating, Looks{.left = left_of_all_, .right = right_of_all_});
    Looks& looks = world_.get<Looks>(grating);
    const GpuMaterialPointer& present = world_.get<DiffractionSurface>(grating).material;
    if (present != looks.assigned) looks.own = present;
    looks.assigned = present;
    const render::MeshInstance& instance = world_.get<render::MeshInstance>(grating);
    if (looks.mesh != instance.mesh) {
        looks.mesh = instance.mesh;
        looks.flat = diffraction::flat_normal(*instance.mesh).has_value();
    }
    return looks;
}

const Look& Comparison::look(ecs::Entity grating, Side side) {
    Looks& looks = looks_of_grating(grating);
    return side == Side::Left ? looks.left : looks.right;
}

void Comparison::set_look(ecs::Entity grating, Side side, const Look& look) {
    const bool suits = with_look(subject(grating), look).has_value();
    Looks& looks = looks_of_grating(grating);
    (side == Side::Left ? looks.left : looks.right) = suits ? look : Look{.representation = {}, .detail = look.detail};
}

void Comparison::set_look_of_all(Side side, const Look& look) {
    (side == Side::Left ? left_of_all_ : right_of_all_) = look;
    for (const ecs::Entity grating : gratings()) set_look(grating, side, look);
}

LookSubject Comparison::subject(ecs::Entity grating) {
    const Looks& looks = looks_of_grating(grating);
    return {.material = looks.own->cooked()->material,
            .flat = looks.flat,
            .grooves = world_.get<DiffractionSurface>(grating).grooves};
}

GpuMaterialPointer Comparison::shown(ecs::Entity grating, Side side) {
    const Looks& looks = looks_of_grating(grating);
    return side == Side::Right && looks.of_right ? looks.of_right : looks.assigned;
}

void Comparison::update() {
    variants_.poll();
    remove_orphans();
    for (const ecs::Entity grating : gratings()) {
        show(grating);
        if (wiping_) {
            show_twin(grating);
        } else {
            remove_twin(grating);
        }
    }
}

void Comparison::show(ecs::Entity grating) {
    Looks& looks = looks_of_grating(grating);
    DiffractionSurface& surface = world_.get<DiffractionSurface>(grating);
    if (const auto wanted = variants_.find(looks.own, surface.grooves, looks.flat, looks.left)) {
        surface.material = wanted;
        looks.assigned = wanted;
    }
}

GpuMaterialPointer Comparison::material_of_twin(ecs::Entity grating) {
    Looks& looks = looks_of_grating(grating);
    const auto& grooves = world_.get<DiffractionSurface>(grating).grooves;
    if (!looks.of_right) looks.of_right = looks.own;
    if (const auto wanted = variants_.find(looks.own, grooves, looks.flat, looks.right)) looks.of_right = wanted;
    if (!still_ || grooves) return looks.of_right;
    if (looks.still != still_ || looks.still_of != looks.own) {
        looks.still = still_;
        looks.still_of = looks.own;
        looks.still_material =
            std::make_shared<const diffraction::GpuStill>(*looks.own->cooked(), still_, variants_.xyz_to_working());
    }
    return looks.still_material;
}

void Comparison::show_twin(ecs::Entity grating) {
    if (!looks_of_grating(grating).twin) {
        const ecs::Entity made = world_.create();
        world_.add(made, TwinOf{grating});
        looks_of_grating(grating).twin = made;
    }
    Looks& looks = looks_of_grating(grating);
    const ecs::Entity twin = *looks.twin;
    DiffractionSurface surface = world_.get<DiffractionSurface>(grating);
    surface.material = material_of_twin(grating);
    world_.add(twin, surface);
    world_.add(twin, render::MeshInstance(world_.get<render::MeshInstance>(grating)));
    world_.add(twin, render::StandardMaterial(world_.get<render::StandardMaterial>(grating)));
    if (const auto* matrix = world_.find<scene::WorldMatrix>(grating)) world_.add(twin, scene::WorldMatrix(*matrix));
    if (const auto* skin = world_.find<scene::Skin>(grating)) world_.add(twin, scene::Skin(*skin));
    world_.add(grating, render::PictureColumns{.begin = 0.0F, .end = line_});
    world_.add(twin, render::PictureColumns{.begin = line_, .end = 1.0F});
}

void Comparison::remove_twin(ecs::Entity grating) {
    Looks& looks = looks_of_grating(grating);
    if (!looks.twin) return;
    const ecs::Entity twin = *looks.twin;
    looks.twin.reset();
    looks.of_right.reset();
    if (world_.alive(twin)) world_.destroy(twin);
    if (world_.find<render::PictureColumns>(grating) != nullptr) world_.remove<render::PictureColumns>(grating);
}

void Comparison::remove_orphans() {
    std::vector<ecs::Entity> orphans;
    world_.view<TwinOf>().each([&](ecs::Entity twin, const TwinOf& of) {
        if (!world_.alive(of.grating) || world_.find<DiffractionSurface>(of.grating) == nullptr)
            orphans.push_back(twin);
    });
    for (const ecs::Entity twin : orphans) world_.destroy(twin);
}

}  // namespace rowland::demo
