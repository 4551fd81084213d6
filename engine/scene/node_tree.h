#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "engine/scene/gltf_document.h"

namespace rowland::scene {

/// A node of the scene that is shown, with its world matrix.
struct PlacedNode {
    std::size_t node = 0;
    glm::dmat4 world{1.0};
    std::optional<std::size_t> parent;  ///< an earlier one of the placed nodes
};

/// All nodes below the document's roots, parents before their children. Throws Error (input) if a node is reached twice
/// (a cycle, or two parents) or if a transform overflows.
std::vector<PlacedNode> placed_nodes(const GltfDocument& document);

}  // namespace rowland::scene
