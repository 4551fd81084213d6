#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/ecs/world.h"

namespace rowland::scene {

/// Component: placement relative to the parent, or to the world if there is none. Translation in metres.
struct Transform {
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 scale{1.0F};

    glm::mat4 matrix() const;
};

/// Component: the entity that this entity's Transform is relative to.
struct Parent {
    ecs::Entity entity;
};

/// Component, written by update_world_matrices: object to world.
struct WorldMatrix {
    glm::mat4 matrix{1.0F};
};

/// System: gives every entity with a Transform its WorldMatrix. A destroyed parent is ignored; a cycle of
/// parents fails a check.
void update_world_matrices(ecs::World& world);

struct Decomposition {
    Transform transform;
    bool sheared = false;  ///< the input had shear: transform.matrix() differs from it by more than rounding
};

/// The translation, rotation and scale of a finite affine matrix. A mirroring matrix gets a negative x scale; axes of
/// length zero get scale 0 and an arbitrary direction. Shear is lost: the axes are made perpendicular, starting from x.
Decomposition decompose(const glm::dmat4& matrix);

/// Component: the name and the extras of a node in a scene file.
struct NodeMetadata {
    std::string name;       ///< not always unique; may be empty
    nlohmann::json extras;  ///< as written; null if absent
};

/// Whether extras[key] is true.
inline bool is_marked(const nlohmann::json& extras, const char* key) {
    return extras.is_object() && extras.contains(key) && extras[key] == true;
}

}  // namespace rowland::scene
