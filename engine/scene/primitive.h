#pragma once

#include <string>
#include <vector>

#include "engine/scene/draco_process.h"
#include "engine/scene/gltf_document.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// Whether a primitive is made of triangles (a list, a strip or a fan).
bool has_triangles(const GltfPrimitive& primitive);

/// Whether a primitive has a POSITION attribute.
bool has_positions(const GltfPrimitive& primitive);

/// The mesh of one triangle primitive with positions: strips and fans become lists, indices and positions are checked,
/// missing or unusable normals and tangents generated. Repairs are added to `warnings`. `pointer` is the primitive's
/// JSON pointer. Throws Error (input).
Mesh import_primitive(const GltfDocument& document, const GltfPrimitive& primitive, const std::string& pointer,
                      DracoProcess& decoder, MemoryBudget& budget, std::vector<std::string>& warnings);

}  // namespace rowland::scene
