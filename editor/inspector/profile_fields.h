#pragma once

#include <vector>

#include "editor/inspector/field.h"

namespace rowland::inspector {

/// The fields of a groove's profile: `choice`, which gets the profiles as its choices, then one field for each member;
/// profiles with the same member share its field. `with_table`: a table of efficiencies is one of the profiles.
std::vector<Field> profile_fields(Field choice, bool with_table);

}  // namespace rowland::inspector
