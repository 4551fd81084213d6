#pragma once

#include <vector>

#include "editor/inspector/field.h"

namespace rowland::inspector {

/// The fields of a material's "grating", in the order they are shown.
std::vector<Field> grating_fields();

}  // namespace rowland::inspector
