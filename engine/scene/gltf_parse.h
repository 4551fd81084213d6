#pragma once

#include <span>
#include <string>

#include "engine/scene/gltf_document.h"
#include "engine/scene/gltf_json.h"

namespace rowland::scene {

/// Refuses a version that is not 2.x and a minVersion that is not 2.0 (glTF 2.0, 3.2). Throws Error (input).
void check_asset(JsonReader asset);

/// Reads the JSON of a glTF file, all but its animations: every property that we use has the right type and range, and
/// every index names something. Buffers are left empty. Extensions that we do not read must be among
/// `handled_extensions` if the file requires them; ignored extensions are added to the warnings. Throws Error (input)
/// with the JSON pointer.
GltfDocument parse_gltf(const GltfJson& json, std::span<const std::string> handled_extensions);

}  // namespace rowland::scene
