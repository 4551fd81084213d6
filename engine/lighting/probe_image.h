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
    Angular,  ///< Debevec's light probe: square, centre −Z, radius = angle/π; texels beyond radius 1 are no light
    Auto,     ///< as recognised_mapping() finds; no probe has it
};

/// "equirect", "angular" or "auto". Throws Error (input) otherwise.
Mapping parse_mapping(const std::string& name);
const char* mapping_name(Mapping mapping);

/// The mapping of an image. One that is not square is equirectangular. A square one is an angular map if it is black
/// outside its inscribed circle; a tenth of that part may be bright, for captions. Throws Error (input) for another
/// square image, of more than one texel, which may be either; `file` names it.
Mapping recognised_mapping(const image::Image& image, const std::string& file);

/// Texels that were counted and set to 0 when the probe was made.
struct TexelReport {
    std::uint64_t nan = 0;
    std::uint64_t infinite = 0;
    std::uint64_t negative = 0;
    std::uint64_t total() const { return nan + infinite + negative; }
};

/// A light probe at full resolution: an image, its mapping, and the lookup.
class ProbeImage {
 public:
    /// Replaces NaN, infinite and negative components by 0 (see report()). Two kinds of images are resampled: one of a
    /// single texel, to a larger one of the same radiance; and an equirectangular one with texels more than 8 times as
    /// long as wide, so that sums over texels cost in proportion to the image (see probe_shape()). Throws Error (input)
    /// if the image is empty, not square for an angular map, or cannot be recognised (Mapping::Auto); `file` names it
    /// in messages.
    ProbeImage(image::Image image, Mapping mapping, const std::string& file = "probe");

    const image::Image& image() const { return image_; }
    Mapping mapping() const { return mapping_; }
    const TexelReport& report() const { return report_; }

    /// Unit vector through a point of the image in texel units: (column + ½, row + ½) is a texel's centre. Meaningless
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
    TexelReport report_;
};

/// Reads a .hdr or .exr file. Logs a warning for texels that were set to 0, and for a square image as
/// `Equirectangular`, which is more likely an angular map. Throws Error (input).
ProbeImage load_probe_image(const std::filesystem::path& path, Mapping mapping);

/// Logs the warnings of load_probe_image().
void warn_about(const ProbeImage& probe, const std::string& file);

/// The size that an equirectangular image of `width` × `height` texels is resampled to. Its texels are at most 8 times
/// as long as wide on the equator, and it has at most max(2 · width · height, 2²⁰) texels. The long side is divided; if
/// that makes too many texels, the short one is averaged.
glm::ivec2 probe_shape(int width, int height);

}  // namespace rowland::lighting
