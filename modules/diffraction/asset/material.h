#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "modules/diffraction/bake/spike_table.h"
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
    std::optional<SpikeTableSettings> pinned;
};

/// A grating material: the parsed material file.
struct Material {
    Grating grating;
    BaseLayer base;
    Quality quality;
};

/// The view table that the cooker bakes for a material.
SpikeTableSettings table_settings(const Material& material);

}  // namespace rowland::diffraction
