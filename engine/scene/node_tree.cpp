#include "engine/scene/node_tree.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <ranges>

#include "engine/core/error.h"

namespace rowland::scene {

namespace {

bool fits_floats(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(m[column][row]) <= static_cast<double>(std::numeric_limits<float>::max()))) return false;
    return true;
}

}  // namespace

std::vector<PlacedNode> placed_nodes(const GltfDocument& document) {
    std::vector<PlacedNode> placed;
    std::vector<bool> seen(document.nodes.size(), false);
    // Not recursive: a chain of nodes may be deeper than the thread's stack.
    std::vector<PlacedNode> pending;
    for (const std::size_t root : document.roots | std::views::reverse)
        pending.push_back({root, document.nodes.at(root).local, std::nullopt});
    while (!pending.empty()) {
        const PlacedNode current = pending.back();
        pending.pop_back();
        const std::string pointer = fmt::format("/nodes/{}", current.node);
        if (seen[current.node])
            refuse_input(document.file, pointer, "a node with two parents, or its own descendant", "a tree");
        seen[current.node] = true;
        if (!fits_floats(current.world))
            refuse_input(document.file, pointer, "a transform that overflows", "finite numbers");
        placed.push_back(current);
        for (const std::size_t child : document.nodes[current.node].children | std::views::reverse)
            pending.push_back({child, current.world * document.nodes.at(child).local, placed.size() - 1});
    }
    return placed;
}

}  // namespace rowland::scene
