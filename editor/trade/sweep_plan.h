#pragma once

#include <string>
#include <vector>

#include "editor/trade/setting.h"
#include "modules/diffraction/model/lobe.h"

namespace rowland::trade {

/// A named starting point of the sweep: what one would use on some device.
struct Tier {
    std::string name;
    std::string setting;  ///< as parse_setting() reads it
};

/// The tiers a grating with this lobe can be shaded by.
std::vector<Tier> tiers(const diffraction::GrooveLobe& lobe);

/// One axis at a time around each tier, and what varying one at a time misses: about 120 settings for the flat lobe,
/// each once, in a fixed order, tiers first. The representations' descriptors name tiers and axes.
std::vector<Setting> sweep_plan(const diffraction::GrooveLobe& lobe);

}  // namespace rowland::trade
