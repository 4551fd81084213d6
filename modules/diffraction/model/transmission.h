#pragma once

#include "modules/diffraction/model/shading_point.h"

namespace rowland::diffraction {

/// A thin sheet that sends light through (PHYSICS §12).
struct Transmission {
    double ior = 1.5;          ///< n of the sheet at all wavelengths, at least 1; slits and tables do not depend on it
    double reflectance = 0.0;  ///< fraction of the light that the sheet reflects, in [0, 1]; it transmits the rest
};

/// The point of a sheet's other side that shows, as a reflection grating, what the sheet shows at `frame`: the view is
/// mirrored in the surface, the normal is the opposite one (PHYSICS (44)). The frame must be valid.
ShadingPoint lit_from_behind(const ShadingPoint& frame);

}  // namespace rowland::diffraction
