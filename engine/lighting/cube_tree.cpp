#include "engine/lighting/cube_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "engine/core/check.h"
#include "engine/lighting/environment_map.h"

namespace rowland::lighting {

namespace {

using Node = CubeTree::Node;

float luminance(const glm::vec3& rgb) {
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

std::size_t node_index(int side, int face, int column, int row) {
    const auto n = static_cast<std::size_t>(side);
    return (static_cast<std::size_t>(face) * n + static_cast<std::size_t>(row)) * n + static_cast<std::size_t>(column);
}

/// Leaves without light.
std::vector<Node> make_leaves(int side, std::size_t count) {
    ROWLAND_CHECK(std::has_single_bit(static_cast<unsigned>(side)) && side >= CubeTree::kRootSide,
                  "a cube tree's faces are powers of two of at least four texels");
    ROWLAND_CHECK_OP(count, ==, std::size_t{6} * static_cast<std::size_t>(side * side));
    std::vector<Node> leaves(count);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double solid_angle = cube_solid_angle(side, column, row);
            for (int face = 0; face < 6; ++face) {
                const std::size_t i = node_index(side, face, column, row);
                Node& leaf = leaves[i];
                leaf.solid_angle = static_cast<float>(solid_angle);
                leaf.size = static_cast<float>(std::sqrt(solid_angle));
                leaf.centre = glm::vec3(
                    glm::normalize(cube_direction(face, (2 * column + 1.0) / side - 1, (2 * row + 1.0) / side - 1)));
                leaf.source = leaf.centre;
            }
        }
    return leaves;
}

Node join(const Node* const (&children)[4]) {
    Node node;
    glm::vec3 source(0.0f);
    glm::vec3 centre(0.0f);
    for (const Node* child : children) {
        node.flux += child->flux;
        node.solid_angle += child->solid_angle;
        source += luminance(child->flux) * child->source;
        centre += child->solid_angle * child->centre;
    }
    node.size = std::sqrt(node.solid_angle);
    node.centre = glm::normalize(centre);
    const float length = glm::length(source);
    node.source = length > 0 && std::isfinite(length) ? source / length : node.centre;
    return node;
}

}  // namespace

CubeTree::CubeTree(std::span<const glm::vec3> texels, int face_size) {
    std::vector<Node> leaves = make_leaves(face_size, texels.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) leaves[i].flux = texels[i] * leaves[i].solid_angle;
    join_levels(std::move(leaves), face_size);
}

CubeTree::CubeTree(std::span<const CubeCell> cells, int face_size) {
    std::vector<Node> leaves = make_leaves(face_size, cells.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        leaves[i].flux = glm::vec3(cells[i].flux);
        if (cells[i].direction != glm::dvec3(0.0)) leaves[i].source = glm::vec3(glm::normalize(cells[i].direction));
    }
    join_levels(std::move(leaves), face_size);
}

void CubeTree::join_levels(std::vector<Node> leaves, int face_size) {
    levels_.push_back(std::move(leaves));
    for (int side = face_size / 2; side >= kRootSide; side /= 2) {
        const std::vector<Node>& finer = levels_.back();
        std::vector<Node> level(finer.size() / 4);
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < side; ++row)
                for (int column = 0; column < side; ++column) {
                    const auto child = [&](int i, int j) {
                        return &finer[node_index(2 * side, face, 2 * column + i, 2 * row + j)];
                    };
                    level[node_index(side, face, column, row)] =
                        join({child(0, 0), child(1, 0), child(0, 1), child(1, 1)});
                }
        levels_.push_back(std::move(level));
    }
    std::reverse(levels_.begin(), levels_.end());
}

}  // namespace rowland::lighting
