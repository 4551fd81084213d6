#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/colour/illuminant.h"
#include "modules/diffraction/asset/representation.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// What lies under the grating: a dielectric with this colour, lit by the light the orders leave over.
struct BaseLayer {
    glm::vec3 colour{0.0F};  ///< linear Rec.709 albedo, 0…1
    float roughness = 0.3F;  ///< perceptual, 0…1
};

/// What the user pays for: an error that can be borne, or a representation pinned by hand.
struct Quality {
    double max_error = 0.05;  ///< relative RMS against the reference, > 0
    std::optional<Representation> pinned;
    bool key_lights = false;  ///< the probe's key lights are shaded on their own, at full sharpness
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the light's white that tables are baked for
};

/// A grating material: the parsed material file.
struct Material {
    Grating grating;
    BaseLayer base;
    Quality quality;
};

/// What the cooker bakes for a material: what is pinned, else spikes.
Representation representation(const Material& material);

}  // namespace rowland::diffraction
