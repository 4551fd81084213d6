#pragma once

#include <vector>

#include "editor/inspector/field.h"

namespace rowland::inspector {

/// The grating that a new lattice starts with.
Json new_lattice();

/// The fields of a grating with a "lattice", in the order they are shown.
std::vector<Field> lattice_fields();

}  // namespace rowland::inspector
