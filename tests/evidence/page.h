#pragma once

#include <string>

#include "tests/evidence/section.h"

namespace rowland::evidence {

/// The page: one HTML file that needs no other. `sections`: what they measured, each with its "name".
std::string page_html(const Json& sections);

}  // namespace rowland::evidence
