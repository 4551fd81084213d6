#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "engine/lighting/sh_light.h"

namespace rowland::lighting {

/// How a probe image covers the sphere.
enum class Mapping {
    Equirectangular,  ///< top row +Y, centre −Z, right +X
    Angular,  ///< Debevec's light probe: square, centre −Z, radius = angle/π; texels beyond radius 1 are no light
};

/// "equirect" or "angular". Throws Error (input) otherwise.
Mapping parse_mapping(const std::string& name);

/// Texels that were not light, counted when the probe was made and treated as 0.
struct TexelReport {
    std::uint64_t nan = 0;
    std::uint64_t infinite = 0;
    std::uint64_t negative = 0;
    std::uint64_t total() const { return nan + infinite + negative; }
};

/// A light probe at full resolution: an image, its mapping, and the lookup.
class ProbeImage {
 public:
    /// Replaces NaN, infinite and negative components by 0 (see report()). An image of one texel, whose centre would be
    /// all the light's direction, becomes a larger one of the same light everywhere. Throws Error (input) if the image
    /// is empty, or not square for an angular map; `file` names it in messages.
    ProbeImage(image::Image image, Mapping mapping, const std::string& file = "probe");

    const image::Image& image() const { return image_; }
    Mapping mapping() const { return mapping_; }
    const TexelReport& report() const { return report_; }

    /// Unit vector through a texel's centre, or through any point of the image in texel units (column + ½, row + ½ is a
    /// centre). For an angular map outside the disc the result is meaningless; its solid angle is 0.
    glm::dvec3 direction(double x, double y) const;

    /// Solid angle of a texel in steradians. Equirectangular: exact for the texel's rectangle on the sphere. Angular:
    /// the exact integral over the texel, or the formula of PHYSICS §1 where that is within 1e-4; 0 outside the disc.
    double solid_angle(int column, int row) const;

    /// Radiance from the unit vector `direction`: bilinear between texel centres; equirectangular wraps in columns and
    /// clamps in rows; an angular map uses only texels inside the disc (weights renormalised).
    glm::dvec3 radiance(const glm::dvec3& direction) const;

 private:
    image::Image image_;
    Mapping mapping_;
    TexelReport report_;
};

/// Raw radiance SH coefficients of a probe, in double, weighted by solid angles that are normalised to sum to 4π;
/// 1 ≤ bands ≤ 32. The result does not depend on the number of threads.
ShLight project(const ProbeImage& probe, int bands);

}  // namespace rowland::lighting
