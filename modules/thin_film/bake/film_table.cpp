#include "modules/thin_film/bake/film_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>
#include <optional>
#include <span>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/lobe_nodes.h"

namespace rowland::thin_film {

namespace {

/// Step of the path difference: a 25th of the shortest visible wavelength, at which a cubic is off by 1e-4 of a
/// fringe's height.
constexpr double kPathStep_nm = 15.0;

/// Weights of four equidistant nodes at 0 to 3 for a value at `at` (Lagrange).
std::array<double, 4> cubic_weights(double at) {
    const double a = at;
    const double b = at - 1.0;
    const double c = at - 2.0;
    const double d = at - 3.0;
    return {-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0};
}

}  // namespace

RoughFilm::RoughFilm(const FilmColour& colour, double thinnest_nm, double thickest_nm) : thinnest_nm_(thinnest_nm) {
    const double range_nm = thickest_nm - thinnest_nm;
    const double finest_nm = kPathStep_nm / (2.0 * std::abs(colour.film().layers.front().index));
    nodes_ = std::max<std::size_t>(static_cast<std::size_t>(std::ceil(range_nm / finest_nm)) + 1, 4);
    step_nm_ = range_nm / static_cast<double>(nodes_ - 1);
    values_.resize(nodes_ * (kAngleSteps + 1));
    parallel_for(kAngleSteps + 1, [&](std::size_t angle) {
        const double root = static_cast<double>(angle) / kAngleSteps;
        const FilmColour::AtAngle at = colour.at(root * root);
        for (std::size_t i = 0; i < nodes_; ++i)
            values_[angle * nodes_ + i] = at(thinnest_nm + static_cast<double>(i) * step_nm_);
    });
}

glm::dmat3 RoughFilm::average(std::span<const double> angles, double thickness_nm) const {
    const double last = static_cast<double>(nodes_ - 1);
    const double position = step_nm_ > 0.0 ? std::clamp((thickness_nm - thinnest_nm_) / step_nm_, 0.0, last) : 0.0;
    const std::size_t first = std::min(static_cast<std::size_t>(std::max(position - 1.0, 0.0)), nodes_ - 4);
    const std::array<double, 4> weights = cubic_weights(position - static_cast<double>(first));
    glm::dmat3 sum(0.0);
    for (std::size_t angle = 0; angle < angles.size(); ++angle) {
        if (angles[angle] == 0.0) continue;
        const glm::dmat3* const at = &values_[angle * nodes_ + first];
        sum += angles[angle] * (weights[0] * at[0] + weights[1] * at[1] + weights[2] * at[2] + weights[3] * at[3]);
    }
    return sum;
}

namespace {

/// Limit of a node's thickness, above all that are asked for: at grazing incidence in a film of index 1, x is 0 for
/// every thickness, so that the nodes of larger x have none.
constexpr double kThickest_nm = 1e7;

/// The error is measured from this cosine on: nearer to grazing incidence a film's fringes are as sharp as a
/// resonator's, and few pixels show them.
constexpr double kLeastMeasuredCosine = 0.05;
constexpr std::size_t kMeasuredCosines = 101;  // these cosines coincide with the columns of no table

/// Coordinates of which columns and rows are equal steps. PHYSICS (4.2).
double column_coordinate(double cosine) {
    return std::sqrt(cosine + FilmTable::kCosineOffset);
}

double row_coordinate(double x_nm) {
    return std::log2(x_nm + FilmTable::kPathOffset_nm);
}

double position(double at, int nodes) {
    return std::clamp(at, 0.0, 1.0) * (nodes - 1);
}

/// Nodes on both sides of a position, and the weight of the second.
struct Between {
    std::size_t first;
    std::size_t second;
    double weight;

    explicit Between(double position, int nodes)
        : first(static_cast<std::size_t>(position)),
          second(std::min(first + 1, static_cast<std::size_t>(nodes) - 1)),
          weight(position - static_cast<double>(first)) {}
};

double largest_component(const glm::dmat3& matrix) {
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(matrix[column][row]));
    return largest;
}

/// M at any point of a range, averaged over the lobe: what a table interpolates.
class Averages {
 public:
    Averages(const FilmColour& colour, double thinnest_nm, double thickest_nm, bool rough) : colour_(colour) {
        if (rough) rough_.emplace(colour, thinnest_nm, thickest_nm);
    }

    /// At one view, for several thicknesses.
    std::vector<glm::dmat3> at(double cosine, double roughness, std::span<const double> thicknesses_nm) const {
        std::vector<glm::dmat3> result;
        if (roughness == 0.0) {
            const FilmColour::AtAngle smooth = colour_.at(cosine);
            for (const double thickness_nm : thicknesses_nm) result.push_back(smooth(thickness_nm));
        } else {
            const std::vector<double> angles = lighting::lobe_angles(cosine, roughness, RoughFilm::kAngleSteps);
            for (const double thickness_nm : thicknesses_nm) result.push_back(rough_->average(angles, thickness_nm));
        }
        return result;
    }

 private:
    const FilmColour& colour_;
    std::optional<RoughFilm> rough_;
};

double square(double x) {
    return x * x;
}

/// Moves the nodes along one axis by 1/16 of the second difference, which minimises the largest error of the linear
/// interpolation between them. PHYSICS §4.
void fit_nodes(std::vector<glm::mat3>& values, std::size_t stride, std::size_t count) {
    const std::vector<glm::mat3> nodes = values;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t along = i / stride % count;
        if (along == 0 || along + 1 == count) continue;
        values[i] -= (nodes[i - stride] + nodes[i + stride] - 2.0F * nodes[i]) / 16.0F;
    }
}

void fill(const Averages& averages, FilmTable& table) {
    const auto columns = static_cast<std::size_t>(table.columns);
    const auto rows = static_cast<std::size_t>(table.rows);
    table.values.resize(columns * rows * static_cast<std::size_t>(table.layers));
    parallel_for(columns * static_cast<std::size_t>(table.layers), [&](std::size_t i) {
        const std::size_t column = i % columns;
        const std::size_t layer = i / columns;
        const double cosine = table.cosine(static_cast<int>(column));
        const double roughness = table.roughness(static_cast<double>(layer));
        std::vector<double> thicknesses_nm;
        for (int row = 0; row < table.rows; ++row) thicknesses_nm.push_back(table.thickness_nm(row, cosine, roughness));
        const std::vector<glm::dmat3> values = averages.at(cosine, roughness, thicknesses_nm);
        for (std::size_t row = 0; row < rows; ++row)
            table.values[(layer * rows + row) * columns + column] = glm::mat3(values[row]);
    });
    fit_nodes(table.values, 1, columns);
    fit_nodes(table.values, columns, rows);
    fit_nodes(table.values, columns * rows, static_cast<std::size_t>(table.layers));
}

/// The roughnesses at which the error is measured: 0, which light from one direction takes, and those of the range at
/// layers and midway between them or, by lobe nodes, in even steps.
std::vector<double> measured_roughnesses(const FilmTable& table, const TableRange& range) {
    std::vector<double> result = {0.0};
    for (int half_layer = 1; half_layer <= 2 * (table.layers - 1); ++half_layer)
        if (const double roughness = table.roughness(0.5 * half_layer); roughness >= range.smoothest)
            result.push_back(roughness);
    constexpr int kSteps = 8;
    for (int step = 1; table.by_lobe_nodes && step <= kSteps; ++step)
        result.push_back(range.smoothest + (range.roughest - range.smoothest) * step / kSteps);
    return result;
}

TableError measure(const Averages& averages, const FilmTable& table, const TableRange& range) {
    const std::vector<double> roughnesses = measured_roughnesses(table, range);
    std::vector<TableError> errors(roughnesses.size() * kMeasuredCosines);
    parallel_for(errors.size(), [&](std::size_t i) {
        const double root = std::sqrt(kLeastMeasuredCosine);
        const auto step = static_cast<double>(i % kMeasuredCosines);
        const double cosine = square(root + (1.0 - root) * (step + 0.5) / kMeasuredCosines);
        const double roughness = roughnesses[i / kMeasuredCosines];
        std::vector<double> thicknesses_nm;
        const bool smoothed = table.by_lobe_nodes && roughness > 0.0;  // fewer steps suffice; each takes time
        const int steps = range.thickest_nm > range.thinnest_nm ? (smoothed ? 1 : 3) * table.rows : 0;
        for (int j = 0; j <= steps; ++j)
            thicknesses_nm.push_back(range.thinnest_nm +
                                     (range.thickest_nm - range.thinnest_nm) * j / std::max(steps, 1));
        const std::vector<glm::dmat3> exact = averages.at(cosine, roughness, thicknesses_nm);
        double scale = 0.0;
        for (const glm::dmat3& value : exact) scale = std::max(scale, largest_component(value));
        for (std::size_t j = 0; j < exact.size(); ++j) {
            const double off = largest_component(table.at(cosine, thicknesses_nm[j], roughness) - exact[j]) / scale;
            errors[i].largest = std::max(errors[i].largest, off);
            errors[i].rms += off * off / static_cast<double>(exact.size());
        }
    });
    TableError error;
    for (const TableError& of : errors) {
        error.largest = std::max(error.largest, of.largest);
        error.rms += of.rms / static_cast<double>(errors.size());
    }
    // Doubles would have last bits that differ between C libraries, and cooked files shall not.
    return {.largest = static_cast<float>(error.largest), .rms = static_cast<float>(std::sqrt(error.rms))};
}

}  // namespace

double path_difference(double index, double thickness_nm, double square_cosine) {
    return 2.0 * thickness_nm * std::sqrt((index - 1.0) * (index + 1.0) + square_cosine);
}

double mean_square_cosine(double view_cosine, double roughness) {
    const double spread = 1.0 + 3.1 * roughness * roughness * roughness;
    return 0.72 + (view_cosine * view_cosine - 0.72) / spread;
}

glm::mat3 to_stored(const glm::mat3& matrix) {
    glm::mat3 result;
    for (int column = 0; column < 3; ++column)
        result[column] = glm::unpackF3x9_E1x5(glm::packF3x9_E1x5(glm::max(matrix[column], 0.0F)));
    return result;
}

glm::dmat3 FilmTable::at(double cosine, double thickness_nm, double roughness) const {
    const double clamped = std::clamp(cosine, 0.0, 1.0);
    if (roughness == 0.0 || !by_lobe_nodes) return interpolated(column_coordinate(clamped), thickness_nm, roughness);
    glm::dmat3 sum(0.0);
    for (const lighting::LobeNode& node : lighting::lobe_node_table().at(clamped, roughness))
        sum += node.weight * interpolated(column_coordinate(node.cosine), thickness_nm, 0.0);
    return sum;
}

glm::dmat3 FilmTable::interpolated(double root, double thickness_nm, double roughness) const {
    const double cosine = square(root) - kCosineOffset;
    const double y = row_coordinate(path_difference(index, thickness_nm, mean_square_cosine(cosine, roughness)));
    const double first = column_coordinate(0.0);
    const double u = (root - first) / (column_coordinate(1.0) - first);
    const Between column(position(u, columns), columns);
    const Between row(position(end > begin ? (y - begin) / (end - begin) : 0.0, rows), rows);
    const Between layer(position(roughest > 0.0 ? roughness / roughest : 0.0, layers), layers);
    const auto value = [&](std::size_t l, std::size_t r, std::size_t c) {
        return glm::dmat3(values[(l * static_cast<std::size_t>(rows) + r) * static_cast<std::size_t>(columns) + c]);
    };
    const auto in_row = [&](std::size_t l, std::size_t r) {
        return (1.0 - column.weight) * value(l, r, column.first) + column.weight * value(l, r, column.second);
    };
    const auto in_layer = [&](std::size_t l) {
        return (1.0 - row.weight) * in_row(l, row.first) + row.weight * in_row(l, row.second);
    };
    return (1.0 - layer.weight) * in_layer(layer.first) + layer.weight * in_layer(layer.second);
}

double FilmTable::cosine(int column) const {
    const double first = column_coordinate(0.0);
    const double u = first + (column_coordinate(1.0) - first) * column / (columns - 1);
    return std::clamp(square(u) - kCosineOffset, 0.0, 1.0);
}

double FilmTable::thickness_nm(int row, double cosine, double roughness) const {
    if (rows == 1) return only_thickness_nm;
    const double x_nm = std::exp2(begin + (end - begin) * row / (rows - 1)) - kPathOffset_nm;
    const double of_1_nm = path_difference(index, 1.0, mean_square_cosine(cosine, roughness));
    return std::min(std::max(x_nm, 0.0) / std::max(of_1_nm, 1e-9), kThickest_nm);
}

double FilmTable::roughness(double layer) const {
    return layers > 1 ? roughest * layer / (layers - 1) : 0.0;
}

TableSize table_size(const TableRange& range) {
    const bool rough = range.roughest > 0.0;
    const bool one_roughness = range.smoothest == range.roughest;
    if (range.thickest_nm == range.thinnest_nm) {
        if (!rough) return {.columns = 128, .rows = 1, .layers = 1};
        return one_roughness ? TableSize{.columns = 128, .rows = 1, .layers = 2}
                             : TableSize{.columns = 128, .rows = 1, .layers = 24};
    }
    if (!rough) return {.columns = 26, .rows = 210, .layers = 1};
    if (one_roughness) return {.columns = 20, .rows = 136, .layers = 2};
    return {.columns = 26, .rows = 170, .layers = 1};
}

FilmTable empty_table(const Film& film, const TableRange& range, const TableSize& size) {
    const double index = film.layers.front().index.real();
    return {.columns = size.columns,
            .rows = size.rows,
            .layers = size.layers,
            .index = index,
            .begin = row_coordinate(path_difference(index, range.thinnest_nm, 0.0)),
            .end = row_coordinate(path_difference(index, range.thickest_nm, 1.0)),
            .roughest = range.roughest,
            .by_lobe_nodes = range.roughest > 0.0 && size.layers == 1,
            .only_thickness_nm = range.thinnest_nm};
}

FilmTable bake_table(const FilmColour& colour, const TableRange& range, const TableSize& size, bool exact) {
    FilmTable table = empty_table(colour.film(), range, size);
    const bool rough = range.roughest > 0.0;
    // The nodes of a row have one path difference: at other angles they have thicknesses beyond the range.
    const double spread =
        path_difference(table.index, 1.0, 1.0) / std::max(path_difference(table.index, 1.0, 0.0), 1e-9);
    const double reach = table.rows > 1 ? std::min(spread, 2.0) : 1.0;
    const Averages averages(colour, range.thinnest_nm / reach, range.thickest_nm * reach, rough);
    fill(averages, table);
    if (!exact)
        for (glm::mat3& value : table.values) value = to_stored(value);
    table.error = measure(averages, table, range);
    return table;
}

}  // namespace rowland::thin_film
