#pragma once

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

namespace rowland::thin_film {

inline constexpr int kLobeNodes = 4;

/// An angle of incidence that stands for a part of a rough surface's microfacets.
struct LobeNode {
    double root = 0.0;    ///< √(cosine + FilmTable::kCosineOffset), the coordinate of the film table's columns
    double weight = 0.0;  ///< of a lobe's nodes they sum to 1
};

/// Gauss's nodes and weights for the mean over the microfacets that a view sees. PHYSICS (7).
std::array<LobeNode, kLobeNodes> lobe_nodes(double view_cosine, double roughness);

/// Where the table below has a view, 0 to 1: steep at grazing and at normal incidence, where lobes change most.
double lobe_column(double view_cosine);

/// The nodes of all views and roughnesses, the same for every film.
struct LobeNodeTable {
    static constexpr int kColumns = 32;  ///< of lobe_column()
    static constexpr int kRows = 24;     ///< of the root of the perceptual roughness, 0 to 1

    /// Columns fastest: a plane of the roots' distances from the view's, over roughness²; then one of the weights.
    std::vector<glm::vec4> texels{};

    /// As the shader reads it: linear between the texels.
    std::array<LobeNode, kLobeNodes> at(double view_cosine, double roughness) const;
    bool empty() const { return texels.empty(); }
    std::size_t bytes() const { return texels.size() * kBytesPerTexel; }

    static constexpr std::size_t kBytesPerTexel = 8;  ///< four numbers of 16 bits
};

LobeNodeTable bake_lobe_nodes();

}  // namespace rowland::thin_film
