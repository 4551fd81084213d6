#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/image/image.h"

namespace rowland::lighting {

/// How a probe image covers the sphere.
enum class Mapping {
    Equirectangular,  ///< top row +Y, centre −Z, right +X
    Angular,  ///< Debevec's light probe: square, centre −Z, radius = angle/π; texels beyond radius 1 are ignored
    Auto,     ///< as detect_mapping() finds; an argument only
};

/// "equirect", "angular" or "auto". Throws Error (input) otherwise.
Mapping parse_mapping(const std::string& name);
const char* mapping_name(Mapping mapping);

/// The mapping of an image. An image that is not square, or is a single texel, is equirectangular. A square one is an
/// angular map if it is black outside its inscribed circle; up to a tenth of the corner texels may be bright
/// (captions). Any other square image is ambiguous: throws Error (input) that names `file`.
Mapping detect_mapping(const image::Image& image, const std::string& file);

/// Texels with an invalid component, which was set to 0 when the probe was made.
struct InvalidTexelCounts {
    std::uint64_t nan = 0;
    std::uint64_t infinite = 0;
    std::uint64_t negative = 0;
    std::uint64_t total() const { return nan + infinite + negative; }
};

/// A light probe at full resolution: an image, its mapping, and the lookup.
class ProbeImage {
 public:
    /// Replaces NaN, infinite and negative components by 0 (see report()). Resamples an image of
    /// a single texel to a larger one of the same radiance, and an equirectangular one whose texels have an aspect
    /// ratio above 8 (see resampled_size()). Throws Error (input) if the image is empty, not square for an angular map,
    /// or cannot be recognised (Mapping::Auto); `file` names it in messages.
    ProbeImage(image::Image image, Mapping mapping, const std::string& file = "probe");

    const image::Image& image() const { return image_; }
    Mapping mapping() const { return mapping_; }
    const std::string& file() const { return file_; }
    const InvalidTexelCounts& report() const { return report_; }

    /// Unit vector through a point of the image in texel units: (column + ½, row + ½) is a texel's centre. Unspecified
    /// outside an angular map's disc, where solid_angle() is 0.
    glm::dvec3 direction(double x, double y) const;

    /// Solid angle of a texel in steradians. Equirectangular: exact for the texel's rectangle on the sphere. Angular:
    /// the integral over the texel, to 1e-4; 0 outside the disc.
    double solid_angle(int column, int row) const;

    /// Radiance from the unit vector `direction`: bilinear between texel centres; equirectangular wraps in columns and
    /// clamps in rows; an angular map uses only texels inside the disc (weights renormalised).
    glm::dvec3 radiance(const glm::dvec3& direction) const;

 private:
    void resample();

    image::Image image_;
    Mapping mapping_;
    std::string file_;
    InvalidTexelCounts report_;
};

/// Reads a .hdr or .exr file and logs the warnings of warn_about(). Throws Error (input).
ProbeImage load_probe_image(const std::filesystem::path& path, Mapping mapping);

/// Logs warnings that name `file`: of invalid texels (report()), and of a square image that is read as equirectangular,
/// which is more likely an angular map.
void warn_about(const ProbeImage& probe, const std::string& file);

/// The size that an equirectangular image of `width` × `height` texels is resampled to. Its texels have an aspect ratio
/// of at most 8 on the equator, and it has at most max(2 · width · height, 2²⁰) texels. Texels are split along the long
/// side; above the limit they are averaged along the short one.
glm::ivec2 resampled_size(int width, int height);

}  // namespace rowland::lighting
