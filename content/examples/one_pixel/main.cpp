// one_pixel PROBE: the radiance (XYZ) of one pixel of a compact disc under a light probe (.hdr or .exr,
// equirectangular).
#include <engine/image/image.h>
#include <engine/lighting/probe_image.h>
#include <engine/math/spherical_harmonics.h>
#include <modules/diffraction/model/grating.h>
#include <modules/diffraction/representations/arc/arc_table.h>

#include <cstdio>
#include <exception>
#include <span>

using namespace rowland;

int main(int argc, char** argv) try {
    if (argc != 2) return std::fprintf(stderr, "usage: one_pixel PROBE\n"), 2;

    // The material: grooves 1600 nm apart, half of each reflects. Baked once, for any light and view.
    const diffraction::Grating disc{.pitch_nm = 1600.0, .profile = diffraction::SlitProfile{.width_nm = 800.0}};
    const auto table = diffraction::bake(disc, {.bands = 5, .rank = 16});

    // The light: spherical harmonics of the probe, in five bands.
    const lighting::ProbeImage probe(image::load_image(argv[1]), lighting::Mapping::Equirectangular, argv[1]);
    const lighting::ShLight light = lighting::project(probe, table.bands);

    // The pixel: where the eye is, the surface's normal, and the direction across the grooves, all seen in the world.
    const diffraction::ShadingPoint pixel{
        .view = {0.36, 0.48, 0.8}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
    const glm::dmat3 to_tangent = diffraction::world_to_tangent(pixel);
    lighting::ShLight tangent_light = light;
    math::ShRotation(to_tangent, light.bands)
        .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(tangent_light.coefficients));

    const glm::dvec3 xyz = diffraction::evaluate(table, tangent_light, to_tangent * pixel.view);
    std::printf("%.9g,%.9g,%.9g\n", xyz.x, xyz.y, xyz.z);
    return 0;
} catch (const std::exception& error) {
    return std::fprintf(stderr, "error: %s\n", error.what()), 2;
}
