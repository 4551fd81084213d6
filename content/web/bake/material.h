#pragma once

#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/bake/blurred_kernel.h"
#include "modules/diffraction/model/colour_kernel.h"

namespace rowland::web {

/// A glTF extension's object, or a material file, with its kernel.
struct Material {
    diffraction::GltfGrating source;
    diffraction::KernelTable kernel;  ///< XYZ
    glm::dmat3 zero_order_xyz{0.0};

    const diffraction::Grating& grating() const { return source.material.grating; }
    bool has_pits() const { return std::holds_alternative<diffraction::PitsLobe>(grating().lobe); }
};

/// The page's working space is linear Rec.709.
const glm::dmat3& xyz_to_working();

}  // namespace rowland::web
