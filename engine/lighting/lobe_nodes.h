#pragma once

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

namespace rowland::lighting {

inline constexpr int kLobeNodes = 4;

/// A part of a rough surface's microfacets, for one view: the angle at which they are met, and where the light that
/// they reflect is looked up in an EnvironmentMap. Along (1 − lean) · the mirror's direction + lean · the normal, the
/// lobe of a roughness of its own.
struct LobeNode {
    double cosine = 1.0;
    double weight = 0.0;  ///< of a lobe's nodes they sum to 1
    double lean = 0.0;
    double roughness = 0.0;
};
using LobeNodes = std::array<LobeNode, kLobeNodes>;

/// Where the table below has a view, 0 to 1: steep at grazing and at normal incidence, where lobes change most.
double lobe_column(double view_cosine);
/// The inverse.
double lobe_column_cosine(double column);

/// √(cosine + this) is nearly even in what it resolves of films and lobes: its slope at grazing incidence is finite.
inline constexpr double kLobeCosineOffset = 0.02;

/// Nodes of all views and roughnesses of the GGX lobe with height-correlated Smith visibility.
struct LobeNodeTable {
    static constexpr int kColumns = 32;  ///< of lobe_column()
    static constexpr int kRows = 24;     ///< of the root of the perceptual roughness, 0 to 1
    /// Of narrower lobes only the width differs, in proportion to roughness².
    static constexpr double kNarrowestRoughness = 0.04;

    /// As the shader reads them, the nodes in the components. Columns fastest, then rows, then planes: the distances of
    /// √(cosine + kLobeCosineOffset) from the view's over roughness²; weights; leans over roughness²; roughnesses over
    /// the surface's.
    std::vector<glm::vec4> texels{};
    static constexpr int kPlanes = 4;

    /// Linear between the texels.
    LobeNodes at(double view_cosine, double roughness) const;
    /// Of a texel's nodes, and the nodes of a texel.
    void set(int column, int row, const LobeNodes& nodes);
    LobeNodes get(int column, int row) const;
    static double view_cosine(int column) { return lobe_column_cosine(static_cast<double>(column) / (kColumns - 1)); }
    static double roughness(int row);
};

/// The table that fit_lobe_nodes() gave, from lobe_nodes.csv.
const LobeNodeTable& lobe_node_table();

/// The header of lobe_nodes.csv, whose rows are texels: column and row, then four numbers of each plane.
extern const char* const kLobeNodesHeader;

}  // namespace rowland::lighting
