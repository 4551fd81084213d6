#pragma once

#include <vector>

#include "engine/lighting/key_lights.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/model/colour_kernel.h"

namespace rowland::web {

/// A glTF extension's object, or a material file, with its kernel.
struct Material {
    diffraction::GltfGrating source;
    bool unsolved = false;            ///< of rigorous theory, without its efficiencies: baked by scalar theory
    diffraction::KernelTable kernel;  ///< XYZ
    glm::dmat3 zero_order_xyz{0.0};

    const diffraction::Grating& grating() const { return source.material.grating; }
    bool has_pits() const { return std::holds_alternative<diffraction::PitsLobe>(grating().lobe); }
};

/// Numbers of a key light as workers hand them on: direction, flux, concentration.
inline constexpr int kKeyLightNumbers = 7;

inline std::vector<lighting::KeyLight> key_lights_of(const float* numbers, int count) {
    std::vector<lighting::KeyLight> lights;
    for (const float* at = numbers; at != numbers + kKeyLightNumbers * count; at += kKeyLightNumbers)
        lights.push_back({.direction = {at[0], at[1], at[2]},
                          .flux = {at[3], at[4], at[5]},
                          .concentration = static_cast<double>(at[6])});
    return lights;
}

/// The page's working space is linear Rec.709.
const glm::dmat3& xyz_to_working();

}  // namespace rowland::web
