// Foil of facets, each with one direction of grooves or with circular ones.

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "modules/diffraction/foil/pattern.h"

namespace rowland::diffraction::foil {

namespace {

/// The fraction of cell (i, j), evenly spread over [0, 1) for neighbouring cells (the R2 sequence: Roberts, The
/// Unreasonable Effectiveness of Quasirandom Sequences, 2018).
double spread_of_cell(std::int64_t i, std::int64_t j) {
    return fraction_of(0.5 + static_cast<double>(i) * 0.7548776662466927 + static_cast<double>(j) * 0.5698402909980532);
}

/// One of `count` directions, as a rotation over π.
double direction_of(double fraction, int count) {
    return std::floor(fraction * count) / count;
}

/// A grid of cells over an area, whose numbers repeat with the area where that repeats.
class Grid {
 public:
    /// `even_rows`: the number of rows is even where the area repeats.
    Grid(const Area& area, const glm::dvec2& cell_mm, bool even_rows = false) : cell_mm_(cell_mm) {
        if (!area.repeats) {
            // A corner of four cells in the middle of the card.
            origin_mm_ = 0.5 * glm::dvec2(area.width_mm, area.height_mm());
            return;
        }
        const double rows_per_step = even_rows ? 2.0 : 1.0;
        count_ = {std::max(1.0, std::round(area.width_mm / cell_mm.x)),
                  rows_per_step * std::max(1.0, std::round(area.height_mm() / (rows_per_step * cell_mm.y)))};
        cell_mm_ = glm::dvec2(area.width_mm, area.height_mm()) / count_;
    }

    /// In cells.
    glm::dvec2 coordinates(const glm::dvec2& at_mm) const { return (at_mm - origin_mm_) / cell_mm_; }
    const glm::dvec2& cell_mm() const { return cell_mm_; }
    /// The number of a cell, the same for those that repetition makes the same.
    glm::i64vec2 number(const glm::dvec2& cell) const {
        const glm::dvec2 within = count_.x > 0.0 ? cell - count_ * glm::floor(cell / count_) : cell;
        return {static_cast<std::int64_t>(within.x), static_cast<std::int64_t>(within.y)};
    }

 private:
    glm::dvec2 cell_mm_;
    glm::dvec2 origin_mm_{0.0};
    glm::dvec2 count_{0.0};  ///< 0: the area does not repeat
};

GrooveField tiles(const Tiles& type, double scale, const Area& area) {
    const Grid grid(area, glm::dvec2(type.size_mm * scale));
    return [=](int column, int row) {
        const glm::i64vec2 tile = grid.number(glm::floor(grid.coordinates(area.position_mm(column, row))));
        return Groove{direction_of(spread_of_cell(tile.x, tile.y), type.directions)};
    };
}

/// Hexagons with a corner at their top: the points that are nearest to one of the centres, of which every other row is
/// shifted by half a width.
GrooveField hexagons(const Hexagons& type, double scale, const Area& area) {
    const Grid grid(area, type.size_mm * scale * glm::dvec2(1.0, 0.5 * std::numbers::sqrt3), true);
    return [=](int column, int row) {
        const glm::dvec2 at = grid.coordinates(area.position_mm(column, row));
        glm::dvec2 nearest(0.0);
        double least = std::numeric_limits<double>::max();
        for (const double line : {std::floor(at.y), std::floor(at.y) + 1.0}) {
            const double shift = fraction_of(line / 2.0);
            const double cell = std::round(at.x - shift);
            const double distance = glm::length(grid.cell_mm() * (at - glm::dvec2(cell + shift, line)));
            if (distance >= least) continue;
            least = distance;
            nearest = {cell, line};
        }
        const glm::i64vec2 hexagon = grid.number(nearest);
        return Groove{direction_of(spread_of_cell(hexagon.x, hexagon.y), type.directions)};
    };
}

/// A value for each cell of a grid that an area reaches, and for two cells around these.
template <typename Value>
class CellTable {
 public:
    /// `make` gets a cell's lower left corner, in cells, and its number.
    template <typename Make>
    CellTable(const Grid& grid, const Area& area, const Make& make) {
        constexpr double kMargin = 2.0;
        first_ = glm::floor(grid.coordinates(glm::dvec2(0.0))) - kMargin;
        const glm::dvec2 last = glm::floor(grid.coordinates({area.width_mm, area.height_mm()})) + kMargin;
        columns_ = static_cast<int>(last.x - first_.x) + 1;
        rows_ = static_cast<int>(last.y - first_.y) + 1;
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column) {
                const glm::dvec2 cell = first_ + glm::dvec2(column, row);
                values_.push_back(make(cell, grid.number(cell)));
            }
    }

    /// Calls visit(value) for the cells at most `reach` cells from a point's; cells outside the table have none.
    template <typename Visit>
    void for_neighbours(const glm::dvec2& at, int reach, const Visit& visit) const {
        const glm::dvec2 middle = glm::floor(at) - first_;
        const int column = static_cast<int>(middle.x);
        const int row = static_cast<int>(middle.y);
        for (int j = std::max(row - reach, 0); j <= std::min(row + reach, rows_ - 1); ++j)
            for (int i = std::max(column - reach, 0); i <= std::min(column + reach, columns_ - 1); ++i)
                visit(values_[static_cast<std::size_t>(j * columns_ + i)]);
    }

 private:
    glm::dvec2 first_{0.0};
    int columns_ = 0;
    int rows_ = 0;
    std::vector<Value> values_;
};

struct Facet {
    glm::dvec2 centre{0.0};  ///< in cells
    double rotation = 0.0;   ///< over π
};

/// Voronoi cells of points that are moved at random within the cells of a grid.
GrooveField cracked_ice(const CrackedIce& type, double scale, std::uint32_t seed, const Area& area) {
    const Grid grid(area, glm::dvec2(type.size_mm * scale));
    const CellTable<Facet> facets(grid, area, [&](const glm::dvec2& cell, const glm::i64vec2& number) {
        const auto random = [&](std::uint32_t which) { return random_of_cell(number.x, number.y, seed + which); };
        return Facet{cell + glm::dvec2(random(0), random(1)), random(2)};
    });
    return [=](int column, int row) {
        const glm::dvec2 at = grid.coordinates(area.position_mm(column, row));
        double least = std::numeric_limits<double>::max();
        Groove groove;
        facets.for_neighbours(at, 2, [&](const Facet& facet) {
            const glm::dvec2 from = at - facet.centre;
            const double square = glm::dot(from, from);
            if (square >= least) return;
            least = square;
            groove.rotation = facet.rotation;
        });
        return groove;
    };
}

GrooveField glitter(const Glitter& type, double scale, std::uint32_t seed, const Area& area) {
    // A facet is at least a texel.
    const Grid grid(area, glm::dvec2(std::max(type.size_um * 1e-3 * scale, area.texel_mm())));
    return [=](int column, int row) {
        const glm::i64vec2 facet = grid.number(glm::floor(grid.coordinates(area.position_mm(column, row))));
        return Groove{random_of_cell(facet.x, facet.y, seed)};
    };
}

/// A dot or a ring of a layer of Cosmos.
struct Circle {
    glm::dvec2 centre{0.0};  ///< in cells
    double radius = 0.0;     ///< of its outer edge; 0: none
    double hole = 0.0;       ///< of a ring; 0: a dot
};

Circle circle_in(const glm::dvec2& cell, const glm::i64vec2& number, double ring_fraction, std::uint32_t seed) {
    const auto random = [&](std::uint32_t which) { return random_of_cell(number.x, number.y, seed + which); };
    Circle circle{.centre = cell + glm::dvec2(random(0), random(1))};
    circle.radius = 0.12 + 0.4 * random(2) * random(2);  // more small ones than large ones
    if (random(3) < ring_fraction) circle.hole = (0.55 + 0.3 * random(4)) * circle.radius;
    return circle;
}

/// A layer of circles, one for each cell.
class CircleLayer {
 public:
    CircleLayer(const Area& area, double cell_mm, double ring_fraction, std::uint32_t seed)
        : grid_(area, glm::dvec2(cell_mm)),
          circles_(grid_, area, [&](const glm::dvec2& cell, const glm::i64vec2& number) {
              return circle_in(cell, number, ring_fraction, seed);
          }) {}

    /// The direction away from the centre of the circle that covers a point, as a rotation over π; nothing between
    /// circles.
    std::optional<double> outward(const glm::dvec2& at_mm) const {
        const glm::dvec2 at = grid_.coordinates(at_mm);
        std::optional<double> rotation;
        double smallest = 2.0;
        circles_.for_neighbours(at, 1, [&](const Circle& circle) {
            const glm::dvec2 from = at - circle.centre;
            const double distance = glm::length(from);
            // The smaller circle lies on top.
            if (distance > circle.radius || distance < circle.hole || circle.radius >= smallest) return;
            smallest = circle.radius;
            rotation = std::atan2(from.y, from.x) / std::numbers::pi;
        });
        return rotation;
    }

 private:
    Grid grid_;
    CellTable<Circle> circles_;
};

GrooveField cosmos(const Cosmos& type, double scale, std::uint32_t seed, const Area& area) {
    const CircleLayer large(area, type.size_mm * scale, 0.6, seed);
    const CircleLayer small(area, 0.35 * type.size_mm * scale, 0.0, seed + 16);
    return [=](int column, int row) {
        const glm::dvec2 at_mm = area.position_mm(column, row);
        if (const auto dot = small.outward(at_mm)) return Groove{*dot};
        // Between circles grooves are upright: calm under a lamp above.
        return Groove{large.outward(at_mm).value_or(0.0)};
    };
}

}  // namespace

GrooveField facet_field(const Foil& foil, const Area& area) {
    if (const auto* type = std::get_if<Tiles>(&foil.type)) return tiles(*type, foil.scale, area);
    if (const auto* type = std::get_if<Hexagons>(&foil.type)) return hexagons(*type, foil.scale, area);
    if (const auto* type = std::get_if<CrackedIce>(&foil.type)) return cracked_ice(*type, foil.scale, foil.seed, area);
    if (const auto* type = std::get_if<Glitter>(&foil.type)) return glitter(*type, foil.scale, foil.seed, area);
    if (const auto* type = std::get_if<Cosmos>(&foil.type)) return cosmos(*type, foil.scale, foil.seed, area);
    return {};
}

}  // namespace rowland::diffraction::foil
