#include "engine/lighting/lobe_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <span>

#include "engine/core/check.h"
#include "engine/core/embedded_file.h"
#include "engine/core/number_table.h"

namespace rowland::lighting {

std::span<const EmbeddedFile> lobe_files();

const char* const kLobeNodesHeader =
    "column,row,root1,root2,root3,root4,weight1,weight2,weight3,weight4,lean1,lean2,lean3,lean4,"
    "roughness1,roughness2,roughness3,roughness4";

namespace {

double root_of(double cosine) {
    return std::sqrt(cosine + kLobeCosineOffset);
}

std::size_t texel(int plane, int column, int row) {
    return static_cast<std::size_t>((plane * LobeNodeTable::kRows + row) * LobeNodeTable::kColumns + column);
}

using Planes = std::array<glm::dvec4, LobeNodeTable::kPlanes>;

LobeNodes nodes_of(const Planes& planes, double view_cosine, double roughness) {
    const double square = roughness * roughness;
    LobeNodes nodes;
    for (int i = 0; i < kLobeNodes; ++i) {
        const double root = root_of(view_cosine) + square * planes[0][i];
        nodes.at(static_cast<std::size_t>(i)) = {.cosine = std::clamp(root * root - kLobeCosineOffset, 0.0, 1.0),
                                                 .weight = planes[1][i],
                                                 .lean = square * planes[2][i],
                                                 .roughness = std::min(roughness * planes[3][i], 1.0)};
    }
    return nodes;
}

LobeNodeTable read_table() {
    const NumberTable numbers = parse_number_table(embedded_text(lobe_files(), "engine/lighting/lobe_nodes.csv"),
                                                   "lobe_nodes.csv", kLobeNodesHeader);
    constexpr auto kTexels = std::size_t{LobeNodeTable::kColumns} * LobeNodeTable::kRows;
    ROWLAND_CHECK_OP(numbers.rows.size(), ==, kTexels);
    LobeNodeTable table{.texels = std::vector<glm::vec4>(LobeNodeTable::kPlanes * kTexels)};
    for (const std::vector<double>& row : numbers.rows)
        for (std::size_t i = 0; i + 2 < row.size(); ++i)
            table.texels.at(texel(static_cast<int>(i) / kLobeNodes, static_cast<int>(row[0]),
                                  static_cast<int>(row[1])))[static_cast<int>(i) % kLobeNodes] =
                static_cast<float>(row[i + 2]);
    return table;
}

}  // namespace

double lobe_column(double view_cosine) {
    const double root = (root_of(view_cosine) - root_of(0.0)) / (root_of(1.0) - root_of(0.0));
    return 0.5 * (root + 1.0 - std::sqrt(1.0 - view_cosine));
}

double lobe_column_cosine(double column) {
    double below = 0.0;
    double above = 1.0;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (below + above);
        (lobe_column(middle) < column ? below : above) = middle;
    }
    return 0.5 * (below + above);
}

double LobeNodeTable::roughness(int row) {
    return std::max(std::pow(static_cast<double>(row) / (kRows - 1), 2.0), kNarrowestRoughness);
}

LobeNodes LobeNodeTable::at(double view_cosine, double roughness) const {
    const double cosine = std::clamp(view_cosine, 0.0, 1.0);
    const double rough = std::clamp(roughness, 0.0, 1.0);
    const double x = lobe_column(cosine) * (kColumns - 1);
    const double y = std::sqrt(rough) * (kRows - 1);
    const int column = std::min(static_cast<int>(x), kColumns - 2);
    const int row = std::min(static_cast<int>(y), kRows - 2);
    Planes planes;
    for (int plane = 0; plane < kPlanes; ++plane) {
        const auto value = [&](int c, int r) { return glm::dvec4(texels.at(texel(plane, c, r))); };
        const auto in_row = [&](int r) { return glm::mix(value(column, r), value(column + 1, r), x - column); };
        planes.at(static_cast<std::size_t>(plane)) = glm::mix(in_row(row), in_row(row + 1), y - row);
    }
    return nodes_of(planes, cosine, rough);
}

void LobeNodeTable::set(int column, int row, const LobeNodes& nodes) {
    const double rough = roughness(row);
    for (int i = 0; i < kLobeNodes; ++i) {
        const LobeNode& node = nodes.at(static_cast<std::size_t>(i));
        const double root = (root_of(node.cosine) - root_of(view_cosine(column))) / (rough * rough);
        const std::array<double, kPlanes> values = {root, node.weight, node.lean / (rough * rough),
                                                    node.roughness / rough};
        for (int plane = 0; plane < kPlanes; ++plane)
            texels.at(texel(plane, column, row))[i] = static_cast<float>(values.at(static_cast<std::size_t>(plane)));
    }
}

LobeNodes LobeNodeTable::get(int column, int row) const {
    Planes planes;
    for (int plane = 0; plane < kPlanes; ++plane)
        planes.at(static_cast<std::size_t>(plane)) = texels.at(texel(plane, column, row));
    return nodes_of(planes, view_cosine(column), roughness(row));
}

const LobeNodeTable& lobe_node_table() {
    static const LobeNodeTable table = read_table();
    return table;
}

}  // namespace rowland::lighting
