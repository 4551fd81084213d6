#pragma once

#include <gtest/gtest.h>

#include "engine/scene/gltf_import.h"
#include "engine/scene/mesh.h"

namespace rowland::scene::test {

/// Whether a mesh keeps what mesh.h promises; the message says what it breaks.
testing::AssertionResult is_sane(const Mesh& mesh);

/// The same for every mesh of a scene and what its instances refer to.
testing::AssertionResult is_sane(const ImportedScene& scene);

/// Volume enclosed by the triangles; positive if they are counter-clockwise from outside.
double signed_volume(const Mesh& mesh);

}  // namespace rowland::scene::test
