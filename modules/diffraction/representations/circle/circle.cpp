#include "modules/diffraction/representations/circle/circle.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/representations/circle/circle_map.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// The grid of cells on a cube's faces.
struct LightCells {
    int side;  ///< of a face

    /// One of them lies beyond either edge, for texels between the edge and the last cell's middle.
    int rows() const { return side + 2; }
    double angle() const { return 0.5 * pi / side; }
    std::size_t index(int face, int row, int column) const {
        return (static_cast<std::size_t>(face) * static_cast<std::size_t>(rows()) + static_cast<std::size_t>(row)) *
                   static_cast<std::size_t>(rows()) +
               static_cast<std::size_t>(column);
    }
    /// From a direction's tangent on a face to cells, and back.
    double cell_of(double tangent) const { return (std::atan(tangent) + 0.25 * pi) / angle() + 0.5; }
    double tangent_of(int cell) const { return std::tan((cell - 0.5) * angle() - 0.25 * pi); }
    /// From a cell to its middle in half cells, ±kOnFace along the face's axis; and back.
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

/// The cube's face that a direction meets: twice its axis, plus 1 on the negative side.
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

namespace {

SettingInfo angles_setting() {
    return {.key = "angles",
            .label = "Angles of the normal",
            .help =
                "At how many angles of half a turn the map holds what a series to 2t lacks, t the normal's angle "
                "about the grating vector (14 by default, 8 under a cover); 0: nothing.",
            .minimum = 0,
            .maximum = 24};
}

/// Counted in circle.glsl, without signs and selections: p, t and t2 10, coordinates of the terms 8, scale 3.
constexpr int kPositionMultiplyAdds = 21;
/// Likewise for the series' remainder: the position on its axis 9, coordinates 7, mix 6, scale and sum 6.
constexpr int kRemainderMultiplyAdds = 28;

/// The kernel needs about 128 views, however soft the light; more where g is resolved as finely.
int views_of(int side) {
    return std::max(std::min(2 * side, 128), 5 * side / 4);
}

}  // namespace

const RepresentationInfo& CircleSettings::info() {
    static const RepresentationInfo info{
        .name = "circle",
        .file_number = 5,
        .summary = "one map for all objects of any shape, of the whole probe",
        .lobes = Lobes::Flat,
        .is_map = true,
        .settings = {map_resolution_setting(104, 128), angles_setting()},
        // Flat surfaces have a better map; beyond 104 a map takes more than 64 MB.
        .budget = [](const Grating& grating, SurfaceShape surface) -> std::vector<std::string> {
            if (!sees_v_g_alone(grating) || surface != SurfaceShape::Curved) return {};
            return {"map_resolution=16",  "map_resolution=24",          "map_resolution=32",
                    "map_resolution=48",  "map_resolution=64",          "map_resolution=80",
                    "map_resolution=104", "map_resolution=48/angles=0", "map_resolution=104/angles=0"};
        }};
    return info;
}

CircleSettings CircleSettings::from(const SettingValues& values, const Grating& grating) {
    const int side = values.number("map_resolution");
    return {.size = {.side = side,
                     .views = views_of(side),
                     .angles = values.number_or("angles", circle_angles(grating.cover))},
            .charts = is_even(grating) ? 1 : 2,
            .covered = grating.cover.has_value()};
}

CircleTables bake(const Grating&, const CircleSettings& settings) {
    return {settings};
}

void write(const CircleTables&, ByteWriter&) {}

CircleTables read(ByteReader&, const CircleSettings& settings) {
    return {settings};
}

ShadingCost cost(const CircleTables& tables) {
    constexpr std::size_t kHalfTexel = 8;
    constexpr std::size_t kRestTexel = 4;
    const auto nodes = [&](int side, int views) {
        return static_cast<std::size_t>(tables.charts * views) * static_cast<std::size_t>(side * side);
    };
    const CircleMapSize& size = tables.size;
    const auto angles = static_cast<std::size_t>(rest_angles(size.angles, tables.covered));
    return {
        .fetches_per_pixel = kTermLookUps + (angles > 0 ? 2 : 0),
        .multiply_adds_per_pixel = 3 * kCircleTerms + kPositionMultiplyAdds + (angles > 0 ? kRemainderMultiplyAdds : 0),
        .table_bytes = nodes(size.side, size.views) * kTermLookUps * kHalfTexel +
                       nodes(remainder_side(size.side), remainder_views(size.views)) * angles * kRestTexel};
}

Facts facts(const CircleTables& tables) {
    return {{"map", fmt::format("{0} x {0} x {1}, {2} angles", tables.size.side, tables.size.views,
                                rest_angles(tables.size.angles, tables.covered))}};
}

PointShader point_shader(const CircleTables& tables, const MaterialKernel& material, const EvaluationLight& light) {
    return
        [map = fill_circle_map(light.texels(), material.kernel, material.pitch_nm, tables.size, material.zero_order_xyz,
                               material.cover)](const ShadingPoint& frame) { return sample(map, frame); };
}

}  // namespace rowland::diffraction
