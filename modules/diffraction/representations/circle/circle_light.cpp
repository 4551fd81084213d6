#include "modules/diffraction/representations/circle/circle_light.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "modules/diffraction/representations/circle/circle_chart.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// Cells of a cube's faces.
struct LightCells {
    int side;  ///< of a face

    /// A row beyond either edge, for texels between the edge and the last cell's middle.
    int rows() const { return side + 2; }
    double angle() const { return 0.5 * pi / side; }
    std::size_t index(int face, int row, int column) const {
        return (static_cast<std::size_t>(face) * static_cast<std::size_t>(rows()) + static_cast<std::size_t>(row)) *
                   static_cast<std::size_t>(rows()) +
               static_cast<std::size_t>(column);
    }
    /// Of a direction's tangent on a face to cells, and back.
    double cell_of(double tangent) const { return (std::atan(tangent) + 0.25 * pi) / angle() + 0.5; }
    double tangent_of(int cell) const { return std::tan((cell - 0.5) * angle() - 0.25 * pi); }
    /// A cell by its middle's coordinates in half cells, ±kOnFace along the face's axis; and back.
    glm::ivec3 position_of(int face, int row, int column) const;
    std::size_t index_of(const glm::ivec3& position) const;
    static constexpr int kOnFace = 1 << 20;
};

glm::ivec3 LightCells::position_of(int face, int row, int column) const {
    glm::ivec3 position;
    position[face / 2] = face % 2 == 0 ? kOnFace : -kOnFace;
    position[(face / 2 + 1) % 3] = 2 * column - (side + 1);
    position[(face / 2 + 2) % 3] = 2 * row - (side + 1);
    return position;
}

std::size_t LightCells::index_of(const glm::ivec3& position) const {
    int axis = 0;
    while (std::abs(position[axis]) != kOnFace) ++axis;
    const auto cell = [&](int i) { return (position[(axis + i) % 3] + side + 1) / 2; };
    return index(2 * axis + (position[axis] < 0 ? 1 : 0), cell(2), cell(1));
}

/// A face for each sign of each axis.
int light_face(const glm::dvec3& s) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(s[i]) > std::abs(s[axis])) axis = i;
    return 2 * axis + (s[axis] < 0.0 ? 1 : 0);
}

void add_texel(const glm::dvec3& s, const glm::dvec3& flux, const LightCells& grid, std::vector<glm::dvec3>& cells) {
    const int face = light_face(s);
    const int axis = face / 2;
    const double x = grid.cell_of(s[(axis + 1) % 3] / std::abs(s[axis]));
    const double y = grid.cell_of(s[(axis + 2) % 3] / std::abs(s[axis]));
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const double right = x - column;
    const double below = y - row;
    cells[grid.index(face, row, column)] += (1.0 - below) * (1.0 - right) * flux;
    cells[grid.index(face, row, column + 1)] += (1.0 - below) * right * flux;
    cells[grid.index(face, row + 1, column)] += below * (1.0 - right) * flux;
    cells[grid.index(face, row + 1, column + 1)] += below * right * flux;
}

}  // namespace

std::vector<ImageLight> circle_light(const lighting::LightSamples& texels, int cells_a_side) {
    const LightCells grid{cells_a_side};
    std::vector<glm::dvec3> cells(grid.index(6, 0, 0), glm::dvec3(0.0));
    for (std::size_t i = 0; i < texels.size(); ++i) add_texel(texels.direction(i), texels.flux(i), grid, cells);
    std::vector<ImageLight> light;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < grid.rows(); ++row)
            for (int column = 0; column < grid.rows(); ++column) {
                const glm::ivec3 position = grid.position_of(face, row, column);
                ImageLight images;
                bool lit = false;
                for (std::size_t image = 0; image < kCircleImages; ++image) {
                    const glm::dvec3& flux = cells[grid.index_of(circle_image(position, image))];
                    lit = lit || flux != glm::dvec3(0.0);
                    for (int c = 0; c < 3; ++c)
                        images.flux[2 * static_cast<std::size_t>(c) + image / 4][image % 4] =
                            static_cast<float>(flux[c]);
                }
                if (!lit) continue;
                glm::dvec3 s;
                s[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
                s[(face / 2 + 1) % 3] = grid.tangent_of(column);
                s[(face / 2 + 2) % 3] = grid.tangent_of(row);
                images.direction = glm::normalize(s);
                light.push_back(images);
            }
    return light;
}

}  // namespace rowland::diffraction
