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

/// The layer under the grating: a dielectric, lit by the light that the orders do not diffract.
struct BaseLayer {
    glm::vec3 colour{0.0F};  ///< linear Rec.709 albedo, 0…1
    float roughness = 0.3F;  ///< perceptual, 0…1
};

/// A light probe that errors are measured under, as a material names it.
struct MeasuredProbe {
    std::string file;  ///< beside the material: a recipe (.json), or an image
    lighting::Mapping mapping = lighting::Mapping::Equirectangular;  ///< of an image
};

/// The number that an error is: what "measure" names in a material.
enum class ErrorMeasure {
    RelativeRms,  ///< "relative_rms": relative RMS of XYZ over the views (PHYSICS §1)
    DeltaE,       ///< "delta_e": CIEDE2000 that 95 % of the views do not exceed, exposed for the reference
    HdrFlip,      ///< "hdr_flip": mean HDR-FLIP over a picture, 0 (looks the same) to 1
};

/// An error that is tolerated, or a representation pinned by hand.
struct Quality {
    double max_error = 0.05;  ///< against the reference, > 0, as `measure` says
    ErrorMeasure measure = ErrorMeasure::RelativeRms;
    std::vector<MeasuredProbe> probes;          ///< that max_error is for; none: the built-in clear sky
    SurfaceShape surface = SurfaceShape::Flat;  ///< that max_error is for
    std::optional<Representation> pinned;
    /// At most so many of the probe's key lights are shaded one by one, at full sharpness: those that
    /// matter most. The others remain in the probe. 0 to lighting::kMaximumKeyLights, which is all.
    int key_lights = 0;
    /// Key lights and directional lights are shaded per vertex, for dense meshes, instead of per pixel.
    bool lights_at_vertices = false;
    bool map_at_vertices = false;                   ///< the map of `planar` or `circle` is read per vertex
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the light's white that tables are baked for
};

/// A grating material: the parsed material file.
struct Material {
    Grating grating;
    BaseLayer base;
    Quality quality;
};

/// The representation to bake: the pinned one, else spikes, of a lattice planar. A cooker pins the one that it chooses
/// for max_error.
Representation representation(const Material& material);

}  // namespace rowland::diffraction
