#pragma once

#include <string>
#include <vector>

#include "engine/scene/draco_process.h"
#include "engine/scene/gltf_document.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// Whether a primitive is made of triangles (a list, a strip or a fan).
bool has_triangles(const GltfPrimitive& primitive);

/// The mesh of one triangle primitive of a checked document: its data read or decoded, strips and fans made lists,
/// indices and positions checked, missing or unusable normals and tangents generated. Repairs are added to `warnings`.
/// `place` is the primitive's JSON pointer. Throws Error (input).
Mesh import_primitive(const GltfDocument& document, const GltfPrimitive& primitive, const std::string& place,
                      DracoProcess& decoder, MemoryBudget& budget, std::vector<std::string>& warnings);

}  // namespace rowland::scene
