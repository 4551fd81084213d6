#pragma once

#include <glm/mat3x3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/demo/looks/look.h"
#include "content/demo/looks/variants.h"
#include "engine/ecs/world.h"
#include "engine/gpu/texture.h"

namespace rowland::demo {

enum class Side { Left, Right };

/// Shows gratings in looks of the user's choice: one for each object, or two that share the picture at a vertical line
/// (a wipe). The objects' own materials are not lost: an object whose material is loaded anew keeps its looks, and one
/// that is new has those that were chosen for all.
class Comparison {
 public:
    /// `world` must outlive it. `xyz_to_working` as the renderer's.
    Comparison(ecs::World& world, const glm::dmat3& xyz_to_working);

    bool wiping() const { return wiping_; }
    void set_wiping(bool on) { wiping_ = on; }
    /// Share of the picture's width, from its left, 0 to 1.
    float line() const { return line_; }
    void set_line(float share);

    /// The gratings of the world; twins that a wipe draws are none.
    std::vector<ecs::Entity> gratings();
    bool is_grating(ecs::Entity entity);
    bool is_twin(ecs::Entity entity);
    const Look& look(ecs::Entity grating, Side side);
    /// Its own where the look does not suit the object.
    void set_look(ecs::Entity grating, Side side, const Look& look);
    void set_look_of_all(Side side, const Look& look);
    /// Of an object, for looks_of() and the like.
    LookSubject subject(ecs::Entity grating);
    /// The material that an object shows on a side now; the last one while a new one is baked.
    GpuMaterialPointer shown(ecs::Entity grating, Side side);
    /// The object's own material.
    GpuMaterialPointer own(ecs::Entity grating);
    /// What all gratings show right of the line in place of their looks: a picture as GpuStill takes it; null: nothing.
    /// Gratings whose grooves vary keep their looks.
    void set_still(std::shared_ptr<const gpu::Texture> still) { still_ = std::move(still); }
    bool shows_still() const { return still_ != nullptr; }
    bool baking() const { return variants_.baking(); }

    /// Once a frame, after world matrices are up to date and before the world is drawn.
    void update();

 private:
    struct Looks;
    struct TwinOf;
    Looks& looks_of_grating(ecs::Entity grating);
    void show(ecs::Entity grating);
    void show_twin(ecs::Entity grating);
    GpuMaterialPointer material_of_twin(ecs::Entity grating);
    void remove_twin(ecs::Entity grating);
    void remove_orphans();

    ecs::World& world_;
    Variants variants_;
    std::shared_ptr<const gpu::Texture> still_;
    Look left_of_all_;
    Look right_of_all_;
    bool wiping_ = false;
    float line_ = 0.5F;
};

}  // namespace rowland::demo
