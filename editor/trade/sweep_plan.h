#pragma once

#include <string>
#include <vector>

#include "modules/diffraction/asset/method.h"
#include "modules/diffraction/model/lobe.h"

namespace rowland::trade {

/// A named starting point of the sweep: what one would use on some device.
struct Tier {
    std::string name;
    std::string setting;  ///< as diffraction::parse_method() reads it
};

/// The tiers a grating with this lobe can be shaded by.
std::vector<Tier> tiers(const diffraction::GrooveLobe& lobe);

/// What Lindsay & Agu 2006 shade by. Reports show it even where another setting is better in every way.
diffraction::Method paper_setting();

/// One axis at a time around each tier, and what varying one at a time misses: about 120 settings for the flat lobe,
/// each once, in a fixed order, tiers first. The representations' descriptors name tiers and axes.
std::vector<diffraction::Method> sweep_plan(const diffraction::GrooveLobe& lobe);

}  // namespace rowland::trade
