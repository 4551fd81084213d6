// The reference radiance of points: sums over wavelengths of integrals along arcs of the full-resolution probe.
#include "modules/diffraction/reference/reference.h"

#include <cstdlib>

#include "content/web/bake/exports.h"
#include "content/web/bake/material.h"

namespace rowland::web {

/// `texels`: linear Rec.709, row 0 at the top; released here.
ROWLAND_EXPORT(read_image) lighting::ProbeImage* read_image(glm::vec3* texels, int width, int height) {
    image::Image image{width, height, std::vector<glm::vec3>(texels, texels + width * height)};
    std::free(texels);
    return new lighting::ProbeImage(std::move(image), lighting::Mapping::Equirectangular);
}

ROWLAND_EXPORT(release_image) void release_image(const lighting::ProbeImage* image) {
    delete image;
}

/// Linear Rec.709 of `count` points. A point: nine numbers, toward the eye, the normal and the grating vector.
ROWLAND_EXPORT(reference_radiance)
Numbers* reference_radiance(const Material* material, const lighting::ProbeImage* image, const float* points,
                            int count) {
    std::vector<diffraction::ShadingPoint> shaded;
    for (int i = 0; i < count; ++i, points += 9)
        shaded.push_back({.view = {points[0], points[1], points[2]},
                          .normal = {points[3], points[4], points[5]},
                          .grating = {points[6], points[7], points[8]}});
    auto* numbers = new Numbers;
    for (const glm::dvec3& xyz : diffraction::reference_radiance(
             material->grating(), *image, colour::LightSpectra(material->source.material.quality.illuminant), shaded))
        append(glm::vec3(xyz_to_working() * xyz), *numbers);
    return numbers;
}

}  // namespace rowland::web
