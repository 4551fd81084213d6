#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec4.hpp>
#include <vector>

namespace rowland::lighting {

// The GGX lobe of a rough surface for one view, by the angles of incidence on its microfacets. `roughness` is
// perceptual.

/// Calls f(cosine on the microfacet, weight) for sampled half vectors whose light comes from above the surface. The
/// weights are those of the split sum (engine/render/light_maps.h), divided by the number of samples.
void sample_lobe(double view_cosine, double roughness, const std::function<void(double, double)>& f);

/// Distribution of the angles of incidence: weights of equal steps of √cos, which sum to 1.
std::vector<double> lobe_angles(double view_cosine, double roughness, int steps);

/// Directional albedo of microfacets that reflect all light.
double lobe_albedo(double view_cosine, double roughness);

inline constexpr int kLobeNodes = 4;

/// A node of the quadrature over a lobe's microfacets: their angle of incidence, and the EnvironmentMap look-up of the
/// light that they reflect, along (1 − lean) · mirror direction + lean · normal.
struct LobeNode {
    double cosine = 1.0;
    double weight = 0.0;  ///< the weights of a lobe sum to 1
    double lean = 0.0;
    double roughness = 0.0;  ///< of the look-up
};
using LobeNodes = std::array<LobeNode, kLobeNodes>;

/// Position of a view in the table's columns, 0 to 1: dense at grazing and at normal incidence, where lobes change
/// most.
double lobe_column(double view_cosine);

/// The table stores angles as √(cosine + this): nearly uniform steps in films' and lobes' variation, and a finite slope
/// at grazing incidence.
inline constexpr double kLobeCosineOffset = 0.02;

/// Nodes of all views and roughnesses of the GGX lobe with height-correlated Smith visibility.
struct LobeNodeTable {
    static constexpr int kColumns = 32;  ///< lobe_column()
    static constexpr int kRows = 24;     ///< square root of the roughness, 0 to 1
    static constexpr int kPlanes = 4;
    using Planes = std::array<glm::dvec4, kPlanes>;

    /// As the shader reads them, one node per component. Columns fastest, then rows, then planes:
    /// √(cosine + kLobeCosineOffset) less the view's, over roughness²; weights; leans over roughness²; roughnesses
    /// relative to the surface's.
    std::vector<glm::vec4> texels{};

    static std::size_t index(int plane, int column, int row) {
        return static_cast<std::size_t>((plane * kRows + row) * kColumns + column);
    }
    static LobeNodes nodes_of(const Planes& planes, double view_cosine, double roughness);
    /// Bilinear.
    LobeNodes at(double view_cosine, double roughness) const;
};

/// The table in lobe_nodes.csv, which editor/lobe_nodes fits.
const LobeNodeTable& lobe_node_table();

/// The header of lobe_nodes.csv, whose rows are texels: column and row, then four numbers of each plane.
extern const char* const kLobeNodesHeader;

}  // namespace rowland::lighting
