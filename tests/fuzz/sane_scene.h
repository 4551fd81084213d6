#pragma once

#include "engine/scene/imported_scene.h"

namespace rowland::fuzz {

/// Aborts unless the scene keeps what imported_scene.h and mesh.h promise, as far as whoever draws it would be hurt:
/// every index and reference is in range, arrays are as long as each other, values are finite.
void require_sane(const scene::ImportedScene& scene);

}  // namespace rowland::fuzz
