#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/lighting/probe_image.h"

namespace rowland::lighting {

/// A cube map with levels, whose faces have OpenGL's order +X, −X, +Y, −Y, +Z, −Z and orientation. The point (s, t) of
/// a face, in [−1, 1]² and growing with column and row, lies in direction (1,−t,−s), (−1,−t,s), (s,1,t), (s,−1,−t),
/// (s,−t,1), (−s,−t,−1). A level can be uploaded unchanged and sampled with a world direction.
struct CubeLayout {
    int face_size = 0;  ///< of level 0; a power of two
    int levels = 0;     ///< level k has faces of face_size >> k

    int size(int level) const { return face_size >> level; }
    /// Index of a texel: levels one after another; in a level faces, rows, columns.
    std::size_t index(int level, int face, int column, int row) const;
    /// First texel of a level; offset(levels) is the number of texels.
    std::size_t offset(int level) const;

    friend bool operator==(const CubeLayout&, const CubeLayout&) = default;
};

/// Direction (not normalised) of the point (s, t) of a face.
glm::dvec3 cube_direction(int face, double s, double t);

struct CubePoint {
    int face = 0;
    double s = 0;
    double t = 0;
};
/// Where a direction meets the cube: inverse of cube_direction.
CubePoint cube_point(const glm::dvec3& direction);

/// Exact solid angle of a texel of a face of `size` texels a side, in steradians.
double cube_solid_angle(int size, int column, int row);

/// A light probe prefiltered for glossy reflection, as linear Rec.709 radiance. Level k suits GGX of perceptual
/// roughness k / (levels − 1), alpha = roughness²; level 0 is the probe itself.
struct EnvironmentMap {
    CubeLayout layout;
    std::vector<glm::vec3> texels;
};

/// An environment map for storage and upload, as half floats to be multiplied by `scale`, a power of two.
struct PackedEnvironmentMap {
    CubeLayout layout;
    float scale = 1;
    std::vector<std::uint16_t> halves;  ///< RGB of each texel: 3 · layout.offset(layout.levels)
};

/// The scale of half floats up to `largest` ≥ 0: the power of two that divides `largest` to [16384, 32768), as far from
/// underflow as possible without overflow. At least 2⁻¹²⁰; 1 for 0.
float half_scale(double largest);
/// Bits of the half float nearest to value / scale.
std::uint16_t to_half(double value, float scale);
/// The value of a half float, not multiplied by a scale.
float from_half(std::uint16_t bits);
/// Half floats from here on are infinite, NaN or negative.
inline constexpr std::uint16_t kFirstInvalidHalf = 0x7c00;

/// Rounds to halves. Values must be finite and ≥ 0; the largest may be any float.
PackedEnvironmentMap pack(const EnvironmentMap& map);
EnvironmentMap unpack(const PackedEnvironmentMap& map);

struct PrefilterSettings {
    int face_size = 256;  ///< power of two in [16, 1024]; lowered to the probe's resolution
};

/// The cube map that a probe is prefiltered into. Its face size is the largest power of two up to settings.face_size
/// and 5/8 of the height of an equirectangular image (5/16 of an angular map's), at least 16. The last level has faces
/// of 4 texels.
CubeLayout environment_layout(const ProbeImage& probe, const PrefilterSettings& settings);

/// Level 0: the probe's mean over each texel. Level k: radiance under the GGX lobe of that level's roughness, with view
/// = normal = reflection [Karis 2013, split sum], weights normalised so that a constant probe stays constant. Does
/// not depend on the number of threads.
EnvironmentMap prefilter(const ProbeImage& probe, const PrefilterSettings& settings = {});

// CPU reference of the environment look-ups in engine/render/shaders/environment.glsl.

/// Linear Rec.709 radiance along `direction`, of any length, under the lobe of a perceptual roughness in [0, 1]. Linear
/// between texels, also over the edges of faces, and between levels: the level is roughness · (levels − 1), or its
/// square below 1, as the lobe's width is proportional to roughness².
glm::dvec3 environment_light(const EnvironmentMap& map, const glm::dvec3& direction, double roughness);

/// Look-up direction for the whole GGX lobe of a surface: the mirror direction, moved toward the normal by roughness³.
/// n and v are unit; the result is not.
glm::dvec3 lobe_direction(const glm::dvec3& n, const glm::dvec3& v, double roughness);

}  // namespace rowland::lighting
