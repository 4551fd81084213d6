#pragma once

#include <vector>

#include "editor/trade/setting.h"
#include "modules/diffraction/model/lobe.h"

namespace rowland::trade {

/// A named starting point of the sweep: what one would use on some device.
struct Tier {
    const char* name;
    const char* setting;  ///< as parse_setting() reads it
};

/// The tiers a grating with this lobe can be shaded by.
std::vector<Tier> tiers(const diffraction::GrooveLobe& lobe);

/// One axis at a time around each tier (bands, spikes, bins, rank, view and map resolution, view mapping, storage,
/// window, key lights) and a coarse grid over bands, rank and key lights: about 120 settings for the flat lobe, each
/// once, in a fixed order, tiers first.
std::vector<Setting> sweep_plan(const diffraction::GrooveLobe& lobe);

}  // namespace rowland::trade
