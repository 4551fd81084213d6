#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// Cells along a side of a face, equal in angle.
inline constexpr int kCircleLightCells = 64;

/// Variance of the blur of circle_light(), in radians², along each axis in a face's middle.
constexpr double circle_light_variance(int cells) {
    const double angle = 0.5 * std::numbers::pi / cells;
    return angle * angle / 6.0;
}

/// Light from the eight images of a direction (circle_image()).
struct ImageLight {
    glm::vec3 direction{0.0F};   ///< image 0
    std::array<Four, 6> flux{};  ///< images 0 to 3 and 4 to 7 of red, green, blue
};

/// A probe as a circle map is filled from it: on the faces of a cube, 26 000 directions of 64 cells a side. Each texel
/// is divided linearly among the four cells around it, so that its mean direction is kept. This blurs all light alike,
/// by less than a map's nodes resolve, and the filling restores what is lost. Detail that the nodes do not resolve,
/// such as what remains of a lamp beside its key light, is averaged; it would show as the nodes' pattern.
std::vector<ImageLight> circle_light(const lighting::LightSamples& texels, int cells = kCircleLightCells);

/// A map over (g, v_g) that is filled from the probe at run time.
struct CircleSettings {
    CircleMapSize size;
    int charts = 2;  ///< of the map: 1 if orders m and −m are equally bright
    bool covered = false;

    static const RepresentationInfo& info();
    static CircleSettings from(const SettingValues& values, const Grating& grating);
};

/// There is nothing to bake.
struct CircleTables : CircleSettings {};

CircleTables bake(const Grating& grating, const CircleSettings& settings);
void write(const CircleTables& tables, ByteWriter& writer);
CircleTables read(ByteReader& reader, const CircleSettings& settings);
ShadingCost cost(const CircleTables& tables);
Facts facts(const CircleTables& tables);
PointShader point_shader(const CircleTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
