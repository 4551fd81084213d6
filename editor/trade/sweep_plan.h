#pragma once

#include <string>
#include <vector>

#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/model/lobe.h"

namespace rowland::trade {

/// The first settings of the plan, one for each representation that can shade this lobe, as parse_method() reads them.
std::vector<std::string> first_settings(const diffraction::GrooveLobe& lobe);

/// The setting of Lindsay & Agu 2006. Reports show it even where another setting is better in every way.
diffraction::Method paper_setting();

/// The settings that a sweep measures for a lobe: first_settings(), then variations of one member at a time, then some
/// combinations. About 120 for the flat lobe, each once, in a fixed order.
std::vector<diffraction::Method> sweep_plan(const diffraction::GrooveLobe& lobe);

}  // namespace rowland::trade
