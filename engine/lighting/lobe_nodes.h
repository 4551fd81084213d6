#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec4.hpp>
#include <vector>

namespace rowland::lighting {

// Quadrature of the GGX lobe of a rough surface, seen from one view, over the angle of incidence on its microfacets.
// `roughness` is perceptual.

/// Samples half vectors, and calls f(cos θ_i on the microfacet, weight) for each that reflects light from above the
/// surface. The weights are those of bake_brdf_table() (engine/render/light_maps.h), divided by the number of samples.
/// Cosines and alpha = roughness² below 1e-3 count as 1e-3.
void sample_lobe(double view_cosine, double roughness, const std::function<void(double, double)>& f);

/// Distribution of the angles of incidence: `steps` + 1 weights at equal steps of √cos θ_i from 0 to 1, which sum to 1.
/// A sample between two of these counts linearly for both.
std::vector<double> lobe_angles(double view_cosine, double roughness, int steps);

/// Directional albedo of microfacets that reflect all light.
double lobe_albedo(double view_cosine, double roughness);

inline constexpr int kLobeNodes = 4;

/// A node of the quadrature: an angle of incidence, and an environment look-up for the light that microfacets under
/// this angle reflect, in direction mix(mirror direction, normal, lean).
struct LobeNode {
    double cosine = 1.0;
    double weight = 0.0;  ///< the weights of a lobe sum to 1
    double lean = 0.0;
    double roughness = 0.0;  ///< of the look-up
};
using LobeNodes = std::array<LobeNode, kLobeNodes>;

/// Table coordinate of a view cosine, 0 to 1; finer at grazing and at normal incidence, where lobes change most.
double lobe_column(double view_cosine);

/// The table stores angles as √(cosine + this), along which films and lobes vary almost linearly; the offset keeps the
/// slope finite at grazing incidence.
inline constexpr double kLobeCosineOffset = 0.02;

/// Nodes of all views and roughnesses of the GGX lobe with height-correlated Smith visibility.
struct LobeNodeTable {
    static constexpr int kColumns = 32;  ///< axis: lobe_column()
    static constexpr int kRows = 24;     ///< axis: square root of the roughness, 0 to 1
    static constexpr int kPlanes = 4;
    using Planes = std::array<glm::dvec4, kPlanes>;

    /// As the shader reads them, one node per component. Columns fastest, then rows, then planes:
    /// 0 √(cosine + kLobeCosineOffset) minus the view's, divided by roughness²; 1 weight; 2 lean / roughness²;
    /// 3 roughness relative to the surface's.
    std::vector<glm::vec4> texels{};

    static std::size_t index(int plane, int column, int row) {
        return static_cast<std::size_t>((plane * kRows + row) * kColumns + column);
    }
    static LobeNodes nodes_of(const Planes& planes, double view_cosine, double roughness);
    /// Bilinear interpolation.
    LobeNodes at(double view_cosine, double roughness) const;
};

/// The table in lobe_nodes.csv, written by editor/lobe_nodes.
const LobeNodeTable& lobe_node_table();

/// The header of lobe_nodes.csv. Each further line: column, row, then 4 × 4 numbers, plane by plane.
extern const char* const kLobeNodesHeader;

}  // namespace rowland::lighting
