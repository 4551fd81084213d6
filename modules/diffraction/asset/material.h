#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::diffraction {

/// What lies under the grating: a dielectric with this colour, lit by the light the orders leave over.
struct BaseLayer {
    glm::vec3 colour{0.0F};  ///< linear Rec.709 albedo, 0…1
    float roughness = 0.3F;  ///< perceptual, 0…1
};

/// A light probe that errors are measured under, as a material names it.
struct MeasuredProbe {
    std::string file;  ///< beside the material: a recipe (.json), or an image
    lighting::Mapping mapping = lighting::Mapping::Equirectangular;  ///< of an image
};

/// An error that is tolerated, or a representation pinned by hand.
struct Quality {
    double max_error = 0.05;                    ///< relative RMS against the reference, > 0
    std::vector<MeasuredProbe> probes;          ///< that max_error is for; none: the built-in clear sky
    SurfaceShape surface = SurfaceShape::Flat;  ///< that max_error is for
    std::optional<Representation> pinned;
    bool key_lights = false;  ///< the probe's key lights are shaded on their own, at full sharpness
    /// Key lights and directional lights are shaded at the vertices, which suits dense meshes, not at every pixel.
    bool lights_at_vertices = false;
    bool map_at_vertices = false;                   ///< so is the map of `planar` or `circle`
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the light's white that tables are baked for
};

/// A grating material: the parsed material file.
struct Material {
    Grating grating;
    BaseLayer base;
    Quality quality;
};

/// What is baked for a material: what is pinned, else spikes. A cooker that is to meet max_error pins what it chose.
Representation representation(const Material& material);

}  // namespace rowland::diffraction
