#pragma once

#include <OpenColorIO/OpenColorIO.h>

namespace rowland::post {

/// Adds to the shipped configuration the views whose curves and tables no configuration file can hold: "Constant Hue"
/// (constant_hue.h), which becomes the default, "AgX" (agx.h) and "False Colour" (false_colour.h). All are
/// OpenColorIO's own transforms, run by its CPU and GPU code.
void add_computed_views(OCIO_NAMESPACE::Config& config);

}  // namespace rowland::post
