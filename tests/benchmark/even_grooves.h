#pragma once

#include <memory>

#include "modules/diffraction/runtime/groove_map.h"

namespace rowland::benchmark {

/// A map of one direction and the material's pitch: what a map costs, whatever it holds.
std::shared_ptr<const diffraction::GrooveMap> even_grooves();

}  // namespace rowland::benchmark
