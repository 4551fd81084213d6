#pragma once

#include <string>

namespace rowland {

/// The processor's name as Linux gives it, or "unknown processor".
std::string processor_name();

}  // namespace rowland
