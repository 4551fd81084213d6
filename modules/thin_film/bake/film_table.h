#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "modules/thin_film/model/film.h"

namespace rowland::thin_film {

/// M of a film averaged over microfacets, from M at steps of angle and thickness: cubic in thickness.
class RoughFilm {
 public:
    static constexpr int kAngleSteps = 128;  ///< of √cos

    RoughFilm(const FilmColour& colour, double thinnest_nm, double thickest_nm);

    /// `angles`: lobe_angles() of kAngleSteps. A thickness beyond the ends counts as the end's.
    glm::dmat3 average(std::span<const double> angles, double thickness_nm) const;

 private:
    double thinnest_nm_;
    double step_nm_;
    std::size_t nodes_;
    std::vector<glm::dmat3> values_;  ///< thickness fastest
};

/// What of a film's surface a table is for.
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

/// M averaged over the microfacets that a view sees, at nodes. PHYSICS (4.2), (5.1). Axes: √(c + kCosineOffset) of the
/// view's cosine c; the path difference x in the outermost layer at the lobe's mean_square_cosine(), along which
/// fringes of all angles lie alike, in equal steps of log(x + kPathOffset_nm); roughness, of which the first node is 0.
/// Where thickness and roughness vary, the table is the mirror's, and a lobe is the mean of it at four angles.
struct FilmTable {
    int columns = 0;
    int rows = 0;
    int layers = 0;
    double index = 1.0;               ///< n of the outermost layer
    double begin = 0.0;               ///< log₂(x + kPathOffset_nm) of the first row
    double end = 0.0;                 ///< of the last row
    double roughest = 0.0;            ///< of the last layer; 0 with one layer
    bool by_lobe_nodes = false;       ///< whether thickness and roughness vary
    double only_thickness_nm = 0.0;   ///< with one row
    std::vector<glm::mat3> values{};  ///< linear Rec.709 → XYZ; columns fastest, layers slowest
    TableError error{};               ///< measured between nodes, of the table with its storage's rounding

    /// As the shader reads it: linear between the nodes, clamped to the table. `cosine` of the view.
    glm::dmat3 at(double cosine, double thickness_nm, double roughness) const;
    /// Of the nodes.
    double cosine(int column) const;
    double thickness_nm(int row, double cosine, double roughness) const;
    double roughness(double layer) const;
    std::size_t bytes() const { return values.size() * kBytesPerNode; }

    /// Between the nodes, of the layer or the layers on both sides of a roughness. `root`: √(cosine + kCosineOffset).
    glm::dmat3 interpolated(double root, double thickness_nm, double roughness) const;

    static constexpr std::size_t kBytesPerNode = 12;  ///< nine bits a component and an exponent, for each column
    static constexpr double kCosineOffset = 0.02;
    static constexpr double kPathOffset_nm = 250.0;
};

/// Path difference 2 t √(n² − 1 + cos²θ) in a layer of index n at an angle in air.
double path_difference(double index, double thickness_nm, double square_cosine);

/// Mean of cos² over the microfacets that a view sees, to .05. PHYSICS (5.2).
double mean_square_cosine(double view_cosine, double roughness);

/// As it is stored: each column rounded to nine bits a component and an exponent of its own, and not below 0.
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

FilmTable bake_table(const FilmColour& colour, const TableRange& range, const TableSize& size);

}  // namespace rowland::thin_film
