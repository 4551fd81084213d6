#pragma once

#include <optional>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/portable/document.h"

namespace rowland::diffraction {

/// Adds "material": the kernel, the layers' weights and what shades a lobe and a cover.
void add_material(const CookedMaterial& cooked, PortableDocument& document);

/// Adds "arc": the table of the representation `arc`, with the matrix from SH to its light terms.
void add_arc(const ArcTable& table, PortableDocument& document);

}  // namespace rowland::diffraction
