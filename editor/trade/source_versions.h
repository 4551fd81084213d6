#pragma once

#include <string>

namespace rowland::trade {

/// Hashes of the sources that results depend on, computed when the tool is built. Results of other sources are not
/// reused.
std::string reference_version();  ///< of the reference and the libraries it uses
std::string method_version();     ///< of all code that shades, on the CPU or the GPU
std::string release_version();    ///< Rowland's version number

}  // namespace rowland::trade
