#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/scene/gltf_document.h"

namespace rowland::scene {

/// A node of the shown scene and where it stands in the world.
struct PlacedNode {
    std::size_t node = 0;
    glm::dmat4 world{1.0};
};

/// All nodes below the document's roots. Throws Error (input) if a node is reached twice (a cycle, or two parents) or
/// if a transform overflows.
std::vector<PlacedNode> place_nodes(const GltfDocument& document);

}  // namespace rowland::scene
