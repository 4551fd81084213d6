#pragma once

#include <cmath>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "engine/scene/draco_decode.h"
#include "engine/scene/gltf_document.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

struct PrimitiveImport {
    const GltfDocument& document;
    const GltfPrimitive& primitive;
    const std::string& pointer;  ///< JSON pointer
    MemoryBudget& budget;
    std::vector<std::string>& warnings;
    const DracoMesh* draco;  ///< null: not compressed

    /// Throws Error (input).
    [[noreturn]] void fail(std::string found, std::string expected) const;
    /// Adds a warning about this primitive, once.
    void warn(const std::string& text) const;
};

template <typename Vector>
bool is_finite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

/// An attribute as glm::vec2, vec3 or vec4, from the Draco stream if it is there, else from its accessor; empty if the
/// primitive has none. Throws Error (input).
template <typename Vector>
std::vector<Vector> read_attribute(const PrimitiveImport& import, const std::string& name);

/// COLOR_0 as linear RGBA, ≥ 0; empty if there is none. Throws Error (input).
std::vector<glm::vec4> read_colours(const PrimitiveImport& import);

/// JOINTS_0 and WEIGHTS_0, both empty if one of them is missing.
struct Skinning {
    std::vector<glm::u16vec4> joints;
    std::vector<glm::vec4> weights;  ///< ≥ 0, sum 1
};
/// Normalises the weights to sum 1; a vertex without positive weights follows its first joint. Throws Error (input).
Skinning read_skinning(const PrimitiveImport& import);

}  // namespace rowland::scene
