#pragma once

#include <glm/mat3x3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/demo/looks/look.h"
#include "engine/ecs/world.h"
#include "engine/gpu/texture.h"

namespace rowland::demo {

enum class Side { Left, Right };

/// Shows gratings in looks of the user's choice: one per object, or two, left and right of a vertical line (a wipe).
/// The objects' own materials are kept: an object whose material is reloaded keeps its looks, and a new object gets
/// those that were chosen for all.
class Comparison {
 public:
    /// `world` must outlive it. `xyz_to_working` as the renderer's.
    Comparison(ecs::World& world, const glm::dmat3& xyz_to_working);

    bool wiping() const { return wiping_; }
    void set_wiping(bool on) { wiping_ = on; }
    /// Position of the line, from 0 (left) to 1 (right).
    float line() const { return line_; }
    void set_line(float position);

    /// The gratings of the world, without the copies that a wipe draws.
    std::vector<ecs::Entity> gratings();
    bool is_grating(ecs::Entity entity);
    bool is_copy(ecs::Entity entity);
    const Look& look(ecs::Entity grating, Side side);
    /// A look that does not suit the object is replaced by the object's own look.
    void set_look(ecs::Entity grating, Side side, const Look& look);
    void set_look_of_all(Side side, const Look& look);
    /// What decides which looks suit an object.
    LookSubject subject(ecs::Entity grating);
    /// The material that an object shows on a side; the last one while a new one is baked.
    GpuMaterialPointer shown(ecs::Entity grating, Side side);
    diffraction::GrooveLayout layout(ecs::Entity grating);
    /// Names the representation that draws an object on a side: "arc (cooked)", "spikes, fine", or, where its mesh
    /// forces another than the material has, "arc in place of planar".
    std::string title(ecs::Entity grating, Side side);
    /// The object's own material.
    GpuMaterialPointer own(ecs::Entity grating);
    /// A picture (as for GpuPicture) that all gratings show right of the line in place of their looks; null: none.
    /// Gratings whose grooves vary keep their looks.
    void set_reference_picture(std::shared_ptr<const gpu::Texture> picture) { reference_picture_ = std::move(picture); }
    bool shows_reference_picture() const { return reference_picture_ != nullptr; }
    bool baking() const { return variants_.baking(); }

    /// To be called once per frame, between the update of world matrices and drawing.
    void update();

 private:
    struct Looks;
    struct CopyOf;
    Looks& looks_of_grating(ecs::Entity grating);
    void show(ecs::Entity grating);
    void show_copy(ecs::Entity grating);
    GpuMaterialPointer material_of_copy(ecs::Entity grating);
    void remove_copy(ecs::Entity grating);
    void remove_orphans();

    ecs::World& world_;
    Variants variants_;
    std::shared_ptr<const gpu::Texture> reference_picture_;
    Look left_of_all_;
    Look right_of_all_;
    bool wiping_ = false;
    float line_ = 0.5F;
};

}  // namespace rowland::demo
