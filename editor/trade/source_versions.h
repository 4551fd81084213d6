#pragma once

#include <string>

namespace rowland::trade {

/// Hashes of the sources that results depend on, made when the tool is built: results of other sources are not taken
/// up.
std::string reference_version();  ///< of the reference and what it computes with
std::string method_version();     ///< of everything that shades, on the CPU or the GPU

}  // namespace rowland::trade
