#pragma once

#include <optional>

#include "tests/evidence/peers/comparison.h"

namespace rowland::evidence {

/// What a peer returns of white light from all directions, in its published units, for views at 0, 30 and 60 degrees
/// across and along the grooves: luminance, the least and the most. 1 is all of it.
struct ReturnedEnergy {
    double least = 0.0;
    double most = 0.0;
};
ReturnedEnergy returned_energy(const PeerSetting& setting);

/// How far the first order's green is from the direction that the grating equation gives, in degrees; none where no
/// peak is found on a side that the order reaches.
struct DirectionError {
    std::optional<double> across;  ///< the most, light at 0, 30 and 60 degrees in the plane across the grooves
    std::optional<double> along;   ///< light at 45 degrees along the grooves
};
DirectionError direction_error(const PeerSetting& setting);
/// The same of `direct`.
DirectionError direction_error_of_direct();

}  // namespace rowland::evidence
