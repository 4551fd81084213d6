#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "modules/thin_film/model/film.h"

namespace rowland::thin_film {

/// M of a film averaged over microfacets: a weighted sum over steps of angle. Between steps of thickness, M is
/// interpolated by a cubic.
class RoughFilm {
 public:
    static constexpr int kAngleSteps = 128;  ///< of √cos

    RoughFilm(const FilmColour& colour, double thinnest_nm, double thickest_nm);

    /// `angles`: lighting::lobe_angles() of kAngleSteps. The thickness is clamped to the constructor's range.
    glm::dmat3 average(std::span<const double> angles, double thickness_nm) const;

 private:
    double thinnest_nm_;
    double step_nm_;
    std::size_t nodes_;
    std::vector<glm::dmat3> values_;  ///< thickness fastest
};

/// The thicknesses and roughnesses that a table is for.
struct TableRange {
    double thinnest_nm = 0.0;
    double thickest_nm = 0.0;  ///< ≥ thinnest_nm; of the outermost layer
    double smoothest = 0.0;    ///< perceptual roughness
    double roughest = 0.0;     ///< ≥ smoothest
};

struct TableError {
    double largest = 0.0;  ///< of a component, over the largest component at that angle and roughness
    double rms = 0.0;      ///< √ of the mean of its square
};

/// M averaged over the microfacets that a view sees, at nodes. PHYSICS (4.2), (5.1). Columns are equal steps of
/// √(c + kCosineOffset) of the view's cosine c. Rows are equal steps of log₂(x + kPathOffset_nm) of the path
/// difference x in the outermost layer at the lobe's mean_square_cosine(): fringes of all angles have the same x.
/// Layers are equal steps of roughness from 0. Where thickness and roughness vary (`by_lobe_nodes`), the table
/// holds M of the smooth film alone, and M of a lobe is its weighted mean at the lobe's four nodes.
struct FilmTable {
    int columns = 0;
    int rows = 0;
    int layers = 0;
    double index = 1.0;               ///< real part of the outermost layer's index
    double begin = 0.0;               ///< log₂(x + kPathOffset_nm) of the first row
    double end = 0.0;                 ///< of the last row
    double roughest = 0.0;            ///< of the last layer; 0 with one layer
    bool by_lobe_nodes = false;       ///< whether thickness and roughness vary
    double only_thickness_nm = 0.0;   ///< with one row
    std::vector<glm::mat3> values{};  ///< linear Rec.709 → XYZ; columns fastest, layers slowest
    TableError error{};               ///< measured between nodes, of the table with its storage's rounding

    /// As the shader reads it: linear between the nodes, clamped to the table. `cosine` of the view.
    glm::dmat3 at(double cosine, double thickness_nm, double roughness) const;
    /// Coordinates of the nodes.
    double cosine(int column) const;
    double thickness_nm(int row, double cosine, double roughness) const;
    double roughness(double layer) const;
    std::size_t bytes() const { return values.size() * kBytesPerNode; }

    /// Linear between the nodes, without lobe nodes. `root`: √(cosine + kCosineOffset).
    glm::dmat3 interpolated(double root, double thickness_nm, double roughness) const;

    static constexpr std::size_t kBytesPerNode = 12;  ///< for each column, nine bits per component and an exponent
    static constexpr double kCosineOffset = 0.02;
    static constexpr double kPathOffset_nm = 250.0;
};

/// Path difference 2 t √(n² − 1 + cos²θ) in a layer of index n at an angle in air.
double path_difference(double index, double thickness_nm, double square_cosine);

/// Mean of cos² over the microfacets that a view sees, with an error up to .05. PHYSICS (5.2).
double mean_square_cosine(double view_cosine, double roughness);

/// A matrix as it is stored: the components of a column have nine bits each and one exponent; negative ones become 0.
glm::mat3 to_stored(const glm::mat3& matrix);

/// Nodes along the axes.
struct TableSize {
    int columns = 16;
    int rows = 64;
    int layers = 1;  ///< 1 only if the range has no roughness, or if lobes are means of the mirror's table
};

/// The size with which a table of this range has at most 64 kB, chosen by measured error: MEASUREMENTS.md.
TableSize table_size(const TableRange& range);

/// A table without values.
FilmTable empty_table(const Film& film, const TableRange& range, const TableSize& size);

/// Bakes a table and measures its error. Unless it is `exact`, its nodes are rounded as to_stored() does.
FilmTable bake_table(const FilmColour& colour, const TableRange& range, const TableSize& size, bool exact = false);

}  // namespace rowland::thin_film
